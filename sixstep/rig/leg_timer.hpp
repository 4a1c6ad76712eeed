// SPDX-License-Identifier: Apache-2.0
// The PWM timer of the board: three compare units that make pulses, and three legs, each on one of them with
// a dead time of its own (model.md 11). A leg says which switch it has on within the pulse and which in the
// rest of the period. six_step_modulator.hpp fills all three from a pair and one duty,
// three_leg_modulator.hpp from three commands.
#pragma once
#include <array>

#include "sixstep/plant/state.hpp"
#include "sixstep/rig/leg_channel.hpp"
#include "sixstep/rig/pulse.hpp"

namespace sixstep::rig {

class LegTimer {
 public:
  explicit LegTimer(const ModulatorConfig& config)
      : config_(config), dead_ticks_(config.in_counts(config.dead_ticks)) {}

  /// Nobody knows what the legs did before: whatever turns on waits. No pulse is on.
  void wake(const sim::Instant& t);
  /// A PWM period begins: the edges of the one before are gone.
  void start_period();
  void start_pulse(unsigned pulse, const sim::Instant& t, double duty);
  /// As a comparator does.
  void switch_pulse(unsigned pulse, bool on);
  /// As it stands before anything happens: that is no turn-on.
  void preset_pulse(unsigned pulse, bool on) { pulses_[pulse].on = on; }

  /// Of the changes from now on; what waits already waits as long as it was told.
  void set_dead_time(double ticks) { dead_ticks_ = config_.in_counts(ticks); }

  /// All legs off; the pulses go on.
  void disconnect() { outputs_ = {}; }
  void connect(unsigned leg, control::LegSides sides, unsigned pulse) {
    outputs_[leg] = {sides, static_cast<std::uint8_t>(pulse)};
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
  /// Of all pulses.
  std::int64_t turn_ons() const { return turn_ons_; }
  bool dead_time_at_commutation() const { return config_.dead_time_at_commutation; }

 private:
  struct Output {
    control::LegSides sides{};
    std::uint8_t pulse = 0;
  };
  void look_at_legs();

  ModulatorConfig config_;
  double dead_ticks_ = 0.0;  ///< as the timer has it
  std::array<Pulse, 3> pulses_{};
  std::array<LegChannel, 3> legs_{};
  std::array<Output, 3> outputs_{};
  unsigned chopping_ = 0;                           ///< the pulses that have edges to come, as bits
  sim::Instant wait_end_ = sim::Instant::never();   ///< the first one of a leg
  sim::Instant next_edge_ = sim::Instant::never();  ///< of pulses and legs
  plant::Gates gates_{};                            ///< what the legs say
  std::int64_t turn_ons_ = 0;
};

}  // namespace sixstep::rig
