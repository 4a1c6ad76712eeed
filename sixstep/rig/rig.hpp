// SPDX-License-Identifier: Apache-2.0
// The virtual board around the plant: it samples, runs the controller, modulates, and executes the scenario's
// timeline. It is the System of sim::run. act() determines the order of actions at one instant (model.md 4b).
// The chip's firmware is a template parameter (firmware.hpp).
#pragma once
#include <algorithm>
#include <array>
#include <type_traits>

#include "sixstep/plant/plant.hpp"
#include "sixstep/plant/terminals.hpp"
#include "sixstep/rig/crossing_comparators.hpp"
#include "sixstep/rig/event_kind.hpp"
#include "sixstep/rig/fault.hpp"
#include "sixstep/rig/firmware.hpp"
#include "sixstep/rig/front_end.hpp"
#include "sixstep/rig/modulator.hpp"
#include "sixstep/rig/ports_of.hpp"
#include "sixstep/rig/probes.hpp"
#include "sixstep/rig/timeline.hpp"
#include "sixstep/rig/wiring.hpp"

namespace sixstep::rig {

template <class RealType, class Firmware, class PlantType = plant::Plant<RealType>>
class Rig {
 public:
  using Real = RealType;
  using Plant = PlantType;
  using Modulator = typename ModulatorFor<typename Firmware::Command>::type;
  using Config = typename Firmware::Config;
  using Tunings = std::vector<Tuning<Config>>;
  using Wires = typename WiringFor<Plant>::type;
  using Probes = typename ProbesFor<Plant>::type;

  /// `tunings`: configurations of the timeline's retune actions. `wires`: connection of motor and board at
  /// the start. `probes`: mounting of the Hall probes. A copy of a rig is a snapshot of it.
  Rig(const Plant& plant, const Config& chip, const BoardConfig& board, Timeline timeline,
      Tunings tunings = {}, const Wires& wires = {}, const ProbeGiven& probes = {})
      : plant_(plant),
        timeline_(std::move(timeline)),
        tunings_(std::move(tunings)),
        board_(board),
        modulator_(board.modulator),
        wires_(wires),
        probes_(probes, plant_.state()),
        firmware_(
            chip, board,
            {board.believed_pole_pairs > 0 ? board.believed_pole_pairs
                                           : static_cast<double>(plant_.constants().pole_pairs),
             probes_.sector(plant_.state().sector),
             read_by_chip(wires_.at_pins(probes_.code(plant_.sector())), reads_arrangement<Firmware>(chip)),
             shaft_angle()}),
        front_end_(front_end_before(board.front_end)),
        crossings_(crossings_before(board.front_end)),
        listens_(listens()) {
    if constexpr (keeps_time) next_tick_ = sim::Instant::never();
    if constexpr (has_crossings)
      if (crossings_.fitted() && crossings_.lines() != 0)
        firmware_.captured_crossing(crossings_.lines(), now_);
  }

  sim::Instant now() const { return now_; }
  sim::Instant next_known() const { return due_; }
  bool act();
  double expand(double wanted) {
    if constexpr (has_crossings)
      if (crossings_.fitted()) return plant_.expand(std::min(wanted, crossings_.longest_s()));
    return plant_.expand(wanted);
  }
  template <class Visit>
  void guards(Visit&& visit) const {
    plant_.guards(visit);
    if constexpr (can_be_askew) probe_guards(visit);
    if constexpr (six_step)
      if (watching()) comparator_guards(visit);
    if constexpr (has_crossings)
      if (crossings_.fitted()) crossing_guards(visit);
  }
  void end_at(Real s) { plant_.end_at(s); }
  void advance(Real s, const sim::Instant& to) {
    if constexpr (may_listen)
      if (listens_) show_segment(s, to);
    plant_.advance(s);
    now_ = to;
  }
  void apply(int id);

  /// Replaces the part of the timeline that lies in the future. The new timeline must begin with all actions
  /// done so far. `first`, the configuration in effect, may differ only in values that have had no effect
  /// yet.
  void replace_future(Timeline timeline, const Tuning<Config>& first, Tunings tunings);

