// SPDX-License-Identifier: Apache-2.0
// Studies all 36 ways to connect a motor: the theory's result and the simulation's for each, and its cures.
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

/// The rotor begins at rest in the middle of each of the six sectors.
inline constexpr std::size_t starts = 6;
constexpr double start_deg(std::size_t n) { return 60.0 * static_cast<double>(n) + 30; }

/// The measured end of a free run (WiringBench::watched_from_s), and the way since its start.
struct FreeRun {
  double speed_rad_s = 0.0;        ///< mean
  double turns = 0.0;              ///< electrical, of the measured time, signed
  double way_turns = 0.0;          ///< electrical, from the start to the end, signed
  double phase_rms_A = 0.0;        ///< root of the mean square of all three phases
  double peak_A = 0.0;             ///< peak of half the sum of the phase currents' magnitudes
  double supply_A = 0.0;           ///< mean
  double swing_deg = 0.0;          ///< electrical, from lowest to highest angle
  double rest_deg = 0.0;           ///< electrical, in [0, 360): mean angle
  double swing_Hz = 0.0;           ///< rate of swings over the whole run: changes of direction, two a period
  std::vector<float> turned{};     ///< electrical turns since the start, one a row
  std::vector<float> current_A{};  ///< half the sum of the phase currents' magnitudes, one a row
};

/// Results of runs alone, without theory.
struct WiringMeasured {
  WiringDoes does = WiringDoes::unclear;
  std::array<FreeRun, starts> runs{};
  double torque_Nm_A = 0.0;  ///< per ampere of half the sum of magnitudes, mean over a slow electrical turn
  double part = 0.0;         ///< relative to straight wires
  std::vector<float> torque_over_turn{};  ///< the same, turned_rows of them, at 1, 3, 5 .. degrees
  std::uint64_t digest = 0;               ///< digest of all seven runs
};

struct WiringCase {
  rig::Wiring wiring;
  WiringTheory theory;
  WiringMeasured measured;
  std::vector<Cure> cures;
  bool agrees() const { return theory.does == measured.does; }
};

/// Means over the runs of all wirings with the same behaviour, over wirings and starts; of the peaks the
/// largest. A motor that runs well accelerates for much longer than a run lasts, because its current is
/// discontinuous. Its speed and currents are then those of the settled state (curve/no_load.hpp), unless the
/// sheet's friction holds it.
struct Symptom {
  std::size_t ways = 0;
  double part = 0.0, speed_rad_s = 0.0, phase_rms_A = 0.0, peak_A = 0.0, supply_A = 0.0, swing_deg = 0.0,
         swing_Hz = 0.0;
};

struct WiringStudy {
  WiringSubject subject;
  WiringBench bench;
  plant::general::Machine machine;          ///< machine of the theory's torque
  std::vector<WiringCase> cases;            ///< in the order of all_wirings()
  std::optional<OperatingPoint> settled{};  ///< straight wires without load

  std::size_t agreeing() const;
  const WiringCase& at(const rig::Wiring& wiring) const;
  /// Symptoms over all wirings with this behaviour in the runs; of one wiring; of straight wires.
  Symptom symptom(WiringDoes does) const;
  Symptom symptom(const WiringCase& one) const;
  Symptom straight() const;
  /// The first wiring with this behaviour in the runs; null: there is none.
  const WiringCase* example(WiringDoes does) const;
};

struct WiringOrder {
  WiringSubject subject{};
  ForEach for_each = one_after_the_other;
  std::function<bool()> keep_going{};  ///< false ends it early: a Problem "was interrupted"
};

/// Problems are those of sheet and bench.
base::Result<WiringStudy> study_wiring(const WiringOrder& order);

/// The run from the first start with straight wires, for a file of the user. Each comparison has the value that this run
/// measures.
study::Scenario straight_run(const WiringStudy& study);

/// Classifies the runs of one wiring; `straight_Nm_A` is the measured torque per ampere of straight wires.
WiringDoes seen_in(const WiringMeasured& measured, double straight_Nm_A);

}  // namespace sixstep::analysis
