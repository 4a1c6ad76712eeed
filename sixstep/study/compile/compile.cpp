// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/compile.hpp"

#include <algorithm>

#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/operating_limits.hpp"
#include "sixstep/design/loops/rotor_sensing.hpp"
#include "sixstep/study/compile/basis.hpp"
#include "sixstep/study/compile/general_plant.hpp"
#include "sixstep/study/compile/timeline.hpp"
#include "sixstep/study/scenario/changes.hpp"

namespace sixstep::study {

namespace {

/// The loop's gains as given, else by pole placement; the exact design is derived beside given gains too.
template <class Loop>
base::Result<LoopGains> loop_gains(const Loop& loop, const std::string& name, const design::ZohPlant& plant,
                                   double usual_settle_s, double period_s) {
  LoopGains out;
  out.loop = name;
  const double settle = loop.settle_s.value_or(usual_settle_s),
               damping = loop.damping.value_or(design::usual_damping);
  base::Result<design::PolePlacement> placed = design::place_poles(plant, settle, damping, period_s);
  const GivenGains given = given_gains(loop, "control." + name);
  if (!given.problems.empty()) return given.problems;
  if (!placed && !given.gains) return placed.problems();
  if (placed) out.derivation = *placed;
  out.d1 = given.gains ? given.gains->d1 : placed->gains.d1;
  out.d0 = given.gains ? given.gains->d0 : placed->gains.d0;
  out.origin = given.gains ? given.origin : "pole placement from settle_s and damping";
  return out;
}

plant::Shaft shaft_of(const design::MotorModel& motor, const Load& load) {
  plant::Shaft shaft = motor.shaft;
  // At the motor's side of the gear, as if the shaft were rigid.
  shaft.J_kg_m2 += load.inertia_kg_m2 / (load.gear * load.gear);
  shaft.B_Nm_s += load.viscous_Nm_s / (load.gear * load.gear);
  shaft.coulomb_Nm += load.coulomb_Nm / load.gear;
  shaft.static_Nm = load.static_Nm / load.gear;
  shaft.locked = load.locked;
  return shaft;
}

/// The duty above which the middle of the period lies in the on-time, and the amplifier has settled.
double least_visible_duty(const Scenario& s) {
  const double settle = s.sensors.shunt_settle_s / s.pwm.period_s;
  const double duty = s.pwm.alignment == Alignment::centre ? 2 * settle : 0.5 + settle;
  return std::min(duty, 1.0);
}

rig::SensorsConfig sensors_of(const Scenario& s, double L_over_R_s) {
  const Sensors& from = s.sensors;
  rig::SensorsConfig to;
  to.currents = from.currents;
  to.current = {from.adc_bits,
                from.current_range_A.value_or(0.0),
                true,
                from.current_offset_A,
                from.current_gain_error,
                from.current_noise_A};
  to.calibrated = from.calibrated;
  to.least_duty = least_visible_duty(s);
  to.commutation_samples = static_cast<std::uint8_t>(from.commutation_samples);
  to.fade = base::exp(-s.pwm.period_s / L_over_R_s);
  to.measures_bus = from.bus == BusSensing::adc;
  to.bus = {from.adc_bits,   from.bus_range_V.value_or(0.0), false, from.bus_offset_V, from.bus_gain_error,
            from.bus_noise_V};
  to.rotor_from_hall = from.rotor == RotorSensing::hall;
  to.decodes_hall = breaks_a_hall_line(s);
  to.capture_Hz = from.capture_Hz;
  to.timeout_s = from.timeout_s;
  to.edges = static_cast<std::uint8_t>(from.speed_edges);  // 0 is settled where the loops are known
  to.seed = static_cast<std::uint64_t>(from.seed);
  return to;
}

rig::BoardConfig board_of(const Scenario& s, double L_over_R_s) {
  rig::BoardConfig board;
  board.modulator.period_ticks = sim::to_instant(s.pwm.period_s).ticks;
  board.modulator.centre_aligned = s.pwm.alignment == Alignment::centre;
  board.modulator.dead_ticks = static_cast<double>(sim::to_instant(s.bridge.dead_time_s).ticks);
  board.modulator.dead_time_at_commutation = s.bridge.dead_time_at_commutation;
  board.modulator.timer_ticks = s.pwm.timer_Hz > 0 ? sim::ticks_per_second / s.pwm.timer_Hz : 0.0;
  board.modulator.minimum_pulse_ticks = static_cast<double>(sim::to_instant(s.pwm.minimum_pulse_s).ticks);
  board.commutate_at_sample = s.pwm.commutation == CommutationAt::sample;
  board.delayed = s.pwm.delay_periods > 0;
  board.sampled_in_middle = s.pwm.sample == SampleAt::middle;
  board.sensors = sensors_of(s, L_over_R_s);
  return board;
}

control::Watch watch_of(const CurrentLoop& loop) {
  if (loop.comparator == Comparator::sampled) return control::Watch::none;
  return loop.on == HysteresisOn::motor ? control::Watch::motor : control::Watch::phase;
}

base::Problems add_current_loop(const Scenario& s, const Basis& basis, Tuned& out) {
  if (s.control.current.type != CurrentLoopType::pi) return {};
  const design::ZohPlant plant =
      design::current_plant(2 * basis.motor.machine.R_ohm, 2 * basis.motor.machine.L_H, s.pwm.period_s);
  base::Result<LoopGains> gains =
      loop_gains(s.control.current, "current", plant, design::usual_current_settle_s, s.pwm.period_s);
  if (!gains) return gains.problems();
  out.drive.current = {gains->d1, gains->d0, basis.bus_V};
  out.gains.push_back(*gains);
  return {};
}

/// What the speed controller's output does to the speed: torque at once, or the bus through the winding,
/// whose inductance is too fast to count (thesis 6.2.2): J dw/dt = K_t (d U - K_t w)/R - B w.
design::ZohPlant speed_plant_of(const Scenario& s, const Basis& basis, double torque_limit_Nm) {
  const plant::Shaft& shaft = basis.shaft;
  if (s.control.speed.output == SpeedOutput::current)
    return design::speed_plant(torque_limit_Nm, shaft.J_kg_m2, shaft.B_Nm_s, s.pwm.period_s);
  const double K_t = basis.motor.K_t_Nm_A, per_V = K_t / (2 * basis.motor.machine.R_ohm);
  return design::speed_plant(per_V * basis.bus_V, shaft.J_kg_m2, shaft.B_Nm_s + per_V * K_t, s.pwm.period_s);
}

base::Problems add_speed_loop(const Scenario& s, const Basis& basis, Tuned& out) {
  const double torque_limit =
      s.control.speed.torque_limit_Nm.value_or(design::usual_torque_limit_Nm(basis.motor, basis.bus_V));
  base::Result<LoopGains> gains = loop_gains(s.control.speed, "speed", speed_plant_of(s, basis, torque_limit),
                                             design::usual_speed_settle_s, s.pwm.period_s);
  if (!gains) return gains.problems();
  out.drive.speed = {gains->d1, gains->d0, 1.0};
  out.gains.push_back(*gains);
  if (s.control.speed.output == SpeedOutput::duty) {
    out.drive.speed_control = control::SpeedControl::duty;
    return {};
  }
  out.drive.current_at_full_torque_A = torque_limit / basis.motor.K_t_Nm_A;
  out.drive.current_limit_A = s.control.current.limit_A.value_or(out.drive.current_at_full_torque_A);
  // A bound behind the PI that the PI does not know of would let its integral wind up.
  if (out.drive.current_limit_A < out.drive.current_at_full_torque_A)
    out.drive.speed.limit = out.drive.current_limit_A / out.drive.current_at_full_torque_A;
  return {};
}

/// Edges for the loop that looks at them (design/loops/rotor_sensing.hpp).
void settle_edges(const Scenario& s, const Basis& basis, Compiled& out) {
  rig::SensorsConfig& sensors = out.board.sensors;
  if (sensors.edges != 0) return;
  const bool cascade = s.control.speed.output == SpeedOutput::current;
  const double full_A =
      cascade ? out.drive.current_at_full_torque_A : basis.bus_V / (2 * basis.motor.machine.R_ohm);
  const double full_rad_s2 = full_A * basis.motor.K_t_Nm_A / basis.shaft.J_kg_m2;
  // Without a speed loop its gain is 0, and so is the window.
  sensors.window_s = design::hall_window_s(design::speed_crossover_rad_s(out.drive.speed.d1, full_rad_s2));
  sensors.edges = sensors.window_s > 0.0 ? 6 : 1;
}

base::Problems add_loops(const Scenario& s, const Basis& basis, Tuned& out) {
  const control::Mode mode = s.control.mode;
  if (mode == control::Mode::off || mode == control::Mode::duty) return {};
  const bool has_current_loop =
      mode == control::Mode::current || s.control.speed.output == SpeedOutput::current;
  if (has_current_loop)
    if (base::Problems problems = add_current_loop(s, basis, out); !problems.empty()) return problems;
  if (mode == control::Mode::current) return {};
  if (base::Problems problems = add_speed_loop(s, basis, out); !problems.empty()) return problems;
  if (mode == control::Mode::speed) return {};
  out.drive.position_gain = s.control.position.gain_rad_s_per_deg;
  const std::optional<double>& limit = s.control.position.speed_limit_rad_s;
  out.drive.speed_limit_rad_s = limit.value_or(basis.bus_V / basis.motor.K_t_Nm_A);
  out.gains.push_back({"position", out.drive.position_gain, 0.0,
                       "given as gain_rad_s_per_deg, for at most " +
                           base::rounded(out.drive.speed_limit_rad_s, 4) + " rad/s, " +
                           (limit ? "as given" : "the bus over K_t"),
                       std::nullopt});
  return {};
}

/// The controller of a scenario that does not change it.
base::Result<Tuned> tuned(const Scenario& s, const Basis& basis) {
  Tuned out;
  out.drive.mode = s.control.mode;
  out.drive.chopping = s.pwm.chopping;
  out.drive.nominal_bus_V = basis.bus_V;
  out.drive.current_control = s.control.current.type == CurrentLoopType::pi
                                  ? control::CurrentControl::pi
                                  : control::CurrentControl::hysteresis;
  out.drive.hysteresis = {s.control.current.band_A, watch_of(s.control.current)};
  if (base::Problems problems = add_loops(s, basis, out); !problems.empty()) return problems;
  add_extras(s, basis, out.drive);
  // What a limit can hold is judged on the drive as designed; one of a series that strays from it is run.
  if (!s.designed_for)
    if (base::Problems problems = check_limits(s, basis, out.drive); !problems.empty()) return problems;
  return out;
}

/// What [[at]] makes of it. Sensors stay as they were laid out for the start.
base::Problems add_later(const Scenario& s, const Basis& basis, Compiled& out) {
  const std::vector<const At*> order = in_order(s);
  out.later.reserve(order.size());
  for (const At* at : order) {
    if (!retunes(*at)) continue;
    const Scenario then = settled(s, at);
    base::Result<Tuned> later = tuned(then, basis);
    if (!later) return told_of_event(s, *at, later.problems());
    if (out.product) later->product = product_around(then, basis, later->drive, out.board.sensors);
    out.later.push_back(std::move(*later));
  }
  return {};
}

}  // namespace

base::Problems told_of_event(const Scenario& s, const At& at, base::Problems problems) {
  const std::string event = "at[" + std::to_string(&at - s.at.data()) + "].";
  for (base::Problem& problem : problems)
    for (const char* table : {"control", "pwm", "bridge"})
      if (problem.where.starts_with(table)) {
        problem.where = event + problem.where;
        break;
      }
  return problems;
}

double current_settling_s(const Scenario& s) {
  return s.control.current.settle_s.value_or(design::usual_current_settle_s);
}

template <class Loop>
GivenGains given_gains(const Loop& loop, const std::string& where) {
  GivenGains out;
  const bool d = loop.d1 || loop.d0, k = loop.kp || loop.ki, rule = loop.settle_s || loop.damping;
  const auto wrong = [&](const char* key, const char* limit, const char* cure) {
    out.problems.push_back({where + "." + key, "", limit, cure});
  };
  if (d && (k || rule))
    wrong(loop.d1 ? "d1" : "d0",
          k ? "contradicts kp, ki: the same gains are given twice"
            : "contradicts settle_s, damping: gains are either given or designed",
          "keep one of: d1 and d0 | kp and ki | settle_s and damping");
  else if (k && rule)
    wrong(loop.kp ? "kp" : "ki", "contradicts settle_s, damping: gains are either given or designed",
          "keep one of: d1 and d0 | kp and ki | settle_s and damping");
  else if (d && !(loop.d1 && loop.d0))
    wrong(loop.d1 ? "d1" : "d0", "is only half of the gains", loop.d1 ? "give d0 too" : "give d1 too");
  else if (k && !(loop.kp && loop.ki))
    wrong(loop.kp ? "kp" : "ki", "is only half of the gains", loop.kp ? "give ki too" : "give kp too");
  else if (d)
    out = {design::PiGains{*loop.d1, *loop.d0}, "given as d1, d0", {}};
  else if (k)
    out = {design::PiGains{*loop.kp, *loop.ki - *loop.kp}, "given as kp, ki", {}};
  return out;
}
template GivenGains given_gains<CurrentLoop>(const CurrentLoop&, const std::string&);
template GivenGains given_gains<SpeedLoop>(const SpeedLoop&, const std::string&);

base::Result<Compiled> compile(const Scenario& s) {
  base::Result<design::MotorModel> motor = design::motor_model(s.sheet);
  if (!motor) return motor.problems();
  const Nominal* nominal = s.designed_for ? &*s.designed_for : nullptr;
  const base::Result<design::MotorModel> designed = nominal ? design::motor_model(nominal->sheet) : motor;
  if (!designed) return designed.problems();
  const Basis basis{*designed, shaft_of(*designed, nominal ? nominal->load : s.load),
                    nominal ? nominal->supply.voltage_V : s.supply.voltage_V};
  Compiled out;
  out.motor = *motor;
  out.shaft = shaft_of(out.motor, s.load);
  out.devices = {s.bridge.on_resistance_ohm, s.bridge.diode_drop_V, s.bridge.diode_resistance_ohm};
  out.supply = {s.supply.voltage_V, s.supply.resistance_ohm, s.supply.capacitance_F, s.supply.sinks};
  out.start = {s.initial.speed_rad_s, s.initial.angle_rad, s.initial.bus_V.value_or(s.supply.voltage_V)};
  out.general = general_plant(s, out);
  out.board = board_of(s, basis.motor.machine.L_H / basis.motor.machine.R_ohm);
  out.timeline = timeline_of(s);
  out.end = sim::to_instant(s.duration_s);
  const std::optional<Scenario> alone = changes_mode(s) ? std::optional(settled(s, nullptr)) : std::nullopt;
  base::Result<Tuned> first = tuned(alone ? *alone : s, basis);
  if (!first) return first.problems();
  out.drive = first->drive;
  out.gains = std::move(first->gains);
  settle_edges(s, basis, out);
  if (s.control.drive == FirmwareKind::product)
    out.product = product_around(alone ? *alone : s, basis, out.drive, out.board.sensors);
  if (base::Problems problems = add_later(s, basis, out); !problems.empty()) return problems;
  return out;
}

}  // namespace sixstep::study
