// SPDX-License-Identifier: Apache-2.0
// Studies all 36 ways to connect a motor. Each has a result of the theory, a result of the simulation, and
// cures.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "sixstep/analysis/curve/operating_point.hpp"
#include "sixstep/analysis/for_each.hpp"
#include "sixstep/analysis/wiring/cures.hpp"
#include "sixstep/analysis/wiring/wiring_bench.hpp"

namespace sixstep::analysis {

/// Number of free runs: one from rest in the middle of each of the six sectors.
inline constexpr std::size_t starts = 6;
constexpr double start_deg(std::size_t n) { return 60.0 * static_cast<double>(n) + 30; }

/// The measured end of a free run (WiringBench::watched_from_s), and the turns since its start.
struct FreeRun {
  double speed_rad_s = 0.0;  ///< mean speed
  double turns = 0.0;        ///< electrical turns in the measured time, with sign
  double way_turns = 0.0;    ///< electrical turns from the start to the end, with sign
  double phase_rms_A = 0.0;  ///< rms over all three phases
  double peak_A = 0.0;       ///< peak of half the sum of the phase currents' magnitudes
  double supply_A = 0.0;     ///< mean current from the supply
  double swing_deg = 0.0;    ///< electrical angle from the lowest to the highest position
  double rest_deg = 0.0;     ///< mean electrical angle, in [0, 360)
  double swing_Hz = 0.0;     ///< frequency of swings over the whole run: changes of direction, two per period
  std::vector<float> turned{};     ///< electrical turns since the start, one value per row
  std::vector<float> current_A{};  ///< half the sum of the phase currents' magnitudes, one value per row
};

/// Results of runs only, without theory.
struct WiringMeasured {
  WiringDoes does = WiringDoes::unclear;
  std::array<FreeRun, starts> runs{};
  double torque_Nm_A = 0.0;  ///< torque per ampere (half the sum of the currents' magnitudes), mean over a
                             ///< slow electrical turn
  double part = 0.0;         ///< torque_Nm_A divided by its value with straight wires
  std::vector<float> torque_over_turn{};  ///< torque per ampere over this turn: turned_rows values, at 1, 3,
                                          ///< 5 .. degrees
  std::uint64_t digest = 0;               ///< digest of all seven runs
};

struct WiringCase {
  rig::Wiring wiring;
  WiringTheory theory;
  WiringMeasured measured;
  std::vector<Cure> cures;
  bool agrees() const { return theory.does == measured.does; }
};

/// Means over the runs of all wirings with the same behaviour, from all starts; for peaks, the largest value.
/// A motor that runs well accelerates for much longer than a run lasts, because its current is discontinuous.
/// Its speed and currents are therefore taken from the settled state (curve/no_load.hpp), unless the sheet's
/// friction holds the motor.
struct Symptom {
  std::size_t ways = 0;
  double part = 0.0, speed_rad_s = 0.0, phase_rms_A = 0.0, peak_A = 0.0, supply_A = 0.0, swing_deg = 0.0,
         swing_Hz = 0.0;
};

struct WiringStudy {
  WiringSubject subject;
  WiringBench bench;
  plant::general::Machine machine;          ///< machine for which the theory computes the torque
  std::vector<WiringCase> cases;            ///< in the order of all_wirings()
  std::optional<OperatingPoint> settled{};  ///< settled state of straight wires without load

  std::size_t agreeing() const;
  const WiringCase& at(const rig::Wiring& wiring) const;
  /// The symptom of all wirings with this behaviour in the runs, of one wiring, and of straight wires.
  Symptom symptom(WiringDoes does) const;
  Symptom symptom(const WiringCase& one) const;
  Symptom straight() const;
  /// The first wiring with this behaviour in the runs; null if there is none.
  const WiringCase* example(WiringDoes does) const;
};

struct WiringOrder {
  WiringSubject subject{};
  ForEach for_each = one_after_the_other;
  std::function<bool()> keep_going{};  ///< false ends the study early with a Problem "was interrupted"
};

/// Returns the Problems of the sheet and of the bench.
base::Result<WiringStudy> study_wiring(const WiringOrder& order);

/// The run from the first start with straight wires, as a scenario for the user's file. The values of its
/// comparisons are measured in this run.
study::Scenario straight_run(const WiringStudy& study);

/// Classifies the runs of one wiring; `straight_Nm_A` is the measured torque per ampere of straight wires.
WiringDoes seen_in(const WiringMeasured& measured, double straight_Nm_A);

}  // namespace sixstep::analysis
