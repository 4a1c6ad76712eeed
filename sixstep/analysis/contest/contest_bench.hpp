// SPDX-License-Identifier: Apache-2.0
// Creates the scenario that all controllers of a comparison share. A controller's scenario differs from it
// only by the keys of the controller's row (contestants.hpp). Motor, bus, bridge, PWM period, delay, sensors,
// torque limit, settling times and course are the same for all. The course has three parts:
// - start: from rest to the high speed w_h, against half of the full load;
// - load step: to the full load;
// - slow: down to the lowest speed for which the speed loop is designed, against the full load.
//
// The full load is K_t times the nominal current. w_h is 0.6 of the speed up to which the bus drives the
// nominal current, because commutation and acceleration need the rest of the voltage.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sixstep/analysis/contest/contest_figures.hpp"
#include "sixstep/analysis/contest/contestants.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

/// Half width of the band in which a speed counts as settled, as a fraction of the reference.
inline constexpr double settled_part = 0.02;

struct ContestSpec {
  std::string motor{};                ///< name or path, for the scenarios
  design::Sheet sheet{};              ///< sheet of the motor
  std::optional<double> voltage_V{};  ///< bus voltage; empty: nominal voltage of the sheet
  std::optional<double>
      settle_s{};  ///< settling time of the speed loop; empty: the time that the Hall probes allow
  std::optional<double>
      current_settle_s{};            ///< settling time of the current loop; empty: the design's default
  std::optional<double> period_s{};  ///< period of PWM and control; empty: 30 us
  /// Source of supply, bridge, PWM and sensors; empty: usual_bridge(). If the board's switches have no
  /// switching energies, the energies of usual_bridge() are used.
  std::optional<study::Scenario> board{};
};

struct Course {
  double high_rad_s = 0.0, slow_rad_s = 0.0;
  double load_Nm = 0.0;
  double load_at_s = 0.0, slow_at_s = 0.0, end_s = 0.0;
  /// Length in s of the measured window before load_at_s: ten electrical turns, or the settling time if
  /// longer.
  double calm_s = 0.0;
  double slow_calm_s = 0.0;  ///< length of the window at the end, by the same rule
};

struct ContestBench {
  design::DriveDesign design;
  Course course;
  study::Scenario scenario;        ///< the scenario of a contestant that changes no keys
  std::vector<std::string> rules;  ///< conditions that are the same for all controllers, a sentence each
};

/// Problems: errors of the sheet, a linear motor, no suitable settling time.
base::Result<ContestBench> contest_bench(const ContestSpec& spec);

/// The bridge if the user gives no bridge: switches of 1 % of the winding's resistance, diodes of 0.8 V, half
/// a microsecond of dead time. Switching edges last 50 ns: E_on = E_off = U I 50 ns/2, with the bus voltage U
/// and the nominal current I.
study::Bridge usual_bridge(const design::DriveDesign& design);

/// Values that replace <name> in a contestant's keys, each computed by a rule.
std::vector<std::pair<std::string, double>> contest_values(const ContestBench& bench);

struct ContestKey {
  std::string path, value;
};
/// The keys of a row with their values. A <name> without a rule is a Problem.
base::Result<std::vector<ContestKey>> keys_of(const Contestant& contestant, const ContestBench& bench);

}  // namespace sixstep::analysis
