// SPDX-License-Identifier: Apache-2.0
#include "text/results/wiring_words.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace text {
namespace {

using analysis::moved;
using analysis::WiringDoes;

using Names = std::string_view[3];

/// The positions whose wires change, in cyclic order: each wire moves to the next position, and the last wire
/// to the first position.
std::vector<std::size_t> round(const analysis::Moves& moves) {
  std::vector<std::size_t> out;
  for (std::size_t place = 0; place < 3 && out.empty(); ++place)
    for (std::size_t at = place; moves[at] != at && (out.empty() || at != place); at = moves[at])
      out.push_back(at);
  return out;
}

std::string moves_text(const analysis::Moves& moves, const Names& names, const char* wires) {
  const std::vector<std::size_t> way = round(moves);
  if (way.size() == 2) return fmt::format("swap the {} {} and {}", wires, names[way[0]], names[way[1]]);
  return fmt::format("move the {}: {} to {}, {} to {}, {} to {}", wires, names[way[0]], names[way[1]],
                     names[way[1]], names[way[2]], names[way[2]], names[way[0]]);
}

std::string moves_mark(const analysis::Moves& moves, const Names& names) {
  const std::vector<std::size_t> way = round(moves);
  if (way.size() == 2) return fmt::format("{}-{}", names[way[0]], names[way[1]]);
  return fmt::format("{}>{}>{}", names[way[0]], names[way[1]], names[way[2]]);
}

base::Motion motion_of(const analysis::WiringStudy& s) { return design::motion_of(s.subject.sheet); }

}  // namespace

std::string_view phases_word(const sixstep::rig::Wiring& w) {
  return base::word(study::phase_order_choices, w.phases);
}
std::string_view hall_lines_word(const sixstep::rig::Wiring& w) {
  return base::word(study::hall_order_choices, w.probes);
}

std::span<const WiringDoes> told_order() {
  static constexpr WiringDoes order[] = {
      WiringDoes::forward,       WiringDoes::forward_early,  WiringDoes::forward_late, WiringDoes::hums,
      WiringDoes::backward_late, WiringDoes::backward_early, WiringDoes::backward};
  return order;
}

std::string_view does_text(WiringDoes does) {
  switch (does) {
    case WiringDoes::forward:
      return "FORWARD";
    case WiringDoes::forward_early:
      return "forward, early";
    case WiringDoes::forward_late:
      return "forward, late";
    case WiringDoes::backward:
      return "BACKWARD";
    case WiringDoes::backward_early:
      return "backward, early";
    case WiringDoes::backward_late:
      return "backward, late";
    case WiringDoes::hums:
      return "hums";
    case WiringDoes::unclear:
      break;
  }
  return "unclear";
}

std::string_view short_does_text(WiringDoes does) {
  const std::string_view text = does_text(does);
  const std::size_t comma = text.find(", ");
  return comma == text.npos ? text : text.substr(comma + 2);
}

std::string_view next_step_text(WiringDoes does) {
  if (does == WiringDoes::forward) return "Leave it.";
  if (does == WiringDoes::backward) return "Swap phases a and b, Hall lines H2 and H3.";
  if (does == WiringDoes::hums || does == WiringDoes::unclear)
    return "Swap any two phase wires: the motor then runs, perhaps early, late or backward.";
  return "Shift all three phase wires, once or twice.";
}

std::string_view does_name(WiringDoes does) {
  constexpr std::string_view names[] = {"forward",        "forward_early", "forward_late", "backward",
                                        "backward_early", "backward_late", "hums",         "unclear"};
  return names[static_cast<std::size_t>(does)];
}

