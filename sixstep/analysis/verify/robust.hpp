// SPDX-License-Identifier: Apache-2.0
// Varies the motor within the data sheet's tolerances; the controller stays as designed. Runs each single
// tolerance level, then each combination of outermost levels.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sixstep/analysis/for_each.hpp"
#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

enum class Strays : std::uint8_t { resistance, inductance, torque_constant, inertia };

/// One quantity and its possible deviations, as factors on the sheet's value.
struct Tolerance {
  struct Level {
    std::string words;  ///< "R +10 %"
    double factor = 1.0;
  };
  Strays quantity = Strays::resistance;
  std::vector<Level> levels;
};

/// The tolerances of a sheet's motor:
/// - R +-10 %, L +-20 %, K_t +-8 %: tolerances that makers print or confirm.
/// - R with the winding at its limit (design/sheet/thermal.hpp; 120 degC if the sheet has no limit).
/// - K_t with the magnets at the housing's temperature in this state, if the sheet has the thermal values.
/// - J doubled, for an unknown load.
///
/// In current mode the rotor is held, and only R and L have an effect.
std::vector<Tolerance> sheet_tolerances(const design::Sheet& sheet, control::Mode mode);

/// Tolerances for [[spread]], each quantity evenly to both sides. They are deviations within a series of
/// drives that no maker excludes. They apply in every mode, because a rotor that turns has a back-EMF.
/// Temperatures and loads are no tolerance of the motor. The two inductances of a salient rotor have no key
/// that could deviate.
std::vector<study::Spread> tolerance_spread(const design::Sheet& sheet);

/// Largest displacement of a Hall edge by the mounting of a probe, in electrical degrees.
inline constexpr double mounted_hall_edge_deg = 3.0;

/// Spread of six Hall edges for a drive with probes, each edge by mounted_hall_edge_deg to both sides. It
/// models the mounting of probes, but not a common delay of all edges.
std::vector<study::Spread> hall_edge_spread(const study::Scenario& scenario);

/// Deviations that are in neither of the two spreads for this scenario, each with its reason; empty: none.
std::string tolerances_not_drawn(const study::Scenario& scenario);

/// A motor that deviates within the tolerances.
struct Variation {
  std::string words;            ///< "R at 125 degC, L -20 %"; empty: nominal
  std::vector<double> factors;  ///< a factor per tolerance
  bool single = false;          ///< true: only one tolerance deviates
};
/// The nominal motor; each single level; then every combination of outermost levels. If a tolerance has one
/// side only, its outermost levels are this side and the nominal value.
std::vector<Variation> variations(const std::vector<Tolerance>& tolerances);

/// The scenario with a motor that deviates; the controller stays as designed for the sheet. `motor` is the
/// motor of DriveDesign. Its inertia includes the load's inertia, and the sum of both deviates.
study::Scenario varied_scenario(const study::Scenario& nominal, const design::MotorModel& motor,
                                const std::vector<Tolerance>& tolerances, const Variation& variation);

struct RobustFigure {
  std::string figure{}, unit{};
  double nominal = 0.0;
  double worst = 0.0;     ///< the largest value; infinite if a run never settles, or if a fault ended it
  std::string at{};       ///< the variation as text; empty if no variation is worse than nominal
  std::string culprit{};  ///< the single level with the largest effect
  double alone = 0.0;     ///< the figure with only this level
};

struct Robustness {
  std::vector<RobustFigure> figures;  ///< figures of the scenario's comparisons, in their order
  /// Phase margin of each loop in degrees, with the longer of the delays and with the sensor of the speed.
  /// `worst` is the least margin.
  std::vector<RobustFigure> phases;
  std::size_t runs = 0;
};

Robustness robustness(const design::DriveDesign& design, const study::Scenario& scenario,
                      const std::vector<Tolerance>& tolerances, const ForEach& for_each = one_after_the_other,
                      const std::function<bool()>& keep_going = {});

}  // namespace sixstep::analysis
