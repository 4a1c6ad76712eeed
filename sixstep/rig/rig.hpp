// SPDX-License-Identifier: Apache-2.0
// The virtual board around the plant: samples, runs the controller, modulates, and plays the scenario's
// timeline. It is the System that sim::run drives; the order of things at one instant is act()'s (model.md
// 4b). What its chip runs is a template parameter (firmware.hpp).
#pragma once
#include <array>
#include <type_traits>

#include "sixstep/plant/hall.hpp"
#include "sixstep/plant/plant.hpp"
#include "sixstep/rig/firmware.hpp"
#include "sixstep/rig/modulator.hpp"
#include "sixstep/rig/timeline.hpp"

namespace sixstep::rig {

enum class Fault : std::uint8_t { none, shoot_through, impossible_hall };

/// Kinds of events, for the run's statistics.
enum class EventKind : std::uint8_t {
  sector_edge,
  diode_off,
  standstill,
  breakaway,
  comparator,
  tick,
  pwm_edge,
  count
};

template <class RealType, class Firmware, class PlantType = plant::Plant<RealType>>
class Rig {
 public:
  using Real = RealType;
  using Plant = PlantType;
  using Modulator = typename ModulatorFor<typename Firmware::Command>::type;
  using Config = typename Firmware::Config;
  using Tunings = std::vector<Tuning<Config>>;

  /// `tunings`: what the timeline's retune actions name. A copy of a rig is its snapshot.
  Rig(const Plant& plant, const Config& chip, const BoardConfig& board, Timeline timeline,
      Tunings tunings = {})
      : plant_(plant),
        timeline_(std::move(timeline)),
        tunings_(std::move(tunings)),
        board_(board),
        modulator_(board.modulator),
        firmware_(chip, board,
                  {static_cast<double>(plant_.constants().pole_pairs), plant_.state().sector,
                   plant::hall_code(plant_.sector())}) {}

  sim::Instant now() const { return now_; }
  sim::Instant next_known() const { return due_; }
  bool act();
  double expand(double wanted) { return plant_.expand(wanted); }
  template <class Visit>
  void guards(Visit&& visit) const;
  void advance(Real s, const sim::Instant& to) {
    plant_.advance(s);
    now_ = to;
  }
  void apply(int id);

  /// Another future. What is done up to now begins the new timeline as it began the old one, and the
  /// configuration in effect may differ in nothing that has been felt.
  void replace_future(Timeline timeline, const Tuning<Config>& first, Tunings tunings);

  const Plant& plant() const { return plant_; }
  const Modulator& modulator() const { return modulator_; }
  const Firmware& firmware() const { return firmware_; }
  const auto& telemetry() const { return firmware_.telemetry(); }
  double current_reference_A() const {
    return to_si(telemetry().current_reference_A, board_.bases.current_A);
  }
  double speed_reference_rad_s() const {
    return to_si(telemetry().speed_reference_rad_s, board_.bases.speed_rad_s);
  }
  double setpoint() const { return setpoint_; }
  Fault fault() const { return fault_; }
  /// H1 H2 H3 as the board's pins have them: the probes', but for a line that is stuck.
  std::uint8_t pins() const {
    return static_cast<std::uint8_t>((plant::hall_code(plant_.sector()) & ~stuck_low_) | stuck_high_);
  }
  std::int64_t event_count(EventKind what) const { return event_counts_[static_cast<std::size_t>(what)]; }
  /// True between a control tick and the segment that follows it.
  bool ticked() const { return ticked_; }
  /// When the chip looks next; in open loop at a steady bridge that may be never.
  const sim::Instant& next_tick() const { return next_tick_; }

 private:
  /// What only six-step has: a sign, a pair that moves on at Hall edges, comparators.
  static constexpr bool six_step = std::is_same_v<Modulator, SixStepModulator>;
  using BoardAnswer = typename Modulator::Command;