  const Plant& plant() const { return plant_; }
  const Modulator& modulator() const { return modulator_; }
  const Firmware& firmware() const { return firmware_; }
  /// Motion of the sensor's shaft over the present segment, up to its fraction s, which is the instant `to`.
  ShaftMotion<Real> shaft_motion(Real s, const sim::Instant& to) const;
  /// Requires a firmware that has converters.
  const auto& front_end() const { return front_end_; }
  /// Requires a firmware that captures the edges of comparators at the terminals.
  const auto& crossings() const { return crossings_; }
  const auto& telemetry() const { return firmware_.telemetry(); }
  double current_reference_A() const {
    return to_si(telemetry().current_reference_A, board_.bases.current_A);
  }
  double speed_reference_rad_s() const {
    return to_si(telemetry().speed_reference_rad_s, board_.bases.speed_rad_s);
  }
  double position_reference_deg() const {
    if constexpr (requires { telemetry().position.profiled; })
      if (telemetry().position.profiled) return static_cast<double>(telemetry().position.reference_deg);
    return setpoint_;
  }
  double setpoint() const { return setpoint_; }
  Fault fault() const { return fault_; }
  /// H1 H2 H3 at the board's pins as bits 2, 1, 0: the lines of the probes wired to them, except for stuck
  /// lines.
  std::uint8_t pins() const {
    return static_cast<std::uint8_t>((wires_.at_pins(probes_.code(plant_.sector())) & ~stuck_low_) |
                                     stuck_high_);
  }
  /// True if a clock is due now that can change the Hall pins: a delayed edge, or an action of the timeline.
  bool pins_due() const {
    if constexpr (can_be_askew)
      if (!(now_ < probes_.next())) return true;
    return next_action_ < timeline_.size() && !(now_ < timeline_[next_action_].at);
  }
  const Wires& wires() const { return wires_; }
  /// Gates ordered by the board's legs: each leg has the gates of the phase that is connected to it.
  decltype(auto) leg_gates() const { return wires_.at_legs(plant_.gates()); }
  /// Rotor's sector that the code at the board's pins gives; the true sector if the code is invalid.
  int board_sector() const {
    if constexpr (std::is_same_v<Wires, StraightWiring>) return plant_.sector();
    const std::uint8_t seen = control::sector_of_hall(
        control::as_120_degrees(board_.hall_arrangement, wires_.at_pins(probes_.code(plant_.sector()))));
    return seen == control::no_sector ? plant_.sector() : seen;
  }
  /// Sector according to the motor's probes, regardless of their wires. The motor current is defined by this
  /// sector.
  int probe_sector() const {
    if constexpr (can_be_askew) return static_cast<int>((probes_.sector(plant_.state().sector) % 6 + 6) % 6);
    return plant_.sector();
  }
  std::int64_t event_count(EventKind what) const { return event_counts_[static_cast<std::size_t>(what)]; }
  /// True between a control tick and the segment that follows it.
  bool ticked() const { return ticked_; }
  /// Instant of the chip's next tick; never(), if the drive is in open loop and the bridge steady.
  const sim::Instant& next_tick() const { return next_tick_; }

 private:
  /// Six-step only: a command has a sign, its pair changes at Hall edges, and comparators may switch it.
  static constexpr bool six_step = std::is_same_v<Modulator, SixStepModulator>;
  using BoardAnswer = typename Modulator::Command;
  static constexpr bool can_be_askew = requires(Probes probes) { probes.next(); };
  /// True for a chip with its own clock, which stops where the plant must advance to its time
  /// (chip_drive.hpp).
  static constexpr bool keeps_time = requires(const Firmware& firmware) { firmware.next_stop(); };
  static constexpr bool has_front_end = requires(Firmware firmware) { firmware.registers(); };
  static constexpr bool looks_at_terminals = six_step && requires(Firmware firmware) {
    firmware.look_at_terminals(plant::PerLeg<Real>{});
  };
  static constexpr bool has_crossings = six_step && requires(Firmware firmware) {
    firmware.captured_crossing(std::uint8_t{}, sim::Instant{});
  };
  static constexpr bool may_listen = has_front_end || requires(const Firmware& firmware) {
    firmware.follows_shaft();
  };
  static_assert(!has_crossings || (has_front_end && looks_at_terminals));
  bool sees_terminals() const {
    if constexpr (requires { firmware_.wants_terminals(); }) return firmware_.wants_terminals();
    return looks_at_terminals;
  }
  static constexpr int probe_ahead = plant::guard::first_free + 2, probe_behind = probe_ahead + 1,
                       crossing = probe_behind + 1;  // + leg

