// SPDX-License-Identifier: Apache-2.0
// The PWM timer of the board. Three compare units generate pulses. Each of three legs follows one of the
// pulses, with dead time (model.md 11). In the pulse one switch of the leg is on; in the rest of the period
// the opposite switch, or no switch. six_step_modulator.hpp sets all three legs from a pair and one duty,
// three_leg_modulator.hpp from three commands.
#pragma once
#include <array>
#include <cstdint>

#include "sixstep/plant/state.hpp"
#include "sixstep/rig/leg_channel.hpp"
#include "sixstep/rig/pulse.hpp"

namespace sixstep::rig {

class LegTimer {
 public:
  explicit LegTimer(const ModulatorConfig& config)
      : config_(config), dead_ticks_(config.in_counts(config.dead_ticks)), waits_(dead_ticks_ > 0) {}

  /// Turns the timer on. Each switch that turns on waits for a dead time, because the legs' previous states
  /// are unknown. No pulse is on.
  void wake(const sim::Instant& t);
  /// Begins a PWM period and cancels the remaining edges of the previous period.
  void start_period(const sim::Instant& t);
  void start_pulse(unsigned pulse, const sim::Instant& t, double duty);
  /// Turns a pulse on or off independently of the period's edges, as a comparator does.
  void switch_pulse(unsigned pulse, bool on);
  /// Sets a pulse's initial state, which is not counted as a turn-on.
  void preset_pulse(unsigned pulse, bool on) { pulses_[pulse].on = on; }

  /// Sets the dead time, ps, for later changes. The end of a wait that has begun does not change.
  void set_dead_time(double ticks);

  /// Turns all legs off; the pulses continue.
  void disconnect() { outputs_ = {}; }
  /// Connects a leg that is not connected yet.
  void connect(unsigned leg, control::LegSides sides, unsigned pulse) {
    Output& output = outputs_[pulse];
    output.in_pulse = static_cast<Switches>(output.in_pulse | switch_of(leg, sides.pulse));
    output.in_rest = static_cast<Switches>(output.in_rest | switch_of(leg, sides.rest));
  }
  /// Moves a leg's state, including its wait, to another leg (model.md 3).
  void hand_over(unsigned from, unsigned to);
  /// Sets the legs' commands from pulses and connections. If leg `late` would turn a switch on at this
  /// instant, this switch also waits for the dead time.
  static constexpr int none_late = -1;
  void update(const sim::Instant& t, int late = none_late);

  const sim::Instant& next_edge() const { return next_edge_; }
  /// Executes the edges due at `now`; false if there were none.
  bool act(const sim::Instant& now);

  const plant::Gates& gates() const { return gates_; }
  bool pulse_on(unsigned pulse) const { return pulses_[pulse].on; }
  /// True if no edge occurs before the next command.
  bool steady() const { return next_edge_ == sim::Instant::never(); }
  /// Turn-ons of the first pulse. They determine the PWM frequency, even if legs follow the other pulses.
  std::int64_t turn_ons() const { return turn_ons_; }
  /// Turn-ons before t, without the turn-ons of a period that begins at t.
  std::int64_t turn_ons_before(const sim::Instant& t) const {
    return began_at(t) ? before_period_ : turn_ons_;
  }
  /// True if the last period began at this instant.
  bool began_at(const sim::Instant& t) const { return period_begun_ == t; }
  bool dead_time_at_commutation() const { return config_.dead_time_at_commutation; }

 private:
  /// Commanded switches of all legs in one number: upper switches in bits 0 to 2, lower switches in bits 3 to
  /// 5.
  using Switches = std::uint8_t;
  static constexpr unsigned of_leg = 0b001'001;
  static Switches switch_of(unsigned leg, LegSide side) {
    const unsigned low = side == LegSide::low, high = side == LegSide::high;
    return static_cast<Switches>((low << 3 | high) << leg);
  }
  static LegSide side_of(Switches switches, unsigned leg) {
    return switches >> leg & 1 ? LegSide::high : switches >> leg & 0b1000 ? LegSide::low : LegSide::none;
  }
  /// Switches, of all legs that follow a pulse, that are on in the pulse and in the rest of the period.
  struct Output {
    Switches in_pulse = 0, in_rest = 0;
  };
  Switches asked() const;
  void look_at_legs();
  void set_gates(unsigned switches) { gates_ = {switches & 0b111, switches >> 3}; }
  const sim::Instant& first_edge() const;

  ModulatorConfig config_;
  double dead_ticks_ = 0.0;  ///< rounded to counts of the timer
  bool waits_ = false;       ///< true: the dead time is or was above 0; false: the legs' waits need no check
  std::array<Pulse, 3> pulses_{};
  std::array<LegChannel, 3> legs_{};
  std::array<Output, 3> outputs_{};                 ///< switches of each pulse
  Switches told_{};                                 ///< last commands to the legs
  std::uint8_t waiting_ = 0;                        ///< mask of the legs that wait
  unsigned chopping_ = 0;                           ///< mask of the pulses with a pending edge
  sim::Instant wait_end_ = sim::Instant::never();   ///< earliest end of a leg's wait
  sim::Instant next_edge_ = sim::Instant::never();  ///< next edge of pulses and legs
  plant::Gates gates_{};                            ///< gates that result from the legs' commands and waits
  std::int64_t turn_ons_ = 0, before_period_ = 0;
  sim::Instant period_begun_ = sim::Instant::never();
};

}  // namespace sixstep::rig
