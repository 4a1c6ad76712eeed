// SPDX-License-Identifier: Apache-2.0
// Adapts a firmware to the interface of any_drive.hpp. The firmware's numbers are converted to SI units.
// Functions that the firmware does not have are empty.
#pragma once
#include "sixstep/rig/any_drive.hpp"
#include "sixstep/rig/fault.hpp"
#include "sixstep/rig/modulator.hpp"
#include "sixstep/rig/ports_of.hpp"

namespace sixstep::rig {

template <class Scalar>
control::BridgeCommand<double> in_si(const control::BridgeCommand<Scalar>& c, const Bases& bases) {
  return {.enabled = c.enabled,
          .pair = c.pair,
          .duty = to_si(c.duty, 1.0),
          .chopping = c.chopping,
          .chopped = c.chopped,
          .watch = c.watch,
          .overlap = to_si(c.overlap, 1.0),
          .on_below_A = to_si(c.on_below_A, bases.current_A),
          .off_above_A = to_si(c.off_above_A, bases.current_A),
          .fault = c.fault};
}

template <class Scalar>
control::LegCommands<double> in_si(const control::LegCommands<Scalar>& c, const Bases& bases) {
  return widened(c, bases);
}

template <class Scalar>
void tell_in_si(const control::Telemetry<Scalar>& of, const Bases& bases, control::Telemetry<double>& out) {
  out.motor_current_A = to_si(of.motor_current_A, bases.current_A);
  out.current_reference_A = to_si(of.current_reference_A, bases.current_A);
  out.speed_reference_rad_s = to_si(of.speed_reference_rad_s, bases.speed_rad_s);
  out.duty = to_si(of.duty, 1.0);
  if constexpr (requires { of.position.profiled; }) {
    out.position.profiled = of.position.profiled;
    out.position.reference_deg = static_cast<double>(of.position.reference_deg);
  }
}

/// Type of a firmware's command in SI units.
template <class Firmware>
using SiCommand = decltype(in_si(std::declval<const typename Firmware::Command&>(), Bases{}));

template <class Firmware>
class ConfigOf final : public DriveConfig<SiCommand<Firmware>> {
 public:
  ConfigOf(typename Firmware::Config its, const Bases& its_bases)
      : config(std::move(its)), bases(its_bases) {}
  std::unique_ptr<DriveInterface<SiCommand<Firmware>>> made(const BoardConfig& board,
                                                            const PowerUp& power_up) const override;
  bool decodes_arrangement() const override { return reads_arrangement<Firmware>(config); }

  const typename Firmware::Config config;
  const Bases bases;
};

template <class Firmware>
class DriveOf final : public DriveInterface<SiCommand<Firmware>> {
 public:
  using Interface = DriveInterface<SiCommand<Firmware>>;
  using Answer = typename Interface::Answer;

  DriveOf(const ConfigOf<Firmware>& of, const BoardConfig& board, const PowerUp& power_up)
      : firmware_(of.config, board, power_up), bases_(board.bases) {}

  std::unique_ptr<Interface> clone() const override { return std::unique_ptr<Interface>(new DriveOf(*this)); }
  DriveTraits traits() const override {
    DriveTraits t{.mode = firmware_.mode(),
                  .open_loop = firmware_.open_loop(),
                  .follows_setpoint_at_once = firmware_.follows_setpoint_at_once(),
                  .wants_terminals = wants_terminals};
    if constexpr (follows_shaft) t.follows_shaft = firmware_.follows_shaft();
    if constexpr (requires { Firmware::decodes_arrangement; }) t.decodes_arrangement = true;
    return t;
  }
  void tick(const SampleInstant<double>& instant, double setpoint, Answer& out) override {
    out.command = in_si(firmware_.tick(instant, setpoint), bases_);
    tell_in_si(firmware_.telemetry(), bases_, out.told);
    if constexpr (requires { firmware_.moved_on(); }) out.moved_on = firmware_.moved_on();
    if constexpr (requires { firmware_.field_held(); }) out.field = firmware_.field_held();
    note(out);
  }
  void hall_interrupt([[maybe_unused]] std::uint8_t pins, [[maybe_unused]] const sim::Instant& at,
                      [[maybe_unused]] Answer& out) override {
    if constexpr (requires { firmware_.hall_interrupt(pins, at); }) {
      out.command = in_si(firmware_.hall_interrupt(pins, at), bases_);
      note(out);
    }
  }
  void commutation_interrupt([[maybe_unused]] const sim::Instant& at, [[maybe_unused]] Answer& out) override {
    if constexpr (has_clock) {
      out.command = in_si(firmware_.commutation_interrupt(at), bases_);
      note(out);
    }
  }
  void captured(std::uint8_t pins, const sim::Instant& at) override { firmware_.captured(pins, at); }
  void captured_crossing([[maybe_unused]] std::uint8_t lines,
                         [[maybe_unused]] const sim::Instant& at) override {
    if constexpr (wants_terminals) firmware_.captured_crossing(lines, at);
  }
  void look_at_terminals([[maybe_unused]] const plant::PerLeg<double>& terminal_V) override {
    if constexpr (wants_terminals) firmware_.look_at_terminals(terminal_V);
  }
  void follow([[maybe_unused]] const ShaftMotion<double>& motion) override {
    if constexpr (follows_shaft) firmware_.follow(motion);
  }
  void break_divider([[maybe_unused]] std::size_t leg) override {
    if constexpr (wants_terminals) firmware_.break_divider(leg);
  }
  void request_run(bool run) override { firmware_.request_run(run); }
  void request_clear() override { firmware_.request_clear(); }
  void retune(const DriveConfig<SiCommand<Firmware>>& config, double setpoint_unit) override {
    firmware_.retune({static_cast<const ConfigOf<Firmware>&>(config).config, setpoint_unit});
  }
  Diagnosis diagnosis() const override { return firmware_.diagnosis(); }
  bool fault_ends_run() const override { return ends_run(firmware_); }
  Registers* registers() override { return registers_of(firmware_); }
  ShaftPorts* shaft_ports() override { return shaft_ports_of(firmware_); }

 private:
  static constexpr bool wants_terminals = requires(Firmware f) {
    f.look_at_terminals(plant::PerLeg<double>{});
  };
  static constexpr bool follows_shaft = requires(const Firmware& f) { f.follows_shaft(); };
  static constexpr bool has_clock = requires(const Firmware& f) { f.next_commutation(); };

  DriveOf(const DriveOf&) = default;
  void note(Answer& out) const {
    if constexpr (requires { firmware_.reversed(); }) out.reversed = firmware_.reversed();
    if constexpr (requires { firmware_.holds_commutation(); })
      out.holds_commutation = firmware_.holds_commutation();
    if constexpr (has_clock) out.next_commutation = firmware_.next_commutation();
  }

  Firmware firmware_;
  Bases bases_;
};

template <class Firmware>
std::unique_ptr<DriveInterface<SiCommand<Firmware>>> ConfigOf<Firmware>::made(const BoardConfig& board,
                                                                              const PowerUp& power_up) const {
  BoardConfig its = board;
  its.bases = bases;
  return std::make_unique<DriveOf<Firmware>>(*this, its, power_up);
}

}  // namespace sixstep::rig
