// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/compile.hpp"

#include <algorithm>

#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/operating_limits.hpp"
#include "sixstep/design/loops/rotor_sensing.hpp"
#include "sixstep/study/compile/basis.hpp"
#include "sixstep/study/compile/front_end.hpp"
#include "sixstep/study/compile/general_plant.hpp"
#include "sixstep/study/compile/loops.hpp"
#include "sixstep/study/compile/pulse.hpp"
#include "sixstep/study/compile/setpoint_range.hpp"
#include "sixstep/study/compile/shaft_sensor.hpp"
#include "sixstep/study/compile/timeline.hpp"
#include "sixstep/study/scenario/believed_motor.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/low_side_window.hpp"

namespace sixstep::study {

namespace {

plant::Shaft shaft_of(const design::MotorModel& motor, const Load& load) {
  plant::Shaft shaft = motor.shaft;
  // The load's inertia is referred to the motor's side of the gear, as if the shaft were rigid.
  shaft.J_kg_m2 += load.inertia_kg_m2 / (load.gear * load.gear);
  shaft.B_Nm_s += load.viscous_Nm_s / (load.gear * load.gear);
  shaft.coulomb_Nm += load.coulomb_Nm / load.gear;
  shaft.static_Nm = load.static_Nm / load.gear;
  shaft.locked = load.locked;
  return shaft;
}

}  // namespace

namespace {

/// The duty above which a pulse has lasted at least late_s when the sample is taken.
double duty_of_a_pulse(const Scenario& s, double late_s) {
  const double late = (late_s + pulse_late_s(s)) / s.pwm.period_s;
  return s.pwm.alignment == Alignment::centre ? 2 * late : 0.5 + late;
}

}  // namespace

double least_visible_duty(const Scenario& s) {
  return std::min(duty_of_a_pulse(s, s.sensors.shunt_settle_s), 1.0);
}

double least_shown_duty(const Scenario& s) {
  const double duty = duty_of_a_pulse(s, s.sensors.shunt_settle_s + s.sensors.current_delay_s);
  return std::min(std::max(duty, s.pwm.minimum_pulse_s / s.pwm.period_s), 1.0);
}

double unseen_at_rest_A(const Scenario& s, double R_ohm) {
  const Bridge& b = s.bridge;
  const double d = least_shown_duty(s), off = 1 - d;
  // Conducting devices: two switches during the pulse; otherwise a switch and a diode, two switches or two
  // diodes.
  double switches = 2 * d, diodes = 0.0, volts = d * s.supply.voltage_V;
  switch (s.pwm.chopping) {
    case control::Chopping::soft:
      switches += off;
      diodes = off;
      break;
    case control::Chopping::complementary: {
      // At each edge a lower diode conducts for a dead time. The pulse is shorter by one dead time.
      const double dead = std::min(b.dead_time_s / s.pwm.period_s, d);
      volts -= dead * s.supply.voltage_V;
      diodes = 2 * dead;
      switches = 2 - diodes;
      break;
    }
    case control::Chopping::hard:
      diodes = 2 * off;
      volts -= off * s.supply.voltage_V;
      break;
  }
  volts -= diodes * b.diode_drop_V + switches * b.saturation_V;
  return std::max(volts, 0.0) /
         (2 * R_ohm + switches * b.on_resistance_ohm + diodes * b.diode_resistance_ohm);
}

namespace {

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
  to.low_side = low_side_of(s);
  to.fade = base::exp(-s.pwm.period_s / L_over_R_s);
  to.measures_bus = from.bus == BusSensing::adc;
  // Terminals have converters like the converter of the bus, even if the bus is not measured.
  const double usual_V = s.control.drive == FirmwareKind::sensorless ? 1.25 * s.supply.voltage_V : 0.0;
  to.bus = {
      from.adc_bits,   from.bus_range_V.value_or(usual_V), false, from.bus_offset_V, from.bus_gain_error,
      from.bus_noise_V};
  to.rotor_from_hall = from.rotor == RotorSensing::hall;
  to.decodes_hall = breaks_a_hall_line(s) || inverts_a_hall_line(s);
  to.capture_Hz = from.capture_Hz;
  to.timeout_s = from.timeout_s;
  to.edges = static_cast<std::uint8_t>(from.speed_edges);  // settle_edges() replaces a 0
  take_hall_angle(s, to);
  to.seed = static_cast<std::uint64_t>(from.seed);
  to.shaft = shaft_sensor_config(s);
  to.period_s = s.pwm.period_s;
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
  board.front_end = front_end_of(s.sensors, s.control.drive == FirmwareKind::sensorless,
                                 s.control.sensorless.follows == control::Follow::comparators);
  board.hall_arrangement = s.sensors.hall_spacing;
  board.believed_lines = s.believed.hall_lines;
  board.believed_pole_pairs = s.believed.pole_pairs.value_or(0);
  return board;
}

rig::ProbeGiven probes_of(const Sensors& s) {
  return {{s.hall_offset_deg, s.hall_hysteresis_deg, s.hall_edges_deg},
          s.hall_spacing == control::HallArrangement::degrees_60,
          sim::to_instant(s.hall_delay_s).ticks};
}

/// Sets the number of edges per measured speed for the loop that uses it (design/loops/rotor_sensing.hpp). A
/// drive that calibrates its edges averages over six edges until the calibration ends.
void settle_edges(const Scenario& s, const Basis& basis, Compiled& out) {
  rig::SensorsConfig& sensors = out.board.sensors;
  const bool learns = sensors.hall_angle == rig::HallAngleFrom::learned_edges;
  if (sensors.edges != 0 && !learns) return;
  sensors.window_s = speed_window_s(s, basis, out.drive);
  sensors.edges = learns || sensors.window_s > 0.0 ? 6 : 1;
}

base::Problems add_sensorless(const Scenario& s, const Basis& basis,
                              const control::DriveConfig<double>& drive,
                              std::optional<control::PulsedDriveConfig<double>>& out,
                              std::vector<design::DerivationStep>* steps = nullptr) {
  if (s.control.drive != FirmwareKind::sensorless) return {};
  const auto around = sensorless_around(s, basis, drive);
  if (!around) return around.problems();
  out = around->config;
  if (steps != nullptr) *steps = around->steps;
  return {};
}

/// The current loops' gains are listed first, because these loops are the innermost.
base::Problems add_field(const Scenario& s, const Basis& basis, Tuned& tuned, Compiled* told = nullptr) {
  if (s.control.drive != FirmwareKind::field) return {};
  auto around = field_around(s, basis, tuned.drive);
  if (!around) return around.problems();
  tuned.field = around->config;
  tuned.estimator = around->estimator;
  tuned.gains.insert(tuned.gains.begin(), around->gains.begin(), around->gains.end());
  if (told == nullptr) return {};
  told->field_steps = std::move(around->steps);
  told->estimator_steps = std::move(around->estimator_steps);
  return {};
}

/// The user's controller receives the gains of the library's loops as an input. The loops themselves do not
/// run.
base::Problems add_own(const Scenario& s, const Basis& basis, Tuned& tuned) {
  if (s.control.drive != FirmwareKind::own) return {};
  auto designed = own_designed(s, basis, tuned.drive);
  if (!designed) return designed.problems();
  tuned.own = std::move(*designed);
  tuned.gains.clear();
  return {};
}

/// Adds the configuration after each event. The sensors keep their configuration of the start.
base::Problems add_later_actions(const Scenario& s, const Basis& basis, Compiled& out) {
  const std::vector<const At*> order = in_order(s);
  out.later.reserve(order.size());
  for (const At* at : order) {
    if (!retunes(*at)) continue;
    const Scenario then = settled(s, at);
    base::Result<Tuned> later = tuned(then, basis);
    if (!later) return told_of_event(s, *at, later.problems());
    if (out.product) later->product = product_around(then, basis, later->drive, out.board.sensors);
    if (base::Problems problems = add_sensorless(then, basis, later->drive, later->sensorless);
        !problems.empty())
      return told_of_event(s, *at, problems);
    if (base::Problems problems = add_field(then, basis, *later); !problems.empty())
      return told_of_event(s, *at, problems);
    if (base::Problems problems = add_own(then, basis, *later); !problems.empty())
      return told_of_event(s, *at, problems);
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

/// Without a speed loop the gain is 0, so the window is 0 too.
double speed_window_s(const Scenario& s, const Basis& basis, const control::DriveConfig<double>& drive) {
  const bool cascade = s.control.speed.output == SpeedOutput::current;
  const double full_A =
      cascade ? drive.current_at_full_torque_A : basis.bus_V / (2 * basis.motor.machine.R_ohm);
  const double per_A = cascade ? torque_per_A(s, basis) : basis.motor.K_t_Nm_A;
  const double full_rad_s2 = full_A * per_A / basis.shaft.J_kg_m2;
  return design::hall_window_s(design::speed_crossover_rad_s(drive.speed.d1, full_rad_s2));
}

base::Result<Compiled> compile(const Scenario& s) {
  base::Result<design::MotorModel> motor = design::motor_model(s.sheet);
  if (!motor) return motor.problems();
  // Most drives are designed for their own motor, which is read once.
  const bool other = s.designed_for || believes_a_motor(s.believed);
  base::Result<design::MotorModel> believed = other ? believed_motor(s) : motor;
  if (!believed) return believed.problems();
  const std::optional<design::Sheet> other_sheet = other ? std::optional(believed_sheet(s)) : std::nullopt;
  const Nominal* nominal = s.designed_for ? &*s.designed_for : nullptr;
  Compiled out;
  out.motor = *motor;
  out.shaft = shaft_of(out.motor, s.load);
  out.believed = {*believed, shaft_of(*believed, nominal ? nominal->load : s.load)};
  const Basis basis{out.believed.motor, other_sheet ? *other_sheet : s.sheet, out.believed.shaft,
                    nominal ? nominal->supply.voltage_V : s.supply.voltage_V};
  out.devices = {s.bridge.on_resistance_ohm, s.bridge.diode_drop_V, s.bridge.diode_resistance_ohm};
  out.supply = {s.supply.voltage_V, s.supply.resistance_ohm, s.supply.capacitance_F, s.supply.sinks};
  out.start = {s.initial.speed_rad_s, s.initial.angle_rad, s.initial.bus_V.value_or(s.supply.voltage_V)};
  out.general = general_plant(s, out);
  out.board = board_of(s, basis.motor.machine.L_H / basis.motor.machine.R_ohm);
  out.wiring = {s.bridge.phases, s.sensors.hall_lines, static_cast<std::uint8_t>(s.sensors.hall_inverted)};
  out.probes = probes_of(s.sensors);
  out.timeline = timeline_of(s);
  out.setpoint_range = setpoint_range(s, out.timeline);
  out.end = sim::to_instant(s.duration_s);
  const std::optional<Scenario> alone = changes_mode(s) ? std::optional(settled(s, nullptr)) : std::nullopt;
  base::Result<Tuned> first = tuned(alone ? *alone : s, basis);
  if (!first) return first.problems();
  if (base::Problems problems = add_field(alone ? *alone : s, basis, *first, &out); !problems.empty())
    return problems;
  if (base::Problems problems = add_own(alone ? *alone : s, basis, *first); !problems.empty())
    return problems;
  out.field = first->field;
  out.estimator = first->estimator;
  out.own = std::move(first->own);
  out.drive = first->drive;
  out.gains = std::move(first->gains);
  settle_edges(s, basis, out);
  if (s.control.drive == FirmwareKind::product)
    out.product = product_around(alone ? *alone : s, basis, out.drive, out.board.sensors);
  if (base::Problems problems =
          add_sensorless(alone ? *alone : s, basis, out.drive, out.sensorless, &out.sensorless_steps);
      !problems.empty())
    return problems;
  if (base::Problems problems = add_later_actions(s, basis, out); !problems.empty()) return problems;
  return out;
}

}  // namespace sixstep::study