  /// Pins as the chip reads them: for a drive that does not know the arrangement, codes of probes 120 degrees
  /// apart.
  std::uint8_t read_by_chip(std::uint8_t pins, [[maybe_unused]] bool knows_arrangement) const {
    if constexpr (can_be_askew) {
      pins = code_at(board_.believed_lines, pins);
      if (!knows_arrangement) return control::as_120_degrees(board_.hall_arrangement, pins);
    }
    return pins;
  }
  std::uint8_t chip_pins() const {
    if constexpr (requires { firmware_.reads_arrangement(); })
      return read_by_chip(pins(), firmware_.reads_arrangement());
    else
      return read_by_chip(
          pins(), requires { requires Firmware::decodes_arrangement; });
  }
  static constexpr bool has_load_side = requires(const Plant& p) { p.series().load_w; };
  /// Pole pairs per turn of a sensor on the motor's shaft.
  std::int64_t sensor_pole_pairs() const {
    return board_.sensors.shaft.linear ? 1 : static_cast<std::int64_t>(plant_.constants().pole_pairs);
  }
  /// Angle of the shaft on which the sensor sits, at the start.
  plant::ShaftAngle<double> shaft_angle() const {
    if constexpr (has_load_side)
      if (board_.sensors.shaft.on_load)
        return in_sixths(static_cast<double>(plant_.constants().inv_gear) *
                         (static_cast<double>(plant_.state().sector) * base::sector_rad +
                          static_cast<double>(plant_.state().x)) /
                         static_cast<double>(plant_.constants().pole_pairs));
    return {plant_.state().sector, static_cast<double>(plant_.state().x), sensor_pole_pairs()};
  }
  bool listens() const;
  /// Not inlined, because few boards have a part that follows the plant between two samples.
  [[gnu::noinline]] void show_segment(Real s, const sim::Instant& to);
  void show_terminals();
  void show_signals(Real s, const sim::Instant& to);
  std::conditional_t<has_front_end, FrontEnd, NoFrontEnd> front_end_before(
      const FrontEndConfig& config) const;
  std::conditional_t<has_crossings, Crossings, NoCrossings> crossings_before(
      const FrontEndConfig& config) const;
  FrontEndSegment<Real> segment(Real s, const sim::Instant& to) const {
    return {plant_.expansion(),
            {wires_.phase(0), wires_.phase(1), wires_.phase(2)},
            plant_.mode().legs,
            s,
            now_,
            to,
            next_sample()};
  }
  template <class Visit>
  void crossing_guards(Visit&& visit) const;
  void pass_crossing(int leg);
  sim::Instant next_sample() const;
  sim::Instant next_due() const;
  bool watching() const {
    if constexpr (six_step) return modulator_.watching();
    return false;
  }
  bool compared() {
    if constexpr (six_step) return watching() && compare();
    return false;
  }
  /// Not inlined, so that the run loop around act() keeps its values in registers.
  [[gnu::noinline]] bool act_on_due();
  bool compare();
  bool do_timeline();
  void do_action(const Action& action);
  void act_on_general(const Action& action);
  bool do_tick();
  bool do_half_tick();
  bool do_chip();
  /// Time in which no Hall edge is expected, s, from now on.
  double quiet_s() const;
  void set_hall_line(double line, bool stuck_high, bool stuck_low);
  void rewire(const Action& action);
  void drift(const Action& action);
  void fail_shaft_sensor(const Action& action);
  void break_divider(std::size_t leg);
  void control_step(bool starts_period);
  void follow_waveform();
  void skip_idle_ticks();
  /// Takes a thermal step if one ends; called at control ticks.
  void warm_up() {
    if constexpr (requires { plant_.take_thermal_step(); })
      if (plant_.warms()) plant_.take_thermal_step();
  }
  sim::Instant told_next() const;
  void sector_edge();
  template <class Visit>
  void probe_guards(Visit&& visit) const;
  void pass_probe_edge(plant::ProbeEdge which);
  bool show_probes();
  void glitch(const Action& action);
  void hall_edge() {
    firmware_.captured(chip_pins(), now_);
    if constexpr (six_step)
      if (!board_.commutate_at_sample) commutate();
  }
  void commutate();
  template <class Answer>
  void move_pair(const Answer& answer);
  /// True for a firmware that requests an interrupt of its timer between two ticks.
  static constexpr bool has_commutation_clock = six_step && requires(const Firmware& f) {
    f.next_commutation();
  };
  bool do_commutation();
  template <class Visit>
  void comparator_guards(Visit&& visit) const;
  void trip(int which);
  void let_go();
  void count(EventKind what) { ++event_counts_[static_cast<std::size_t>(what)]; }

  // Small members last: the plant begins on a cache line, and padding might cost a whole line.
  Plant plant_;
  Timeline timeline_;
  Tunings tunings_;
  BoardConfig board_;
  Modulator modulator_;
  [[no_unique_address]] Wires wires_;
  [[no_unique_address]] Probes probes_;

  sim::Instant now_{}, next_tick_{};
  sim::Instant due_{};  ///< the earliest of all clocks
  std::size_t next_action_ = 0;
  double setpoint_ = 0.0;
  std::size_t waveform_ = 0;  ///< if moving_: index of the action whose waveform the setpoint follows
  BoardAnswer pending_ = Modulator::before_first();  ///< takes effect in the next period
  BoardAnswer loaded_{};                             ///< the timer's next command, of a board that samples in
                                                     ///< the middle of a period
  std::array<std::int64_t, static_cast<std::size_t>(EventKind::count)> event_counts_{};
  Firmware firmware_;
  [[no_unique_address]] std::conditional_t<has_front_end, FrontEnd, NoFrontEnd> front_end_;
  [[no_unique_address]] std::conditional_t<has_crossings, Crossings, NoCrossings> crossings_;
  bool listens_ = false;  ///< a port or the front end follows the plant between two samples
  bool moved_ = true;     ///< a located event changed the circuit
  bool moving_ = false;
  bool pending_reversed_ = false,
       reversed_ = false;                        ///< sign of the waiting command, and of the one in effect
  bool loaded_reversed_ = false, half_ = false;  ///< half_: the next sample is in the middle of a period
  bool ticked_ = false;
  Fault fault_ = Fault::none;
  std::uint8_t stuck_high_ = 0, stuck_low_ = 0;  ///< Hall lines, as bits of a code
};

}  // namespace sixstep::rig

#include "sixstep/rig/rig_act.hpp"
#include "sixstep/rig/rig_chip.hpp"
#include "sixstep/rig/rig_front_end.hpp"
#include "sixstep/rig/rig_inputs.hpp"
#include "sixstep/rig/rig_six_step.hpp"