  sim::Instant next_due() const;
  bool watching() const {
    if constexpr (six_step) return modulator_.watching();
    return false;
  }
  bool compared() {
    if constexpr (six_step) return watching() && compare();
    return false;
  }
  /// By itself, so that the run loop around act() keeps its registers.
  [[gnu::noinline]] bool act_on_due();
  bool compare();
  bool do_timeline();
  void do_action(const Action& action);
  bool do_tick();
  bool do_half_tick();
  void set_hall_line(double line, bool stuck_high, bool stuck_low);
  void control_step(bool starts_period);
  void follow_waveform();
  void skip_idle_ticks();
  sim::Instant told_next() const;
  void sector_edge();
  void hall_edge();
  void commutate();
  template <class Visit>
  void comparator_guards(Visit&& visit) const;
  void trip(int which);
  void let_go();
  void count(EventKind what) { ++event_counts_[static_cast<std::size_t>(what)]; }

  // Small fields last: the plant begins on a cache line, and each gap might cost a whole one.
  Plant plant_;
  Timeline timeline_;
  Tunings tunings_;
  BoardConfig board_;
  Modulator modulator_;

  sim::Instant now_{}, next_tick_{};
  sim::Instant due_{};  ///< the earliest of all clocks
  std::size_t next_action_ = 0;
  double setpoint_ = 0.0;
  std::size_t waveform_ = 0;  ///< the action whose waveform the setpoint follows, where moving_
  BoardAnswer pending_ = Modulator::before_first();  ///< waits for its period
  BoardAnswer loaded_{};                             ///< sampled in the middle: what the timer takes up next
  std::array<std::int64_t, static_cast<std::size_t>(EventKind::count)> event_counts_{};
  Firmware firmware_;
  bool moved_ = true;  ///< a located event changed what the board drives
  bool moving_ = false;
  bool pending_reversed_ = false,
       reversed_ = false;                        ///< sign of the command that waits, and of the one in effect
  bool loaded_reversed_ = false, half_ = false;  ///< half_: the next tick is a middle
  bool ticked_ = false;
  Fault fault_ = Fault::none;
  std::uint8_t stuck_high_ = 0, stuck_low_ = 0;  ///< Hall lines, as bits of a code
};

template <class Real, class Firmware, class Plant>
sim::Instant Rig<Real, Firmware, Plant>::next_due() const {
  sim::Instant next = modulator_.next_edge();
  if (next_tick_ < next) next = next_tick_;
  if (next_action_ < timeline_.size() && timeline_[next_action_].at < next) next = timeline_[next_action_].at;
  return next;
}

/// All that is due now, decided by the clocks alone: scenario step, control tick, PWM edge, comparator,
/// repeated until nothing is due. The gates follow at the end, so that a leg never sees an order of things at
/// one instant.
template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::act() {
  ticked_ = false;
  // mutant: now_ < due_ && !moved_ && !watching() => now_ < due_ && !watching()
  if (now_ < due_ && !moved_ && !watching()) return true;
  return act_on_due();
}

template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::act_on_due() {
  if (moved_) due_ = next_due();
  moved_ = false;
  do {
    while (fault_ == Fault::none && !(now_ < due_)) {
      // mutant: !do_timeline() && !do_tick() => !do_tick() && !do_timeline()
      if (!do_timeline() && !do_tick() && modulator_.act(now_)) count(EventKind::pwm_edge);
      due_ = next_due();
    }
  } while (fault_ == Fault::none && compared());
  if (fault_ == Fault::none && !plant_.set_gates(modulator_.gates())) fault_ = Fault::shoot_through;
  return fault_ == Fault::none;
}

template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::do_tick() {
  if (now_ < next_tick_) return false;
  if (board_.sampled_in_middle) return do_half_tick();
  next_tick_.ticks += board_.modulator.period_ticks;
  control_step(true);
  skip_idle_ticks();
  count(EventKind::tick);
  return ticked_ = true;
}

template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::control_step(bool starts_period) {
  if (moving_) follow_waveform();
  SampleInstant<Real> instant{plant_.state(),
                              plant_.mode().legs,
                              plant_.constants().pole_pairs,
                              now_,
                              static_cast<std::uint64_t>(event_count(EventKind::tick)),
                              pins(),
                              reversed_};
  if constexpr (six_step) instant.duty = modulator_.command().duty;
  const auto& answer = firmware_.tick(instant, setpoint_);
  if (Firmware::fault_ends_run && answer.fault) fault_ = Fault::impossible_hall;
  if (!answer.enabled) let_go();
  BoardAnswer command = widened(answer, board_.bases);
  bool reversed = false;
  if constexpr (six_step) reversed = firmware_.reversed();
  if (board_.delayed) {
    std::swap(command, pending_);
    // mutant: std::swap(reversed, pending_reversed_); => nothing
    std::swap(reversed, pending_reversed_);
  }
  if (board_.sampled_in_middle) {
    loaded_ = command;
    loaded_reversed_ = reversed;
    return;
  }
  reversed_ = reversed;
  if constexpr (six_step)
    if (!starts_period) return modulator_.rearm(now_, command);
  modulator_.start_period(now_, command);
}

/// Turning off waits for no register: neither for a delayed command nor for one that the timer has loaded.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::let_go() {
  modulator_.turn_off(now_);
  pending_.enabled = loaded_.enabled = false;
}

