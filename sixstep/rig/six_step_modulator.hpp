// SPDX-License-Identifier: Apache-2.0
// Modulator of six-step on the board's timer (model.md 3). It converts a pair with one duty, or with armed
// comparators, to the commands of three legs. The legs of the pair follow the same pulse. When the pair
// changes, the pulse continues. The leg that leaves the pair passes its state, with any wait for a dead time,
// to the leg that enters.
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/rig/leg_timer.hpp"

namespace sixstep::rig {

/// A BridgeCommand in the form of the board: numbers are doubles.
struct BoardCommand {
  bool enabled = false;
  control::Pair pair{};
  double duty = 0.0;
  control::Chopping chopping = control::Chopping::soft;
  control::ChoppedSwitch chopped = control::ChoppedSwitch::upper;
  control::Watch watch = control::Watch::none;
  double overlap = 0.0;
  double on_below_A = 0.0, off_above_A = 0.0;
};

/// Level at which a comparator switches. comparator_weights() defines the compared current.
struct ArmedComparator {
  bool armed = false;
  bool switches_off = false;  ///< true: switches off when the current rises above the level; false: switches
                              ///< on when the current falls below the level
  double level_A = 0.0;
};

class SixStepModulator {
 public:
  using Command = BoardCommand;

  explicit SixStepModulator(const ModulatorConfig& config) : timer_(config) {}

  /// Command in period 0 of a board whose commands take effect one period later: all gates off.
  static BoardCommand before_first() { return {}; }

  /// Begins a PWM period at t with this command. With a duty of 1 there is no gap, with a duty of 0 no pulse.
  void start_period(const sim::Instant& t, const BoardCommand& command);
  /// Changes the pair at a Hall edge. The PWM period continues, the duty is not sampled again, and no leg
  /// overlaps until the next period.
  void commutate(const sim::Instant& t, control::Pair pair, control::ChoppedSwitch chopped);
  /// Changes the pair; the chopped switch (upper or lower) does not change.
  void commutate(const sim::Instant& t, control::Pair pair) { commutate(t, pair, command_.chopped); }
  /// Sets new thresholds within a period, after the setpoint of an event hysteresis has jumped.
  void rearm(const sim::Instant& t, const BoardCommand& command) {
    const int entered = take(t, command);
    fill_legs(t, entered);
  }
  void turn_off(const sim::Instant& t);
  void set_dead_time(double ticks) { timer_.set_dead_time(ticks); }

  const sim::Instant& next_edge() const { return timer_.next_edge(); }
  /// Executes the edges due at `now`; false if there were none.
  bool act(const sim::Instant& now) { return timer_.act(now); }
  /// True if comparators are armed.
  bool watching() const { return command_.watch != control::Watch::none; }
  /// Switches the pulse of each comparator whose current is beyond the level. Returns the number of switched
  /// pulses.
  template <class Real>
  int compare(const sim::Instant& now, const plant::PerLeg<Real>& i);
  /// Switches the pulse of comparator `which`, whose current has reached the level. Comparator 0 is for the
  /// motor current or the source leg, 1 for the sink leg.
  void comparator_tripped(const sim::Instant& now, int which);

  /// The level at which comparator `which` switches next.
  ArmedComparator comparator(int which) const;
  /// Weights of the phase currents in the current that comparator `which` compares.
  plant::PerLeg<double> comparator_weights(int which) const;

  /// Present gates. If source and sink of the pair are the same leg, both switches of this leg are commanded
  /// on. The timer cannot command this state, so that gates() sets it, and the plant rejects the
  /// shoot-through.
  plant::Gates gates() const {
    plant::Gates gates = timer_.gates();
    if (command_.enabled && command_.pair.source == command_.pair.sink) gates.high |= gates.low;
    return gates;
  }
  const BoardCommand& command() const { return command_; }
  bool source_on() const { return timer_.pulse_on(source_pulse); }
  /// True if no edge occurs before the next command: duty 0 or 1, or off.
  bool steady() const { return timer_.steady(); }
  std::int64_t turn_ons() const { return timer_.turn_ons(); }
  std::int64_t turn_ons_before(const sim::Instant& t) const { return timer_.turn_ons_before(t); }

 private:
  /// Pulses of the timer. sink_pulse is for the second comparator in hard chopping, overlap_pulse for the leg
  /// that overlaps at a commutation.
  static constexpr unsigned source_pulse = 0, sink_pulse = 1, overlap_pulse = 2;

  int take(const sim::Instant& t, const BoardCommand& command);
  int hand_over(control::Pair to);
  void fill_legs(const sim::Instant& t, int entered);

  BoardCommand command_{};
  LegTimer timer_;
};

template <class Real>
int SixStepModulator::compare(const sim::Instant& now, const plant::PerLeg<Real>& i) {
  int switched = 0;
  for (int which = 0; which < 2; ++which) {
    const ArmedComparator c = comparator(which);
    if (!c.armed) continue;
    const plant::PerLeg<double> weight = comparator_weights(which);
    const Real current = Real(weight[0]) * i[0] + Real(weight[1]) * i[1] + Real(weight[2]) * i[2];
    if (c.switches_off ? current > Real(c.level_A) : current < Real(c.level_A)) {
      comparator_tripped(now, which);
      ++switched;
    }
  }
  return switched;
}

}  // namespace sixstep::rig
