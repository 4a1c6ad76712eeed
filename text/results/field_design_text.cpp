// SPDX-License-Identifier: Apache-2.0
#include "text/results/field_design_text.hpp"

#include <fmt/format.h>

#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "text/escape/escape.hpp"
#include "text/results/design_loops_text.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/text_rows.hpp"

namespace text {
namespace {

using sixstep::analysis::FieldStudy;
using sixstep::design::DerivationStep;

std::string winding(const sixstep::design::FieldMachine& m) {
  if (m.L_d_H == m.L_q_H)
    return fmt::format("phase R = {} ohm, L = {} mH", sixstep::base::six_digits(m.R_ohm),
                       sixstep::base::six_digits(1e3 * m.L_q_H));
  return fmt::format("phase R = {} ohm, L_d = {} mH, L_q = {} mH", sixstep::base::six_digits(m.R_ohm),
                     sixstep::base::six_digits(1e3 * m.L_d_H), sixstep::base::six_digits(1e3 * m.L_q_H));
}

std::string machine_words(const sixstep::design::FieldMachine& m, const sixstep::plant::Shaft& shaft) {
  return fmt::format("{}, p = {}, psi = {} V s, J = {} g cm2, B = {} N m s", winding(m),
                     sixstep::base::six_digits(m.pole_pairs),
                     sixstep::base::six_digits(m.magnet_V_s / m.pole_pairs),
                     sixstep::base::six_digits(1e7 * shaft.J_kg_m2), sixstep::base::six_digits(shaft.B_Nm_s));
}

std::string field_motor_line(const FieldStudy& f) {
  const study::Scenario& s = f.scenario;
  const std::string itself = machine_words(f.simulated, f.simulated_shaft),
                    believed = machine_words(f.machine, f.design.motor.shaft);
  return fmt::format("{} on {} V: {}\n{}field-oriented, control and PWM period {}, a command acts {}\n",
                     visible(s.sheet.name.empty() ? s.motor : s.sheet.name),
                     sixstep::base::six_digits(f.design.bus_V), itself,
                     believed == itself ? "" : "the drive believes " + believed + "\n",
                     quantity_text(f.design.spec.period_s, "s"),
                     sixstep::design::late_words(f.design.spec.late_periods()) +
                         (f.design.spec.sampled_in_middle ? ", sampled in the middle of a period" : ""));
}

std::string table(const char* head, const std::vector<DerivationStep>& steps) {
  if (steps.empty()) return "";
  Rows rows;
  for (const DerivationStep& step : steps)
    rows.add({step.symbol, quantity_text(step.value, step.unit, 6), step.formula});
  return fmt::format("\n{}\n", head) + rows.text();
}

std::string sensing(const FieldStudy& f) {
  if (f.design.sensing.empty()) return "";
  const std::string words = sixstep::design::edges_words(f.design.spec.rotor);
  const std::string head =
      f.design.spec.rotor.hall ? "Speed from Hall edges, " + words.substr(6) : "Speed from the " + words;
  return table(head.c_str(), f.design.sensing);
}

}  // namespace

std::string field_design_verdict(const FieldStudy& f) {
  for (const auto& w : f.warnings)
    if (w.grave) return "NOT USABLE: " + w.what;
  const std::size_t n = f.warnings.size();
  return n == 0 ? "good" : fmt::format("usable, {} warning{}", n, n == 1 ? "" : "s");
}

std::string field_design_text(const FieldStudy& f, bool colour) {
  std::string verdict = field_design_verdict(f);
  if (colour) verdict = fmt::format("\x1b[{}m{}\x1b[0m", f.usable() ? "32" : "31;1", verdict);
  const sixstep::base::Motion motion = sixstep::design::motion_of(f.design.motor);
  std::string text = verdict + "\n\n" + field_motor_line(f) + beliefs_text(f.beliefs);
  for (const sixstep::design::LoopDesign& loop : f.design.loops) text += loop_text(loop, motion);
  text += table("Along the magnet and across it", f.axes) + figures_text(f.design) + sensing(f) +
          table("Limits by the bus", f.limits);
  if (!f.warnings.empty()) text += "\nWarnings\n";
  for (const auto& w : f.warnings)
    text += fmt::format("  - {}{}\n    {}\n", w.grave ? "GRAVE: " : "", visible(w.what), visible(w.cure));
  return text +
         "\nTest the scenario with all switching by sixstep run; measure the loop by sixstep run --bode\n";
}

}  // namespace text