/// The tick that sees the next action which is the chip's: a setpoint or a tuning; never where none is left.
template <class Real, class Firmware, class Plant>
sim::Instant Rig<Real, Firmware, Plant>::told_next() const {
  const std::int64_t period = board_.modulator.period_ticks;
  for (std::size_t n = next_action_; n < timeline_.size(); ++n)
    if (timeline_[n].kind == ActionKind::setpoint || timeline_[n].kind == ActionKind::retune)
      // mutant: timeline_[n].at.ticks + period - 1 => timeline_[n].at.ticks + period
      return {(timeline_[n].at.ticks + period - 1) / period * period, 0.0};
  return sim::Instant::never();
}

/// Open loop with a steady bridge asks nothing of the coming ticks until the chip is told something: they are
/// not simulated.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::skip_idle_ticks() {
  // mutant: moving_ => false
  if (!firmware_.open_loop() || moving_ || board_.delayed || board_.commutate_at_sample ||
      !modulator_.steady())
    return;
  if (const sim::Instant told = told_next(); told > now_) next_tick_ = told;
}

template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::hall_edge() {
  firmware_.captured(pins(), now_);
  if constexpr (six_step)
    if (!board_.commutate_at_sample) commutate();
}

template <class Real, class Firmware, class Plant>
template <class Visit>
void Rig<Real, Firmware, Plant>::guards(Visit&& visit) const {
  plant_.guards(visit);
  if constexpr (six_step)
    if (watching()) comparator_guards(visit);
}

template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::apply(int id) {
  using namespace plant;
  if (id >= guard::first_free) {
    count(EventKind::comparator);
    moved_ = true;
    if constexpr (six_step) trip(id - guard::first_free);
    return;
  }
  if (id < guard::standstill) count(EventKind::diode_off);
  if (id == guard::standstill) count(EventKind::standstill);
  if (id == guard::breakaway_forward || id == guard::breakaway_backward) count(EventKind::breakaway);
  if (!plant_.apply(id)) return;
  sector_edge();
  moved_ = true;
}

/// The rig of the thesis's experiments: ideal measurement, the loops alone.
template <class Real, class Scalar = Real>
using LeanRig = Rig<Real, LeanDrive<Scalar>>;

}  // namespace sixstep::rig

#include "sixstep/rig/rig_inputs.hpp"
#include "sixstep/rig/rig_six_step.hpp"
