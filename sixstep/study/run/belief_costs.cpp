// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/belief_costs.hpp"

#include <cmath>
#include <numbers>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/design/loops/loop_figures.hpp"
#include "sixstep/study/compile/shaft_sensor.hpp"
#include "sixstep/study/run/limit_remarks.hpp"
#include "sixstep/study/run/loop_stability.hpp"
#include "sixstep/study/scenario/believed_motor.hpp"

namespace sixstep::study {

namespace {

std::string percent(double part) { return few_digits(100 * part) + " %"; }

std::string on_angle(const Scenario& s) {
  const double d = believed_angle_error_deg(s), rad = d * base::pi / 180;
  if (d == 0.0) return {};
  const std::string head = "the drive's angle of the rotor is " + few_digits(std::fabs(d)) + " deg too " +
                           (d > 0 ? "large" : "small") +
                           " (the sensor's offset_deg minus believed.sensor_offset_deg): ";
  if (s.control.drive != FirmwareKind::field)
    return head + "each commutation comes by this angle too " + (d > 0 ? "early" : "late") +
           " in forward rotation, and too " + (d > 0 ? "late" : "early") + " in reverse rotation";
  const double part = base::cos(rad);
  std::string text = head + "a current I across the assumed magnet axis gives K I cos d = " + percent(part) +
                     " of the expected torque";
  if (part <= 0.0) text += ", with the wrong sign: a speed loop runs away";
  return text + ", and " + percent(std::fabs(base::sin(rad))) + " of the current flows along the magnet, " +
         (d > 0 ? "against" : "with") + " the magnet at forward torque";
}

/// True if the drive computes speed and position from the electrical angle by its pole pairs.
bool counts_sectors(const Scenario& s) {
  return s.sensors.rotor == RotorSensing::hall || s.control.drive == FirmwareKind::product ||
         s.control.drive == FirmwareKind::sensorless || s.control.field.angle != FieldAngle::sensors;
}

std::string on_pole_pairs(const Scenario& s, const Compiled& c) {
  const double p_m = c.motor.machine.pole_pairs, p_f = c.believed.motor.machine.pole_pairs;
  if (p_m == p_f) return {};
  const std::string head =
      "the drive believes " + few_digits(p_f) + " pole pairs of a motor with " + few_digits(p_m) + ": ";
  const bool speed = s.control.mode == control::Mode::speed;
  if (counts_sectors(s))
    return head + "the drive measures p_m/p_f = " + percent(p_m / p_f) + " of the speed" +
           (speed ? ", and its speed loop controls the speed to " + percent(p_f / p_m) + " of the reference"
                  : "");
  if (s.sensors.rotor == RotorSensing::ideal || s.sensors.shaft == SensorShaft::load)
    return head + "decoupling and delay compensation use p_f/p_m = " + percent(p_f / p_m) +
           " of the electrical speed";
  return head + "the drive's electrical angle turns p_f/p_m = " + few_digits(p_f / p_m) +
         " times as fast as the magnet, so that the torque changes its sign " +
         few_digits(2 * std::fabs(p_f - p_m)) + " times per turn of the shaft, and its mean is 0";
}

std::string loop_words(const Scenario& s, const Compiled& c, const LoopGains& g) {
  const auto figures = [&](const design::MotorModel& motor, const design::Sheet& sheet) {
    const design::Transfer open = open_current_loop(current_loop_on(s, motor, sheet, g));
    return std::pair(design::loop_figures(open, s.pwm.period_s),
                     1 - design::slowest_decay(design::closed(open).den));
  };
  const auto [believed, z_f] = figures(c.believed.motor, believed_sheet(s));
  const auto [real, z_m] = figures(c.motor, s.sheet);
  if (!real.stable) return "the " + g.loop + " loop as designed is unstable on the motor";
  std::string text =
      "the " + g.loop + " loop's slowest pole moves from z = " + few_digits(z_f) + " to " + few_digits(z_m);
  if (believed.bandwidth_rad_s && real.bandwidth_rad_s)
    text += ", its bandwidth from " + few_digits(*believed.bandwidth_rad_s / (2 * base::pi)) + " to " +
            few_digits(*real.bandwidth_rad_s / (2 * base::pi)) + " Hz";
  if (believed.phase_rad && real.phase_rad)
    text += ", its phase margin from " + few_digits(*believed.phase_rad * 180 / base::pi) + " to " +
            few_digits(*real.phase_rad * 180 / base::pi) + " deg";
  return text;
}

std::string on_winding(const Scenario& s, const Compiled& c) {
  const design::FieldMachine m = design::field_machine(c.motor, s.sheet),
                             f = design::field_machine(c.believed.motor, believed_sheet(s));
  std::string values;
  const auto add = [&values](const char* name, double motor, double drive, const char* unit) {
    if (motor == drive) return;
    values += (values.empty() ? "" : ", ") + std::string(name) + " = " + few_digits(drive) + " instead of " +
              few_digits(motor) + " " + unit;
  };
  add("R", m.R_ohm, f.R_ohm, "ohm");
  const bool round = m.L_d_H == m.L_q_H && f.L_d_H == f.L_q_H;
  if (!round) add("L_d", 1e3 * m.L_d_H, 1e3 * f.L_d_H, "mH");
  add(round ? "L" : "L_q", 1e3 * m.L_q_H, 1e3 * f.L_q_H, "mH");
  if (values.empty()) return {};
  std::string text = "the drive believes " + values + " of a phase";
  for (const LoopGains& g : c.gains)
    if (is_current_pi(s, g)) text += (text.ends_with("phase") ? ": " : "; ") + loop_words(s, c, g);
  return text;
}

std::string on_flux(const Scenario& s, const Compiled& c) {
  const design::FieldMachine m = design::field_machine(c.motor, s.sheet),
                             f = design::field_machine(c.believed.motor, believed_sheet(s));
  const bool field = s.control.drive == FirmwareKind::field;
  const double ratio = field ? m.magnet_V_s / f.magnet_V_s : c.motor.K_t_Nm_A / c.believed.motor.K_t_Nm_A;
  if (ratio == 1.0) return {};
  std::string text =
      "the drive believes another torque constant: an ampere gives K_m/K_f = " + percent(ratio) +
      " of the torque that the drive computes";
  if (field && s.control.field.decoupling)
    text += ", and the drive's decoupling adds " + percent(1 / ratio) + " of the back-EMF";
  if (s.control.field.weakening_A && field) {
    const double base_V = c.drive.nominal_bus_V / std::numbers::sqrt3;
    text += "; the back-EMF reaches the bus at " + few_digits(base_V / m.magnet_V_s) +
            " rad/s, not at the believed " + few_digits(base_V / f.magnet_V_s) + " rad/s";
  }
  return text;
}

std::string on_inertia(const Scenario& s, const Compiled& c) {
  if (!s.believed.inertia_gcm2 || c.believed.motor.shaft.J_kg_m2 == c.motor.shaft.J_kg_m2) return {};
  const double ratio = c.believed.shaft.J_kg_m2 / c.shaft.J_kg_m2;
  return "the drive believes " + few_digits(1e7 * c.believed.shaft.J_kg_m2) +
         " g cm2 of rotor and load instead of " + few_digits(1e7 * c.shaft.J_kg_m2) +
         ": the gain of its designed speed loop is J_f/J_m = " + percent(ratio);
}

std::string on_hall_table(const Scenario& s) {
  if (s.believed.hall_lines == rig::WireOrder::abc) return {};
  const rig::Wiring wires{.phases = {},
                          .probes = s.sensors.hall_lines,
                          .inverted = static_cast<std::uint8_t>(s.sensors.hall_inverted)};
  int wrong = 0;
  for (std::uint8_t sector = 0; sector < 6; ++sector)
    wrong += control::sector_of_hall(rig::code_at(s.believed.hall_lines,
                                                  wires.at_pins(control::hall_of_sector(sector)))) != sector;
  if (wrong == 0) return {};
  return "the drive's Hall table does not fit the wires (believed.hall_lines, sensors.hall_lines): the table assigns " +
         std::to_string(wrong) + " of 6 codes to a wrong sector";
}

}  // namespace

double believed_angle_error_deg(const Scenario& s) {
  const bool measured = s.sensors.rotor == RotorSensing::encoder ||
                        s.sensors.rotor == RotorSensing::absolute ||
                        s.sensors.rotor == RotorSensing::resolver;
  if (!measured || s.sensors.shaft == SensorShaft::load) return 0.0;
  const double d = mounting_offset_deg(s.sensors) - s.believed.sensor_offset_deg;
  return d - 360 * std::floor(d / 360 + 0.5);
}

std::vector<std::string> belief_costs(const Scenario& s, const Compiled& c) {
  std::vector<std::string> costs;
  for (std::string text : {on_angle(s), on_pole_pairs(s, c), on_hall_table(s)})
    if (!text.empty()) costs.push_back(std::move(text));
  // Without beliefs the motors differ only within a series, where each drive has its own values.
  if (!believes_a_motor(s.believed)) return costs;
  for (std::string text : {on_winding(s, c), on_flux(s, c), on_inertia(s, c)})
    if (!text.empty()) costs.push_back(std::move(text));
  return costs;
}

}  // namespace sixstep::study
