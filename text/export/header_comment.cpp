// SPDX-License-Identifier: Apache-2.0
#include "text/export/header_comment.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sixstep/base/describe.hpp"
#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"
#include "text/export/clearance_lines.hpp"

namespace text {
namespace {

std::string comment(std::string_view label, std::string_view text) {
  return fmt::format("// {:<10}{}\n", label, comment_text(text));
}

/// Poles of the closed loop of controller (d1 z + d0)/(z - 1) and plant b0/(z + a0). They are the roots of
/// z^2 + (b0 d1 + a0 - 1) z + (b0 d0 - a0).
std::string closed_loop_poles(const study::LoopGains& g, const design::ZohPlant& plant) {
  const double half = (plant.b0 * g.d1 + plant.a0 - 1) / 2, product = plant.b0 * g.d0 - plant.a0;
  const double square = half * half - product, root = std::sqrt(std::fabs(square));
  return square < 0
             ? fmt::format("z = {} +- {}j", sixstep::base::six_digits(-half), sixstep::base::six_digits(root))
             : fmt::format("z = {} and {}", sixstep::base::six_digits(-half + root),
                           sixstep::base::six_digits(-half - root));
}

/// The gains as K_p and K_i, which other tools use (control.current.kp, ki_per_s).
std::string as_kp_and_ki(const study::LoopGains& g, const char* unit, double period_s) {
  const bool current = g.loop.starts_with("current");
  return fmt::format("; K_p = d1 = {} {}, K_i = (d1 + d0)/T_s = {} {}", sixstep::base::six_digits(g.d1), unit,
                     sixstep::base::six_digits((g.d1 + g.d0) / period_s), current ? "V/(A s)" : "per rad");
}

/// One line with the gains and their source.
std::string derivation(const study::LoopGains& g, double period_s) {
  if (g.loop == "position") return fmt::format("{} rad/s per deg; {}", base::written(g.d1), g.origin);
  const char* unit = g.loop.starts_with("current") ? "V/A" : "per rad/s";
  if (!g.steps.empty()) return fmt::format("K = {} {}; {}", sixstep::base::six_digits(g.d1), unit, g.origin);
  std::string text =
      fmt::format("d1 = {} {}, d0 = {} {}{}; {}", sixstep::base::six_digits(g.d1), unit,
                  sixstep::base::six_digits(g.d0), unit, as_kp_and_ki(g, unit, period_s), g.origin);
  if (!g.derivation) return text;
  const design::PolePlacement& p = *g.derivation;
  const bool designed = p.gains.d1 == g.d1 && p.gains.d0 == g.d0;
  const std::string rule =
      fmt::format("settle_s = {}, damping = {}", base::written(p.settle_s), base::written(p.damping));
  text += fmt::format("; poles {}{} on {}/(z {:+.6g})", closed_loop_poles(g, p.plant),
                      designed ? fmt::format(" ({})", rule) : "", sixstep::base::six_digits(p.plant.b0),
                      p.plant.a0);
  if (designed) return text;
  return text + fmt::format("; {} would give d1 = {}, d0 = {}", rule, sixstep::base::six_digits(p.gains.d1),
                            sixstep::base::six_digits(p.gains.d0));
}

/// The calls that the board makes, as comment lines.
std::string entries(const study::Compiled& c) {
  if (c.sensorless)
    return "// Call pulsed_drive_step in each tick, with the currents, the terminals' and the bus's counts and the timer. Call\n"
           "// sensorless_drive_commutate at the compare match that next_commutation sets, sensorless_drive_hall in a Hall interrupt, and\n"
           "// sensorless_capture at an edge of a comparator at a terminal.\n";
  if (c.estimator.on)
    return "// Call sensorless_field_step in each tick, with the measured currents and bus voltage. The function estimates the magnet's angle.\n";
  if (c.field)
    return "// Call field_drive_step in each tick, with the measured currents, speed and bus, and with the magnet's direction, which\n"
           "// field_directions computes from a decoder's electrical angle. Hall edges need no call.\n";
  return "";
}

}  // namespace

bool states_range(const design::OperatingRange& r) {
  return r.current_A > 0 || r.speed_rad_s > 0 || r.position_deg > 0 || r.bus_V > 0 || r.setpoint > 0;
}

std::string header_comment(const ConfigHeader& w, const study::Compiled& c) {
  const auto motor_line = [](const design::MotorModel& motor, double J_kg_m2) {
    const sixstep::plant::Machine& m = motor.machine;
    return fmt::format("{} pole pairs, terminal R = {} ohm, L = {} H, K_t = {} N m/A; J = {} kg m2",
                       static_cast<int>(m.pole_pairs), sixstep::base::six_digits(2 * m.R_ohm),
                       sixstep::base::six_digits(2 * m.L_H), sixstep::base::six_digits(motor.K_t_Nm_A),
                       sixstep::base::six_digits(J_kg_m2));
  };
  const std::string itself = motor_line(c.motor, c.shaft.J_kg_m2),
                    believed = motor_line(c.believed.motor, c.believed.shaft.J_kg_m2);
  std::string text = "// clang-format off\n";
  text += fmt::format("// Made by sixstep {}. Change the scenario, not this file:\n//   {}\n//\n",
                      SIXSTEP_VERSION, comment_text(w.command));
  text +=
      "// C++20, which avr-gcc 5 and 7 (Debian 12, the Arduino IDE) lack. For the AVR use clang 19 or later.\n//\n";
  text += comment("scenario", w.scenario.title.empty() ? "(no title)" : w.scenario.title);
  if (!w.scenario.notes.empty()) text += comment("notes", w.scenario.notes);
  text += comment("motor", fmt::format("{}: {}", w.scenario.sheet.name, itself));
  if (believed != itself) text += comment("believed", believed + "; the constants below are for this motor");
  for (const study::LoopGains& g : c.gains) text += comment(g.loop, derivation(g, w.scenario.pwm.period_s));
  text +=
      "// Gains are per control period, pwm_period_ps. Speed is mechanical, current positive into the "
      "motor.\n";
  text += entries(c) + "//\n";
  return text + clearance_lines({w.scenario, w.clearance, w.despite, states_range(w.range)});
}

}  // namespace text
