// SPDX-License-Identifier: Apache-2.0
// Varies the motor within the data sheet's tolerances; the controller stays as designed. Runs each tolerance
// level alone, then each combination of outermost levels.
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
/// - R +-10 %, L +-20 %, K_t +-8 %: what makers print or admit.
/// - R with the winding at its limit (design/sheet/thermal.hpp; 120 degC if the sheet has none).
/// - K_t with the magnets at the housing's temperature then, if the sheet has the thermal values.
/// - J doubled, for an unknown load.
///
/// With the rotor held, in current mode, only R and L matter.
std::vector<Tolerance> sheet_tolerances(const design::Sheet& sheet, control::Mode mode);

/// The same for [[spread]], each quantity evenly to both sides: deviations in a series of drives that no
/// maker excludes, in any mode: a rotor that turns has a back-EMF. Temperatures and loads are no tolerance of the motor, and the two inductances of a salient
/// rotor have no key that could deviate.
std::vector<study::Spread> tolerance_spread(const design::Sheet& sheet);

/// Largest displacement of a Hall edge from its place by the mounting of a probe, in electrical degrees.
inline constexpr double mounted_hall_edge_deg = 3.0;

/// Spread of six Hall edges for a drive that reads probes, each by mounted_hall_edge_deg to both sides. It
/// models the mounting of probes, but not a common delay of all edges.
std::vector<study::Spread> hall_edge_spread(const study::Scenario& scenario);

/// What neither of the two spreads has for this scenario, each with its reason; empty: nothing is missing.
std::string tolerances_not_drawn(const study::Scenario& scenario);

/// A motor that deviates within the tolerances.
struct Variation {
  std::string words;            ///< "R at 125 degC, L -20 %"; empty: nominal
  std::vector<double> factors;  ///< a factor per tolerance
  bool single = false;          ///< only one tolerance deviates
};
/// The nominal motor; each level alone; then every combination of outermost levels. If a tolerance is to one
/// side only, its levels there are that side and the nominal value.
std::vector<Variation> variations(const std::vector<Tolerance>& tolerances);

/// The scenario with a motor that deviates; the controller stays as designed for the sheet. `motor` is that
/// of DriveDesign. Its inertia includes the load's, and the sum of both deviates.
study::Scenario varied_scenario(const study::Scenario& nominal, const design::MotorModel& motor,
                                const std::vector<Tolerance>& tolerances, const Variation& variation);

struct RobustFigure {
  std::string figure{}, unit{};
  double nominal = 0.0;
  double worst = 0.0;     ///< the largest value; infinite if a run never settles, or if a fault ended it
  std::string at{};       ///< the variation in words; empty if none is worse than nominal
  std::string culprit{};  ///< the level that has the largest effect alone
  double alone = 0.0;     ///< the figure with this level alone
};

struct Robustness {
  std::vector<RobustFigure> figures;  ///< figures of the scenario's comparisons, in their order
  /// Phase margin of each loop in degrees, with the longer of the delays and with the sensor of the speed.
  /// The least margin is worst.
  std::vector<RobustFigure> phases;
  std::size_t runs = 0;
};

Robustness robustness(const design::DriveDesign& design, const study::Scenario& scenario,
                      const std::vector<Tolerance>& tolerances, const ForEach& for_each = one_after_the_other,
                      const std::function<bool()>& keep_going = {});

}  // namespace sixstep::analysis
