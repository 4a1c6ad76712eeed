// SPDX-License-Identifier: Apache-2.0
#include "report/wiring_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "text/results/wiring_words.hpp"

namespace report {
namespace {

namespace analysis = sixstep::analysis;
namespace rig = sixstep::rig;
using analysis::WiringCase;
using analysis::WiringStudy;

constexpr double grid_left = 102, grid_top = 92, cell_width = 122, cell_height = 106, grid_gap = 6,
                 group_gap = 10;
constexpr double torque_middle = 43, torque_half = 18, run_middle = 83, run_half = 17, side = 8;
constexpr double most_torque = 1.15;  // relative to the mean torque with straight wires

double at(std::size_t n, double begin, double size) {
  return begin + static_cast<double>(n) * (size + grid_gap) + (n >= 3 ? group_gap : 0);
}

/// Draws three wires from the motor's terminals, in their order, to the board's terminals.
std::string wires(const std::array<std::uint8_t, 3>& ends, const char* const (&from)[3],
                  const char* const (&to)[3], double x, double y, bool across) {
  std::string out;
  const auto text = [&](const char* what, double along, double off, const char* style) {
    out += fmt::format("<text class=\"m s {}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", style,
                       x + (across ? off : along), y + (across ? along : off) + 3.5, what);
  };
  const auto place = [](std::size_t n) { return 18.0 * (static_cast<double>(n) - 1); };
  for (std::size_t n = 0; n < 3; ++n) {
    const double begin = place(ends[n]), end = place(n);
    const double x1 = across ? begin : 8, y1 = across ? 8 : begin, x2 = across ? end : 38,
                 y2 = across ? 38 : end;
    out += fmt::format("<path class=\"w-wire\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", x + x1, y + y1,
                       x + x2, y + y2);
    text(from[n], 0, place(n), "q");
    text(to[n], 46, place(n), "b");
  }
  return out;
}

std::string headers(const WiringStudy& s) {
  constexpr const char* phases[] = {"a", "b", "c"};
  constexpr const char* probes[] = {"1", "2", "3"};
  constexpr const char* pins[] = {"H1", "H2", "H3"};
  std::string out =
      "<text class=\"q s\" x=\"4\" y=\"40\">motor’s phases</text><text class=\"q s\" x=\"4\" y=\"53\">and probes to the</text>"
      "<text class=\"q s\" x=\"4\" y=\"66\">board’s <tspan class=\"b\">legs</tspan></text>"
      "<text class=\"q s\" x=\"4\" y=\"79\">and <tspan class=\"b\">Hall pins</tspan></text>\n";
  for (std::size_t n = 0; n < 6; ++n) {
    const rig::Wiring &column = s.cases[n].wiring, &row = s.cases[6 * n].wiring;
    out += fmt::format("<text class=\"m b\" x=\"{:.1f}\" y=\"14\">{}</text>\n",
                       at(n, grid_left, cell_width) + cell_width / 2, text::hall_lines_word(column));
    out += wires(rig::ends_of(column.probes), probes, pins, at(n, grid_left, cell_width) + cell_width / 2, 30,
                 true);
    out += fmt::format("<text class=\"b\" x=\"2\" y=\"{:.1f}\">{}</text>\n",
                       at(n, grid_top, cell_height) + cell_height / 2 + 4, text::phases_word(row));
    out += wires(rig::ends_of(row.phases), phases, phases, 43, at(n, grid_top, cell_height) + cell_height / 2,
                 false);
  }
  return out;
}

std::string torque(const analysis::PairTorque& of, double straight_Nm_A, const WiringCase& c,
                   double measured_Nm_A) {
  constexpr double wide = cell_width - 2 * side;
  const auto place = [](double deg, double part) {
    return Place{side + wide * deg / 360,
                 torque_middle - torque_half * std::clamp(part / most_torque, -1.0, 1.0)};
  };
  std::vector<Place> theory = {place(0, 0)}, seen;
  for (const analysis::TorquePoint& p : analysis::torque_over_turn(of, c.wiring, 20))
    theory.push_back(place(p.electrical_deg, p.torque_Nm_A / straight_Nm_A));
  theory.push_back(place(360, 0));
  for (std::size_t n = 0; n < c.measured.torque_over_turn.size(); ++n)
    seen.push_back(place(360 * (static_cast<double>(n) + 0.5) / analysis::turned_rows,
                         c.measured.torque_over_turn[n] / measured_Nm_A));
  return fmt::format("<path class=\"w-theory\" d=\"{}z\"/><path class=\"w-seen\" d=\"{}\"/>\n",
                     line_through(theory), line_through(seen));
}

/// The part of a turn that fills the height, for a humming motor.
constexpr double humming_turns = 0.4;

std::string runs(const WiringCase& c, double running_turns) {
  const double most_turns = analysis::direction_of(c.measured.does) == 0 ? humming_turns : running_turns;
  constexpr double wide = cell_width - 2 * side;
  std::string out;
  for (const analysis::FreeRun& run : c.measured.runs) {
    std::vector<Place> line;
    for (std::size_t n = 0; n < run.turned.size(); ++n)
      line.push_back({side + wide * static_cast<double>(n) / static_cast<double>(run.turned.size() - 1),
                      run_middle - run_half * std::clamp(run.turned[n] / most_turns, -1.0, 1.0)});
    out += fmt::format("<path class=\"w-run\" d=\"{}\"/>\n", line_through(line));
  }
  return out;
}

}  // namespace

Panel wiring_grid(const WiringStudy& s) {
  const analysis::PairTorque of(s.machine, s.bench.current_A);
  const WiringCase& straight = s.cases.front();
  const double straight_A = s.straight().phase_rms_A;
  double most = 1.0;
  for (const WiringCase& c : s.cases)
    for (const analysis::FreeRun& run : c.measured.runs)
      for (const float turned : run.turned) most = std::max(most, std::fabs(static_cast<double>(turned)));
  std::string svg = headers(s);
  for (std::size_t n = 0; n < s.cases.size(); ++n) {
    const WiringCase& c = s.cases[n];
    const double times = s.symptom(c).phase_rms_A / straight_A;
    const double x = at(n % 6, grid_left, cell_width), y = at(n / 6, grid_top, cell_height);
    svg += fmt::format(
        "<g class=\"{}\" transform=\"translate({:.0f} {:.0f})\"><title>phases {}, Hall lines {}: {}</title>\n"
        "<rect class=\"w-cell\" width=\"{:.0f}\" height=\"{:.0f}\" rx=\"6\"/><rect class=\"w-bar\" width=\"{:.0f}\" height=\"3\" "
        "rx=\"1.5\"/>{}<text class=\"b\" x=\"24\" y=\"18\">{}</text><text class=\"e q s\" x=\"{:.0f}\" y=\"18\">{}</text>\n",
        style_of(c.measured.does), x, y, text::phases_word(c.wiring), text::hall_lines_word(c.wiring),
        text::does_text(c.measured.does), cell_width, cell_height, cell_width,
        mark_of(c.measured.does, side, 8), text::short_does_text(c.measured.does), cell_width - side,
        times < 1.5 ? "" : times_text(times));
    for (const double middle : {torque_middle, run_middle})
      svg += fmt::format("<path class=\"w-axis\" d=\"M{:.0f} {:.0f}h{:.0f}\"/>", side, middle,
                         cell_width - 2 * side);
    svg += "<g transform=\"scale(.1)\">" +
           torque(of, straight.theory.mean_Nm_A, c, straight.measured.torque_Nm_A) +
           runs(c, std::ceil(most)) + "</g></g>\n";
  }
  const double bottom = at(5, grid_top, cell_height) + cell_height + 18;
  const sixstep::base::Motion motion = sixstep::design::motion_of(s.subject.sheet);
  const std::string key[] = {
      "Upper: torque over one electrical turn at the same current; filled: theory, line: simulation; up is forward.",
      fmt::format(
          "Lower: motion after six starts, during {}. Full scale: ±{} electrical turns, or ±{} for a humming motor.",
          computed(s.bench.free_s, "s"), plain(std::ceil(most), 2, true), plain(humming_turns, 1)),
      "× before a number: phase current without load, relative to straight wires."};
  for (std::size_t n = 0; n < 3; ++n)
    svg += fmt::format("<text class=\"q s\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n", grid_left,
                       bottom + 15.0 * static_cast<double>(n), escaped(motion.words(key[n])));
  return {at(5, grid_left, cell_width) + cell_width, bottom + 35, std::move(svg)};
}

}  // namespace report
