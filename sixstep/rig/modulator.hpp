// SPDX-License-Identifier: Apache-2.0
// The timer and comparators of the board: a bridge command becomes gates. Owns PWM edges, event comparators
// and one channel per leg, which keeps the dead time (MODEL 3, MODEL2 11). Six-step fills three leg commands
// from a pair and one duty; where the pair moves on, the leg that leaves it hands its channel to the one that
// enters.
#pragma once
#include <array>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/plant/state.hpp"
#include "sixstep/rig/leg_channel.hpp"
#include "sixstep/rig/timeline.hpp"

namespace sixstep::rig {

struct ModulatorConfig {
  std::int64_t period_ticks = 30'000'000;
  bool centre_aligned = false;
  double dead_ticks = 0.0;
  bool dead_time_at_commutation = false;
  double timer_ticks = 0.0;  ///< ps per count of the timer; 0: edges anywhere
};

/// A command as the board holds it: scalars widened to double.
struct BoardCommand {
  bool enabled = false;
  control::Pair pair{};
  double duty = 0.0;
  control::Chopping chopping = control::Chopping::soft;
  control::Watch watch = control::Watch::none;
  double on_below_A = 0.0, off_above_A = 0.0;
};

/// A level that a comparator waits for: `current` of a role against a threshold.
struct ArmedComparator {
  bool armed = false;
  bool switches_off = false;  ///< waits for the current to rise above, else to fall below
  double level_A = 0.0;
};

class Modulator {
 public:
  explicit Modulator(const ModulatorConfig& config)
      : config_(config), dead_ticks_(in_counts(config.dead_ticks)) {}

  /// A PWM period begins at t with this command. |duty| = 1 has no off gap, 0 no on-time.
  void start_period(const sim::Instant& t, const BoardCommand& command);
  /// The pair changes at a Hall edge: PWM is not restarted, duty not resampled.
  void commutate(const sim::Instant& t, control::Pair pair);
  /// New thresholds between periods (the setpoint of an event hysteresis jumped).
  void rearm(const sim::Instant& t, const BoardCommand& command) { tell_legs(t, take(t, command)); }
  void turn_off(const sim::Instant& t);
  /// Of the changes from now on; what waits already waits as long as it was told.
  void set_dead_time(double ticks) { dead_ticks_ = in_counts(ticks); }

  sim::Instant next_edge() const;
  /// Does the edges due at `now`; false where none was.
  bool act(const sim::Instant& now);
  /// Switches where a comparator's current is beyond its level; how many did.
  template <class Real>
  int compare(const sim::Instant& now, const plant::PerLeg<Real>& i);
  /// A comparator reached its level (0: motor or source leg, 1: sink leg).
  void comparator_tripped(const sim::Instant& now, int which);

  /// What comparator `which` waits for now.
  ArmedComparator comparator(int which) const;
  /// Its current as a combination of the phase currents.
  plant::PerLeg<double> comparator_weights(int which) const;

  const plant::Gates& gates() const { return gates_; }
  const BoardCommand& command() const { return command_; }
  bool source_on() const { return source_on_; }
  /// No edge will come before the next command: duty 0 or 1, or off.
  bool steady() const { return next_edge() == sim::Instant::never(); }
  std::int64_t turn_ons() const { return turn_ons_; }

 private:
  /// The leg that a new pair brought in.
  using Entered = LegChannel*;
  Entered take(const sim::Instant& t, const BoardCommand& command);
  Entered hand_over(control::Pair to);
  void tell_legs(const sim::Instant& t, Entered entered);
  void switch_source(bool on);
  void look_at_legs();
  double in_counts(double ticks) const;

  ModulatorConfig config_;
  double dead_ticks_ = 0.0;  ///< as the timer has it
  BoardCommand command_{};
  bool source_on_ = false, sink_on_ = true;  ///< sink_on_: hard chopping's second comparator
  sim::Instant on_edge_ = sim::Instant::never(), off_edge_ = sim::Instant::never(),
               wait_end_ = sim::Instant::never();  ///< wait_end_: the next one of a leg
  std::array<LegChannel, 3> legs_{};
  plant::Gates gates_{};  ///< what the channels say
  std::int64_t turn_ons_ = 0;
};

template <class Real>
int Modulator::compare(const sim::Instant& now, const plant::PerLeg<Real>& i) {
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
