// SPDX-License-Identifier: Apache-2.0
// The PWM timer of the board: three compare units that make pulses, and three legs, each on one of them with
// a dead time of its own (model.md 11). A leg says which switch it has on within the pulse and which in the
// rest of the period. six_step_modulator.hpp fills all three from a pair and one duty,
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

  /// Nobody knows what the legs did before: whatever turns on waits. No pulse is on.
  void wake(const sim::Instant& t);
  /// A PWM period begins: the edges of the one before are gone.
  void start_period(const sim::Instant& t);
  void start_pulse(unsigned pulse, const sim::Instant& t, double duty);
  /// As a comparator does.
  void switch_pulse(unsigned pulse, bool on);
  /// As it stands before anything happens: that is no turn-on.
  void preset_pulse(unsigned pulse, bool on) { pulses_[pulse].on = on; }

  /// Of the changes from now on; what waits already waits as long as it was told.
  void set_dead_time(double ticks);

  /// All legs off; the pulses go on.
  void disconnect() { outputs_ = {}; }
  /// A leg that is not connected yet.
  void connect(unsigned leg, control::LegSides sides, unsigned pulse) {
    Output& output = outputs_[pulse];
    output.in_pulse = static_cast<Switches>(output.in_pulse | switch_of(leg, sides.pulse));
    output.in_rest = static_cast<Switches>(output.in_rest | switch_of(leg, sides.rest));
  }
  /// What a leg does, waits and all, goes on in another one (model.md 3).
  void hand_over(unsigned from, unsigned to);
  /// The legs follow pulses and connections. What leg `late` would turn on at this instant waits too.
  static constexpr int none_late = -1;
  void update(const sim::Instant& t, int late = none_late);

  const sim::Instant& next_edge() const { return next_edge_; }
  /// Does the edges due at `now`; false where none was.
  bool act(const sim::Instant& now);

  const plant::Gates& gates() const { return gates_; }
  bool pulse_on(unsigned pulse) const { return pulses_[pulse].on; }
  /// No edge will come before the next command.
  bool steady() const { return next_edge_ == sim::Instant::never(); }
  /// Of the first pulse, so that a PWM reads its own frequency however many legs follow other pulses.
  std::int64_t turn_ons() const { return turn_ons_; }
  /// Without those of a period that begins at this instant.
  std::int64_t turn_ons_before(const sim::Instant& t) const {
    return began_at(t) ? before_period_ : turn_ons_;
  }
  /// Whether the last period began at this instant.
  bool began_at(const sim::Instant& t) const { return period_begun_ == t; }
  bool dead_time_at_commutation() const { return config_.dead_time_at_commutation; }

 private:
  /// Switches that are to be on, upper ones in bits 0 to 2, lower ones in bits 3 to 5: what all legs are told
  /// is known without asking one by one.
  using Switches = std::uint8_t;
  static constexpr unsigned of_leg = 0b001'001;
  static Switches switch_of(unsigned leg, LegSide side) {
    const unsigned low = side == LegSide::low, high = side == LegSide::high;
    return static_cast<Switches>((low << 3 | high) << leg);
  }
  static LegSide side_of(Switches switches, unsigned leg) {
    return switches >> leg & 1 ? LegSide::high : switches >> leg & 0b1000 ? LegSide::low : LegSide::none;
  }
  /// Of the legs that follow a pulse.
  struct Output {
    Switches in_pulse = 0, in_rest = 0;
  };
  Switches asked() const;
  void look_at_legs();
  void set_gates(unsigned switches) { gates_ = {switches & 0b111, switches >> 3}; }
  const sim::Instant& first_edge() const;

  ModulatorConfig config_;
  double dead_ticks_ = 0.0;  ///< as the timer has it
  bool waits_ = false;       ///< it has or had a dead time; else the legs' own times are not asked
  std::array<Pulse, 3> pulses_{};
  std::array<LegChannel, 3> legs_{};
  std::array<Output, 3> outputs_{};                 ///< of each pulse
  Switches told_{};                                 ///< what the legs were told
  std::uint8_t waiting_ = 0;                        ///< the legs that wait, as bits
  unsigned chopping_ = 0;                           ///< the pulses that have edges to come, as bits
  sim::Instant wait_end_ = sim::Instant::never();   ///< the first one of a leg
  sim::Instant next_edge_ = sim::Instant::never();  ///< of pulses and legs
  plant::Gates gates_{};                            ///< what the legs say
  std::int64_t turn_ons_ = 0, before_period_ = 0;
  sim::Instant period_begun_ = sim::Instant::never();
};

}  // namespace sixstep::rig