std::string symptom_text(const analysis::WiringStudy& s, WiringDoes does) {
  const analysis::Symptom here = s.symptom(does), well = s.straight();
  if (does == WiringDoes::forward) return "runs correctly";
  if (does == WiringDoes::backward) return "runs as well as forward";
  const auto times = [](double x) { return fmt::format("{:.{}f}", x, x < 9.95 ? 1 : 0); };
  // A correct wiring draws almost no current if the sheet has no friction. Any other wiring then draws some
  // thousand times as much, and the ratio is not meaningful.
  const double ratio = here.phase_rms_A / well.phase_rms_A;
  const std::string current =
      ratio < 100 ? times(ratio) + " times the current" : "more than 100 times the current";
  if (does == WiringDoes::hums) return fmt::format("jerks, stops, hums; {}", current);
  if (analysis::direction_of(does) == 0) return "behaves differently from start to start";
  return fmt::format("runs rough; {}", current);
}

std::string cure_text(const analysis::Cure& c) {
  if (c.wires() == 0) return "nothing";
  std::string text = moved(c.legs) ? moves_text(c.legs, leg_names,
                                                moved(c.legs) == 2 ? "phase wires at legs" : "phase wires")
                                   : "";
  if (moved(c.pins)) text += (text.empty() ? "" : " and ") + moves_text(c.pins, hall_pin_names, "Hall lines");
  return text;
}

std::string cure_mark(const analysis::Cure& c) {
  if (c.wires() == 0) return "-";
  std::string mark = moved(c.legs) ? moves_mark(c.legs, leg_names) : "";
  if (moved(c.pins)) mark += (mark.empty() ? "" : " ") + moves_mark(c.pins, hall_pin_names);
  return mark;
}

std::span<const std::pair<std::string_view, std::string_view>> recipe_steps() {
  static constexpr std::pair<std::string_view, std::string_view> steps[] = {
      {"the motor jerks and hums", "swap any two phase wires; then the motor runs"},
      {"the motor runs rough",
       "move all phase wires by one leg, once more if it is still rough; then it runs well backward"},
      {"the motor runs well, but backward",
       "swap the phase wires at legs a and b and the Hall lines at H2 and H3, or negate the reference"},
  };
  return steps;
}

std::string_view recipe_note() {
  return "With three of the six orders of the phase wires the motor hums. With two orders the motor runs rough in one direction, and with one order it runs well in the other direction. If two Hall lines are swapped, the motor runs backward with this last order, and moving phase wires alone cannot correct the direction.";
}

std::string way_text(const analysis::WiringStudy& s, double electrical_deg) {
  const base::LinearUnit unit = motion_of(s).unit("deg");
  return fmt::format("{:.2g} {}{}", electrical_deg / s.bench.motor.machine.pole_pairs * unit.factor,
                     unit.linear, motion_of(s).linear ? "" : " of the shaft");
}

std::string wiring_speed_text(const analysis::WiringStudy& s, double rad_s) {
  if (motion_of(s).linear) return fmt::format("{:.3g} m/s", rad_s);
  const double rpm = rad_s * 30 / base::pi;
  return std::fabs(rpm) < 99.95 ? fmt::format("{:.1f} rpm", rpm) : fmt::format("{:.0f} rpm", rpm);
}

std::vector<std::string> wiring_scenario_lines() {
  return {
      "The motor starts from rest, with straight wires. To cross wires:",
      "  [bridge] phases = \"bac\", [sensors] hall_lines = \"132\"",
      "A motor that runs well still accelerates at the end of this run; the table has the settled speed."};
}

std::string bench_text(const analysis::WiringStudy& s) {
  const analysis::WiringBench& b = s.bench;
  const char* const is = b.from == analysis::BenchCurrent::nominal ? ", its nominal current" : "";
  const base::Result<design::MotorModel> motor = design::motor_model(s.subject.sheet);
  const bool rubs = !motor || motor->shaft.coulomb_Nm > 0 || motor->shaft.B_Nm_s > 0;
  return motion_of(s).words(fmt::format(
      "{:.6g} V, duty {:.4g}, no load{}; the stalled motor draws {:.4g} A{}, at full duty {:.4g} A",
      b.voltage_V, b.duty, rubs ? "" : ", no friction (the motor file names none)", b.current_A, is,
      b.current_A / b.duty));
}

}  // namespace text
