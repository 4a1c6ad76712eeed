// SPDX-License-Identifier: Apache-2.0
// The torque-speed curve of a motor: from standstill to no load, with what the sheet says beside it and what
// the winding stands for ever or for a while.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "sixstep/analysis/curve/marks.hpp"
#include "sixstep/analysis/curve/no_load.hpp"
#include "sixstep/design/sheet/thermal_ranges.hpp"

namespace sixstep::analysis {

/// Some hundred megabytes of points, more than any screen or table has rows for.
inline constexpr int most_points = 200'000;

struct CurveRequest {
  design::Sheet sheet;
  Bench bench;  ///< its motor as warm as `motor_degC` (design::warmed)
  design::Temperatures motor_degC{};
  int points = 41;  ///< from standstill to no load, both included
  double ambient_degC = design::sheet_degC;
};

/// The point that the sheet calls nominal, and where the curve has its torque. A load asks for a torque: what
/// the motor then does differently is to turn slower. The torque at the printed speed would magnify the same
/// difference by the curve's steepness.
struct NominalPoint {
  std::optional<double> speed_rad_s, torque_Nm, current_A;  ///< as printed
  std::string from;                                         ///< what prints them, where it is not the sheet
  std::optional<OperatingPoint> at_torque;  ///< empty without a torque, or where the curve never has it
  std::optional<OperatingPoint> at_speed;   ///< empty without a speed
};

/// How much speed a torque costs, rad/s per N m, from no load to the nominal point.
struct SpeedDrop {
  double ideal = 0.0;               ///< R_tt/K_t^2: what a sheet's speed-torque gradient is
  std::optional<double> printed{};  ///< that gradient as printed
  std::optional<double> sheet{};    ///< between the printed no-load and nominal points
  std::optional<double> curve{};    ///< between the same torques of the curve
};

/// Times for which short-time limits are given, s.
inline constexpr std::array<double, 2> short_times_s = {10.0, 60.0};

/// What the winding stands at one speed, as shaft torque of a drive that holds the current constant: block
/// current through two phases, P = I^2 R_tt, and K_t I less friction, with K_t of the magnets as warm as they then
/// are. Friction warms the housing. None of it depends on how warm the curve's own motor is. No value (NaN) where the
/// winding is above its limit without any current: the air or friction alone warm it that far.
struct ThermalLimits {
  double continuous_A = 0.0, continuous_Nm = 0.0;
  std::array<double, short_times_s.size()> short_A{}, short_Nm{};  ///< from ambient temperature
};

/// A point of the curve held for good: the winding's temperature in the end, or how long it may last from
/// ambient temperature. The current is taken as held while the copper warms.
struct Warming {
  std::optional<double> winding_degC;   ///< empty where it never comes to rest
  std::optional<double> permissible_s;  ///< empty: for ever
};

struct Curve {
  std::vector<OperatingPoint> points{};
  NoLoad no_load{};
  Marks marks{};
  std::optional<NominalPoint> nominal{};
  std::optional<design::ThermalModel> thermal{};
  std::vector<ThermalLimits> limits{};            ///< one per point; empty without thermal lines
  std::vector<Warming> warming{};                 ///< likewise
  std::optional<design::WorseEnds> worse_ends{};  ///< where the sheet's thermal lines have ranges
  base::Problems thermal_missing{};               ///< why there are none
};

/// What comes first: the no-load point, and the speeds that are then independent of each other: those of the
/// points, then the sweep on which the marks are looked for, both ending before no load, and the sheet's
/// nominal speed where it has one.
struct CurvePlan {
  NoLoad no_load;
  std::vector<double> speeds_rad_s;
};

base::Problems check(const CurveRequest& request);
base::Result<CurvePlan> plan_curve(const CurveRequest& request);
/// `found` are the points at the plan's speeds, in order.
base::Result<Curve> curve_of(const CurveRequest& request, const CurvePlan& plan,
                             const std::vector<OperatingPoint>& found, const ForEach& for_each);
SpeedDrop speed_drop(const CurveRequest& request, const Curve& curve);

ThermalLimits thermal_limits(const design::ThermalModel& model, const CurveRequest& request,
                             double speed_rad_s);
Warming warming(const design::ThermalModel& model, const CurveRequest& request, const OperatingPoint& point);

}  // namespace sixstep::analysis
