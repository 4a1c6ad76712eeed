// SPDX-License-Identifier: Apache-2.0
// Computes the torque-speed curve of a motor from standstill to no load, with the data sheet's values and the
// winding's thermal limits.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "sixstep/analysis/curve/marks.hpp"
#include "sixstep/analysis/curve/no_load.hpp"
#include "sixstep/design/sheet/thermal_ranges.hpp"

namespace sixstep::analysis {

/// Largest number of points of a curve. They need some hundred megabytes. No screen or table can show as many
/// rows.
inline constexpr int most_points = 200'000;

struct CurveRequest {
  design::Sheet sheet;
  Bench bench;  ///< bench with the motor at `motor_degC` (design::warmed)
  design::Temperatures motor_degC{};
  int points = 41;  ///< number of points from standstill to no load, both included
  double ambient_degC = design::sheet_degC;
};

/// The sheet's nominal point, and the curve's point of equal torque. The comparison is at equal torque,
/// because a load determines the torque; the speed then differs from motor to motor. A comparison of the
/// torques at the printed speed would magnify the same difference by the curve's steepness.
struct NominalPoint {
  std::optional<double> speed_rad_s, torque_Nm, current_A;  ///< values as printed
  std::string from;                         ///< source of these values if it is not the data sheet
  std::optional<OperatingPoint> at_torque;  ///< empty if no torque is printed, or if the curve never reaches
                                            ///< it
  std::optional<OperatingPoint> at_speed;   ///< empty if no speed is printed
};

/// Loss of speed per torque, rad/s per N m, from no load to the nominal point.
struct SpeedDrop {
  double ideal = 0.0;               ///< R_tt/K_t^2, the speed-torque gradient of data sheets
  std::optional<double> printed{};  ///< this gradient as printed in the sheet
  std::optional<double> sheet{};    ///< gradient between the printed no-load and nominal points
  std::optional<double> curve{};    ///< gradient of the curve between the same two torques
};

/// Durations for which short-time limits are given, s.
inline constexpr std::array<double, 2> short_times_s = {10.0, 60.0};

/// Thermal limits of the winding at one speed, as the shaft torque of a drive with a constant current I.
/// Block current flows through two phases, so that the loss is I^2 R_tt. The torque is K_t I minus friction,
/// with K_t at the resulting temperature of the magnets. Friction warms the housing. The motor temperature of
/// the curve has no influence. NaN if ambient temperature or friction heats the winding above its limit
/// without any current.
struct ThermalLimits {
  double continuous_A = 0.0, continuous_Nm = 0.0;
  std::array<double, short_times_s.size()> short_A{}, short_Nm{};  ///< for short_times_s, starting at ambient
                                                                   ///< temperature
};

/// Temperatures at a curve's point in steady operation. The current is assumed to stay constant while the
/// copper warms up.
struct Warming {
  std::optional<double> winding_degC;   ///< final temperature; empty: it rises without end
  std::optional<double> permissible_s;  ///< permissible time, starting at ambient temperature; empty: no
                                        ///< limit
};

struct Curve {
  std::vector<OperatingPoint> points{};
  NoLoad no_load{};
  Marks marks{};
  std::optional<NominalPoint> nominal{};
  std::optional<design::ThermalModel> thermal{};  ///< the model for all limits: design::safe_thermal_model()
  std::vector<ThermalLimits> limits{};            ///< one per point; empty without thermal lines
  std::vector<Warming> warming{};                 ///< one per point; empty without thermal lines
  std::string worse_ends{};  ///< values in which `thermal` differs from the sheet's own model: "key = 5.3"
  std::optional<design::ThermalModel>
      by_values{};                   ///< the sheet's own values where `thermal` differs from them
  base::Problems thermal_missing{};  ///< why `thermal` is empty
};

/// First step of a curve: the no-load point, and the speeds of points that can be computed independently. The
/// order of the speeds is:
/// - the speeds of the curve's points, except the no-load point;
/// - the speeds of the sweep for the marks, except the no-load point;
/// - the sheet's nominal speed, if the sheet has a nominal speed.
struct CurvePlan {
  NoLoad no_load;
  std::vector<double> speeds_rad_s;
};

base::Problems check(const CurveRequest& request);
base::Result<CurvePlan> plan_curve(const CurveRequest& request);
/// Second step of a curve. `found` are the points at the plan's speeds, in order.
base::Result<Curve> curve_of(const CurveRequest& request, const CurvePlan& plan,
                             const std::vector<OperatingPoint>& found, const ForEach& for_each);
SpeedDrop speed_drop(const CurveRequest& request, const Curve& curve);

/// "no friction: ..": why efficiency and no-load speed are upper bounds; empty where the model has friction.
std::string without_friction(const CurveRequest& request);

ThermalLimits thermal_limits(const design::ThermalModel& model, const CurveRequest& request,
                             double speed_rad_s);
Warming warming(const design::ThermalModel& model, const CurveRequest& request, const OperatingPoint& point);

}  // namespace sixstep::analysis
