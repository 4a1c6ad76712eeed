// SPDX-License-Identifier: Apache-2.0
// Modulator of three leg commands on the board's timer (model.md 11): each leg follows a separate pulse. Hall
// edges have no effect.
#pragma once
#include "sixstep/rig/leg_timer.hpp"

namespace sixstep::rig {

class ThreeLegModulator {
 public:
  /// The three commands in the form of the board: duties are doubles.
  using Command = control::LegCommands<double>;

  explicit ThreeLegModulator(const ModulatorConfig& config) : timer_(config) {}

  /// Command in period 0 of a board whose commands take effect one period later: all legs switch at duty 0.5,
  /// without voltage between them.
  static Command before_first() {
    constexpr control::LegCommand<double> half{control::LegState::pwm, control::PwmSwitches::complementary,
                                               0.5};
    return {.enabled = true, .leg = {half, half, half}};
  }

  void start_period(const sim::Instant& t, const Command& command);
  void turn_off(const sim::Instant& t);
  void set_dead_time(double ticks) { timer_.set_dead_time(ticks); }

  const sim::Instant& next_edge() const { return timer_.next_edge(); }
  /// Executes the edges due at `now`; false if there were none.
  bool act(const sim::Instant& now) {
    const plant::Gates before = timer_.gates();
    const bool acted = timer_.act(now);
    count(before);
    return acted;
  }

  const plant::Gates& gates() const { return timer_.gates(); }
  const Command& command() const { return command_; }
  bool steady() const { return timer_.steady(); }
  /// Number of turn-ons of the three upper switches, by a pulse or by a command for the whole period.
  std::int64_t turn_ons() const { return turn_ons_; }
  std::int64_t turn_ons_before(const sim::Instant& t) const {
    return timer_.began_at(t) ? before_period_ : turn_ons_;
  }

 private:
  void count(const plant::Gates& before) {
    for (unsigned k = 0; k < 3; ++k) turn_ons_ += timer_.gates().high[k] && !before.high[k];
  }

  Command command_{};
  LegTimer timer_;
  std::int64_t turn_ons_ = 0, before_period_ = 0;
};

}  // namespace sixstep::rig
