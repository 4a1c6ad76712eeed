// SPDX-License-Identifier: Apache-2.0
// The results of a run: numbers and verdicts.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/loops/pole_placement.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/plant/audit.hpp"
#include "sixstep/rig/chip_port.hpp"
#include "sixstep/study/measure/device_watch.hpp"

namespace sixstep::study {

struct Verdict {
  std::string figure;  // "settling time of current"
  std::string unit;
  double measured = 0.0;
  std::optional<double> min, max;  // bounds of the requirement
  bool ok = false;
  double zero = 0.0;  // figure_zero(): the value from which the figure's size counts
};

struct ComparisonResult {
  std::string figure;
  std::string unit;
  double measured = 0.0;
  double value = 0.0;  // value of the source to compare with
  std::string source;
  double zero = 0.0;                       // figure_zero()
  std::optional<double> uncertainty = {};  // of a recording: 95 % bound of measured - value; infinite if a
                                           // single pulse or period shows no spread
  bool fails = false;                      // beyond the recording's tolerance

  /// How far measured and value are apart beyond the uncertainty.
  double beyond() const {
    const double apart = measured > value ? measured - value : value - measured;
    return apart > *uncertainty ? apart - *uncertainty : 0.0;
  }
};

/// A recording as it was laid over a signal, for a picture: every n-th row.
struct LaidRecording {
  std::string name, unit;  // of the signal
  std::string file;
  std::vector<double> t_s, recorded, simulated;
};

using plant::EnergyBook;

/// Number of events of one kind.
struct EventCount {
  std::string event;
  std::int64_t count = 0;
};

/// Gains of a loop in the run, and their origin.
struct LoopGains {
  std::string loop;           // "current", "speed", "position"
  double d1 = 0.0, d0 = 0.0;  // position: d1 is the gain, d0 = 0
  std::string origin;         // "given as d1, d0", "pole placement, settle_s = 0.001, damping = 0.9"
  std::optional<design::PolePlacement> derivation;  // derivation of the exact design for the same loop
  std::vector<design::DerivationStep> steps{};  // derivation of a law that is no PI: d1 is its gain on the
                                                // error, d0 = 0
};

/// A trip: the product drive turned the bridge off and latched the reason; the motor then coasted to the end
/// of the run.
struct Trip {
  double at_s = 0.0;                 // time of the tick that latched the reason
  std::vector<std::string> reasons;  // such as "over-current"; all that were detected in that tick
  int hall_line = 0;                 // 1..3: the faulty line; 0: none or undecidable
};

/// A core that computed the drive in parallel with the host (rig/lockstep_core.hpp). Each output of the core
/// equalled the host's output to the bit, unless there is a fault.
struct CoreRun {
  std::string core;         // "Cortex-M4F"
  std::uint64_t calls = 0;  // calls of the core's entry functions
};

/// A chip that ran its own firmware instead of the library's drive (rig/chip_drive.hpp).
struct ChipReport {
  std::string chip;  // "ATmega2560"
  double clock_Hz = 0.0, period_s = 0.0;
  rig::ChipTimes times;
  double latest_edge_s = 0.0;  // largest delay of a shown Hall edge
  std::string sent;            // text from the chip's serial line, in whole lines

  /// True if periods passed without a control interrupt; the last one may still be unanswered.
  bool overran() const { return times.periods > times.conversions + 1; }
};

struct Outcome {
  std::vector<Verdict> verdicts;
  std::vector<ComparisonResult> comparisons;               // those with recordings last
  std::shared_ptr<const std::vector<LaidRecording>> laid;  // null: none
  std::optional<plant::EnergyBook> energy;                 // empty without Listeners::keep_books
  std::optional<plant::Laws> laws;
  std::vector<DeviceLoss> devices;  // empty if the bridge lacks values (tells_losses)
  std::vector<EventCount> events;
  std::vector<LoopGains> gains;
  std::vector<design::DerivationStep> sensorless_steps;  // derivation of a sensorless drive's numbers
  std::vector<design::DerivationStep> field_steps;       // derivation of a field-oriented drive's numbers
  std::vector<design::DerivationStep> estimator_steps;   // derivation of a field-oriented drive's angle
                                                         // estimator
  design::MotorModel motor;
  std::optional<base::Problem> fault;  // fault of the run (shoot-through, impossible Hall code) or of the
                                       // drive
  std::optional<Trip> trip;            // time and reasons of this fault, if the drive stopped
  std::vector<std::string> notes;      // facts of this run, such as a requested event that did not occur; a
                                       // sentence each
  std::vector<std::string> remarks;    // facts about the drive that a user may not expect (run/remarks.hpp),
                                       // a sentence each
  std::optional<CoreRun> core;         // empty: only the host ran
  std::optional<ChipReport> chip;      // empty: no chip
  std::int64_t shunt_samples = 0, blind_samples = 0;  // samples of low-side shunts; those that showed too
                                                      // little, so that the drive kept its last values
  double simulated_s = 0.0;
  std::int64_t segments = 0;
  std::int64_t turn_ons = 0;  // of the leg that is chopped at the time, or of all three upper switches
  int chopped_switches = 1;   // number of switches that turn_ons counts
  std::uint64_t digest = 0;   // digest of every event of the trajectory (study/measure/digest.hpp)

  bool passed() const {
    for (const Verdict& v : verdicts)
      if (!v.ok) return false;
    for (const ComparisonResult& c : comparisons)
      if (c.fails) return false;
    return !fault;
  }
};

}  // namespace sixstep::study
