// SPDX-License-Identifier: Apache-2.0
// An Outcome holds what a run leaves behind: numbers and verdicts.
#pragma once
#include <cstdint>
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
  std::optional<double> min, max;  // the requirement
  bool ok = false;
};

struct ComparisonResult {
  std::string figure;
  std::string unit;
  double measured = 0.0;
  double value = 0.0;  // what the source says
  std::string source;
};

using plant::EnergyBook;

/// How often each kind of event happened.
struct EventCount {
  std::string event;
  std::int64_t count = 0;
};

/// Gains a loop ran with and where they come from.
struct LoopGains {
  std::string loop;           // "current", "speed", "position"
  double d1 = 0.0, d0 = 0.0;  // position: d1 is the gain, d0 = 0
  std::string origin;         // "given as d1, d0", "pole placement, settle_s = 0.001, damping = 0.9"
  std::optional<design::PolePlacement> derivation;  // of the exact design for the same loop
  std::vector<design::DerivationStep> steps{};      // of what is no PI: d1 is its gain on the error, d0 = 0
};

/// The product drive turned the bridge off and latched why; the motor coasted on to the end of the run.
struct Trip {
  double at_s = 0.0;                 // the tick that latched it
  std::vector<std::string> reasons;  // "over-current", all that were seen in that tick
  int hall_line = 0;                 // 1..3: the line to blame; 0: none, or it cannot be told
};

/// A core that ran the drive beside the host (rig/lockstep_core.hpp); each of its answers was the host's, to the
/// bit, unless the fault says otherwise.
struct CoreRun {
  std::string core;         // "Cortex-M4F"
  std::uint64_t calls = 0;  // of its entries
};

/// A chip that ran a firmware of its own in the drive's place (rig/chip_drive.hpp).
struct ChipReport {
  std::string chip;  // "ATmega2560"
  double clock_Hz = 0.0, period_s = 0.0;
  rig::ChipTimes times;
  double latest_edge_s = 0.0;  // by which a Hall edge was shown late at worst
  std::string sent;            // by its serial line, in whole lines

  /// Periods went by without a control interrupt; the one at the end may not have been answered yet.
  bool overran() const { return times.periods > times.conversions + 1; }
};

struct Outcome {
  std::vector<Verdict> verdicts;
  std::vector<ComparisonResult> comparisons;
  std::optional<plant::EnergyBook> energy;  // empty where nobody kept books (Listeners::keep_books)
  std::optional<plant::Laws> laws;
  std::vector<DeviceLoss> devices;  // empty where the bridge does not say enough (tells_losses)
  std::vector<EventCount> events;
  std::vector<LoopGains> gains;
  std::vector<design::DerivationStep> sensorless_steps;  // how a sensorless drive's numbers came about
  std::vector<design::DerivationStep> field_steps;       // how a field-oriented drive's did
  std::vector<design::DerivationStep> estimator_steps;   // and those of its estimator
  design::MotorModel motor;
  std::optional<base::Problem>
      fault;                       // what stopped the run (shoot-through, impossible Hall code) or the drive
  std::optional<Trip> trip;        // the same in parts, where it was the drive that stopped
  std::vector<std::string> notes;  // what was asked for and did not come about, a sentence each
  std::vector<std::string>
      remarks;                  // what the numbers mean and nobody asked, a sentence each (run/remarks.hpp)
  std::optional<CoreRun> core;  // empty: the host alone ran it
  std::optional<ChipReport> chip;  // empty: none did
  double simulated_s = 0.0;
  std::int64_t segments = 0;
  std::int64_t turn_ons =
      0;  // of the role that the duty or the first comparator chops, wherever commutation puts it, or of three upper switches
  int chopped_switches = 1;  // that turn_ons are of
  std::uint64_t digest = 0;  // of every bit of the trajectory (study/measure/digest.hpp)

  bool passed() const {
    for (const Verdict& v : verdicts)
      if (!v.ok) return false;
    return !fault;
  }
};

}  // namespace sixstep::study
