// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/belief_costs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/design/loops/loop_figures.hpp"
#include "sixstep/study/check/idle_beliefs.hpp"
#include "sixstep/study/compile/shaft_sensor.hpp"
#include "sixstep/study/run/limit_remarks.hpp"
#include "sixstep/study/run/loop_stability.hpp"
#include "sixstep/study/scenario/believed_motor.hpp"
#include "sixstep/study/scenario/changes.hpp"

namespace sixstep::study {

namespace {

using Costs = std::vector<BeliefCost>;

/// Rounding leaves some 1e-16 of what is 0, as in cos 90 deg.
double whole(double part) { return std::fabs(part) < 1e-9 ? 0.0 : part; }
std::string percent(double part) { return few_digits(100 * whole(part)) + " %"; }

/// Whether the drive's loop with this name has gains that were designed.
bool is_designed(const LoopGains& g) { return !g.origin.starts_with("given"); }

void on_angle(const Scenario& s, Costs& costs) {
  const double d = believed_angle_error_deg(s), rad = d * base::pi / 180;
  if (d == 0.0) return;
  const double part = whole(base::cos(rad));
  const std::string against = part < 0.0    ? ", of the wrong sign: a speed loop runs away"
                              : part == 0.0 ? ", no torque at all"
                                            : "";
  std::string text = "the drive takes the rotor's angle for " + few_digits(std::fabs(d)) + " deg " +
                     (d > 0 || d == -180 ? "more" : "less") +
                     " than it is (the sensor's offset_deg less believed.sensor_offset_deg): ";
  if (s.control.drive != FirmwareKind::field)
    text += std::string("each pair changes that much too ") + (d > 0 ? "early" : "late") +
            " in forward, and too " + (d > 0 ? "late" : "early") + " in reverse rotation" + against;
  else
    text += "a current I across its assumed magnet gives K I cos d = " + percent(part) + " of its torque" +
            against + ", and " + percent(std::fabs(base::sin(rad))) + " of it flows along the magnet" +
            (whole(base::sin(rad)) == 0.0 ? ""
             : d > 0                      ? ", against it in forward torque"
                                          : ", with it at forward torque");
  costs.push_back({std::move(text), part <= 0.0});
}

/// True if the drive computes speed and position from the electrical angle by its pole pairs.
bool counts_sectors(const Scenario& s) {
  return s.sensors.rotor == RotorSensing::hall || s.control.drive == FirmwareKind::product ||
         s.control.drive == FirmwareKind::sensorless || s.control.field.angle != FieldAngle::sensors;
}

void on_pole_pairs(const Scenario& s, const Compiled& c, Costs& costs) {
  const double p_m = c.motor.machine.pole_pairs, p_f = c.believed.motor.machine.pole_pairs;
  if (p_m == p_f || !idle_belief(s, Belief::pole_pairs).empty()) return;
  const std::string head =
      "the drive believes " + few_digits(p_f) + " pole pairs of a motor with " + few_digits(p_m) + ": ";
  const bool speed = s.control.mode == control::Mode::speed;
  const std::string ratio = few_digits(p_f) + "/" + few_digits(p_m);
  if (counts_sectors(s))
    costs.push_back(
        {head + "it reads p_m/p_f = " + percent(p_m / p_f) + " of the speed" +
         (speed ? ", and its speed loop holds " + percent(p_f / p_m) + " of the reference" : "")});
  else if (s.sensors.rotor == RotorSensing::ideal || s.sensors.shaft == SensorShaft::load)
    costs.push_back(
        {head +
         (s.control.drive == FirmwareKind::field ? "decoupling and delay compensation take"
                                                 : "what it computes by the electrical speed takes") +
         " the electrical speed for p_f/p_m = " + percent(p_f / p_m) + " of it"});
  else
    costs.push_back({head + "its electrical angle turns p_f/p_m = " + ratio +
                         " times as fast as the magnet, so that the torque changes its sign " +
                         few_digits(2 * std::fabs(p_f - p_m)) +
                         " times per turn of the shaft, and its mean is 0",
                     true});
}

/// Figures of a current loop on the true winding, beside those on the believed one, for which it was designed.
std::string loop_words(const Scenario& s, const Compiled& c, const LoopGains& g, bool& stable) {
  const auto on = [&](const design::MotorModel& motor, const design::Sheet& sheet) {
    const design::Transfer open = open_current_loop(current_loop_on(s, motor, sheet, g));
    const design::LoopFigures figures = design::loop_figures(open, s.pwm.period_s);
    constexpr double periods = 400;
    const double overshoot =
        design::step_response(design::closed(open), s.pwm.period_s, periods * s.pwm.period_s).overshoot;
    return std::pair(figures, overshoot);
  };
  const auto [believed, over_f] = on(c.believed.motor, believed_sheet(s));
  const auto [real, over_m] = on(c.motor, s.sheet);
  stable = real.stable;
  if (!stable) return "the " + g.loop + " loop of its design is unstable on the motor";
  std::string text = "the " + g.loop + " loop";
  if (percent(over_m) != percent(over_f))
    text += " overshoots a step by " + percent(over_m) + " instead of " + percent(over_f) + ", and";
  text += " changes";
  const auto changes = [&text](const char* what, const auto& from, const auto& to, double unit,
                               const char* name) {
    if (from && to)
      text += std::string(text.ends_with("changes") ? " its " : ", its ") + what + " from " +
              few_digits(*from / unit) + " to " + few_digits(*to / unit) + " " + name;
  };
  changes("bandwidth", believed.bandwidth_rad_s, real.bandwidth_rad_s, 2 * base::pi, "Hz");
  changes("phase margin", believed.phase_rad, real.phase_rad, base::pi / 180, "deg");
  return text;
}

bool observes_flux(const Scenario& s) {
  return s.control.drive == FirmwareKind::field && (s.control.field.angle == FieldAngle::observer ||
                                                    s.control.field.angle == FieldAngle::injection_observer);
}

/// A flux observer integrates v - R i, takes L i off, and corrects what is left to the magnet's flux.
std::string observer_words(const design::FieldMachine& m, const design::FieldMachine& f) {
  std::string text;
  const double psi = m.magnet_V_s / m.pole_pairs, missing_H = m.L_q_H - f.L_q_H;
  if (const double lost_A = std::fabs(psi / missing_H); missing_H != 0.0)
    text += std::string("; its observer's angle is off by d, sin d = (L_m - L_f) I/psi: ") +
            (missing_H < 0.0 ? "-30" : "30") + " deg at " + few_digits(lost_A / 2) +
            " A, and the rotor is lost above " + few_digits(lost_A) + " A";
  if (m.R_ohm != f.R_ohm)
    text += "; its observer's flux is off by (R_m - R_f) I/(p w), as much as the magnet's at " +
            few_digits(std::fabs(m.R_ohm - f.R_ohm) / m.magnet_V_s) +
            " rad/s per ampere: at low speed the rotor is lost, and may not start";
  return text;
}

void on_winding(const Scenario& s, const Compiled& c, Costs& costs) {
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
  if (values.empty() || !idle_belief(s, Belief::winding).empty()) return;
  BeliefCost cost{"the drive believes " + values + " of a phase"};
  for (const LoopGains& g : c.gains) {
    if (!is_current_pi(s, g) || !is_designed(g)) continue;
    bool stable = true;
    cost.text += (cost.text.ends_with("phase") ? ": " : "; ") + loop_words(s, c, g, stable);
    cost.grave |= !stable;
  }
  if (observes_flux(s)) cost.text += observer_words(m, f);
  costs.push_back(std::move(cost));
}

bool has_speed_loop(const Scenario& s) {
  return comes_into(s, control::Mode::speed) || comes_into(s, control::Mode::position);
}
bool gives_torque(const Scenario& s) {
  return has_speed_loop(s) && s.control.speed.output != SpeedOutput::duty;
}

/// Magnet of the motor over that which the drive believes.
double K_m_over_K_f(const Scenario& s, const Compiled& c) {
  if (s.control.drive != FirmwareKind::field) return c.motor.K_t_Nm_A / c.believed.motor.K_t_Nm_A;
  const design::FieldMachine f = design::field_machine(c.believed.motor, believed_sheet(s));
  return design::field_machine(c.motor, s.sheet).magnet_V_s / f.magnet_V_s;
}

void on_flux(const Scenario& s, const Compiled& c, Costs& costs) {
  const double ratio = K_m_over_K_f(s, c);
  if (ratio == 1.0 || !idle_belief(s, Belief::torque_constant).empty()) return;
  const bool field = s.control.drive == FirmwareKind::field;
  std::string text = "the drive believes another torque constant, K_m/K_f = " + percent(ratio);
  if (gives_torque(s) || s.control.limits.torque_Nm)
    text += ": an ampere gives as much of the torque that it computes";
  if (field && s.control.field.law == FieldLaw::finite_set)
    text += ", and its prediction of the next sample takes " + percent(1 / ratio) + " of the back-EMF";
  else if (field && s.control.field.decoupling)
    text += ", and its decoupling feeds " + percent(1 / ratio) + " of the back-EMF forward";
  if (observes_flux(s))
    text += ", and its observer takes the magnet's flux for K_f/K_m = " + percent(1 / ratio) +
            " of it, so that its angle is wrong under load";
  if (s.control.field.weakening_A && field) {
    const double base_V = c.drive.nominal_bus_V / std::numbers::sqrt3,
                 magnet_V_s = design::field_machine(c.motor, s.sheet).magnet_V_s;
    text += "; the bus ends at " + few_digits(base_V / magnet_V_s) + " rad/s, it believes at " +
            few_digits(ratio * base_V / magnet_V_s) + " rad/s";
  }
  costs.push_back({std::move(text)});
}

double J_f_over_J_m(const Compiled& c) { return c.believed.shaft.J_kg_m2 / c.shaft.J_kg_m2; }

void on_inertia(const Scenario& s, const Compiled& c, Costs& costs) {
  if (!s.believed.inertia_gcm2 || c.believed.motor.shaft.J_kg_m2 == c.motor.shaft.J_kg_m2 ||
      !idle_belief(s, Belief::inertia).empty())
    return;
  const bool linear = s.sheet.kind == design::MotorKind::linear;
  const double unit = linear ? 1.0 : 1e7;
  costs.push_back({"the drive believes " + few_digits(unit * c.believed.shaft.J_kg_m2) +
                   (linear ? " kg of slide and load" : " g cm2 of rotor and load") + " instead of " +
                   few_digits(unit * c.shaft.J_kg_m2)});
}

/// All wrong numbers together make the gain of a designed speed loop.
void on_speed_gain(const Scenario& s, const Compiled& c, Costs& costs) {
  const bool designed = std::any_of(c.gains.begin(), c.gains.end(),
                                    [](const LoopGains& g) { return g.loop == "speed" && is_designed(g); });
  if (!designed || !gives_torque(s)) return;
  double gain = 1.0;
  std::string factors;
  const auto times = [&](const char* name, double factor) {
    if (factor == 1.0) return;
    gain *= factor;
    factors += (factors.empty() ? "" : " times ") + std::string(name) + " = " + percent(factor);
  };
  times("J_f/J_m", s.believed.inertia_gcm2 ? J_f_over_J_m(c) : 1.0);
  times("K_m/K_f", K_m_over_K_f(s, c));
  if (counts_sectors(s)) times("p_m/p_f", c.motor.machine.pole_pairs / c.believed.motor.machine.pole_pairs);
  if (factors.empty()) return;
  const bool one = factors.find(" times ") == factors.npos;
  costs.push_back({"the gain of its designed speed loop is " +
                   (one ? "" : percent(gain) + " of the designed one, ") + factors +
                   (one ? " of the designed one" : "")});
}

void on_hall_table(const Scenario& s, Costs& costs) {
  if (s.believed.hall_lines == rig::WireOrder::abc || !idle_belief(s, Belief::hall_lines).empty()) return;
  const rig::Wiring wires{.phases = {},
                          .probes = s.sensors.hall_lines,
                          .inverted = static_cast<std::uint8_t>(s.sensors.hall_inverted)};
  // Torque per ampere, over K_t, with the pair of a sector that lies n sectors ahead: the mean of cos over a sector, and of a
  // trapezoid.
  constexpr double torque[] = {1.0, 0.5, -0.5, -1.0, -0.5, 0.5};
  int wrong = 0;
  double sum = 0.0, least = 1.0, most = -1.0;
  for (std::uint8_t sector = 0; sector < 6; ++sector) {
    const std::uint8_t taken = control::sector_of_hall(
        rig::code_at(s.believed.hall_lines, wires.at_pins(control::hall_of_sector(sector))));
    wrong += taken != sector;
    const double part = taken < 6 ? torque[(taken + 6 - sector) % 6] : 0.0;
    sum += part / 6;
    least = std::min(least, part);
    most = std::max(most, part);
  }
  if (wrong == 0) return;
  std::string text =
      "the drive's Hall table does not fit the wires (believed.hall_lines, sensors.hall_lines): it takes " +
      std::to_string(wrong) + " of 6 codes for another sector";
  // With crossed phases another pair belongs to a sector.
  if (s.bridge.phases == rig::WireOrder::abc)
    text += least == most ? "; in each sector a current gives " + percent(sum) + " of its torque" +
                                (sum < 0 ? ", of the wrong sign: a speed loop runs away" : "")
                          : "; a current gives from " + percent(least) + " to " + percent(most) +
                                " of its torque, and " + percent(sum) + " over an electrical turn";
  costs.push_back({std::move(text), true});
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

std::vector<BeliefCost> belief_costs(const Scenario& s, const Compiled& c) {
  Costs costs;
  on_angle(s, costs);
  on_pole_pairs(s, c, costs);
  on_hall_table(s, costs);
  // Without beliefs the motors differ only within a series, where each drive has its own values.
  if (!believes_a_motor(s.believed)) return costs;
  on_winding(s, c, costs);
  on_flux(s, c, costs);
  on_inertia(s, c, costs);
  on_speed_gain(s, c, costs);
  return costs;
}

}  // namespace sixstep::study
