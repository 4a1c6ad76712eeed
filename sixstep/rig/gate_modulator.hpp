// SPDX-License-Identifier: Apache-2.0
// Modulator of a board whose chip sets the gates directly (chip_drive.hpp). Duty and pair are measured from
// the gates of the last period, like with an instrument.
#pragma once
#include "sixstep/plant/state.hpp"
#include "sixstep/rig/pulse.hpp"

namespace sixstep::rig {

/// Gates as bits 0..5: upper a, lower a, upper b, lower b, upper c, lower c (control/gates.hpp).
struct ChipGates {
  std::uint32_t bits = 0;
};

inline std::uint32_t gates_of(const plant::Gates& g) {
  std::uint32_t bits = 0;
  for (unsigned k = 0; k < 3; ++k)
    bits |= (g.high[k] ? 1U : 0U) << (2 * k) | (g.low[k] ? 1U : 0U) << (2 * k + 1);
  return bits;
}

class GateModulator {
 public:
  using Command = ChipGates;

  explicit GateModulator(const ModulatorConfig&) {}

  static Command before_first() { return {}; }

  /// Sets the gates at the pins from t on.
  void take(const sim::Instant& t, const Command& command) {
    note(t);
    for (unsigned k = 0; k < 3; ++k) {
      const bool upper = (command.bits >> (2 * k) & 1U) != 0;
      if (upper && !gates_.high[k]) {
        source_ = static_cast<int>(k);
        ++turn_ons_;
      }
      gates_.high[k] = upper;
      gates_.low[k] = (command.bits >> (2 * k + 1) & 1U) != 0;
    }
  }
  /// Ends the period over which the duty is measured. Call it at each control sample.
  void end_period(const sim::Instant& t) {
    note(t);
    const double period = sim::seconds_between(begun_, t);
    duty_ = period > 0 ? on_s_ / period : 0.0;
    on_s_ = 0.0;
    begun_ = t;
  }

  /// No edge is scheduled, because gates change only at the chip's stops.
  sim::Instant next_edge() const { return sim::Instant::never(); }
  bool act(const sim::Instant&) { return false; }
  bool steady() const { return false; }
  /// Has no effect, because the firmware generates the dead time.
  void set_dead_time(double) {}

  const plant::Gates& gates() const { return gates_; }
  std::int64_t turn_ons() const { return turn_ons_; }
  std::int64_t turn_ons_before(const sim::Instant&) const { return turn_ons_; }
  /// True if the bus drives a current through the winding: an upper and a lower switch are on.
  bool drives() const { return gates_.high.any() && gates_.low.any(); }
  bool enabled() const { return gates_.high.any() || gates_.low.any(); }
  /// duty(): fraction of the last whole period in which drives() was true. source(): leg whose upper switch
  /// was turned on last.
  double duty() const { return duty_; }
  int source() const { return source_; }

 private:
  void note(const sim::Instant& t) {
    if (drives()) on_s_ += sim::seconds_between(noted_, t);
    noted_ = t;
  }

  plant::Gates gates_{};
  sim::Instant begun_{}, noted_{};
  double on_s_ = 0.0, duty_ = 0.0;
  int source_ = 0;
  std::int64_t turn_ons_ = 0;
};

}  // namespace sixstep::rig
