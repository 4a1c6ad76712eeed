// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/wiring_grid.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/wiring_words.hpp"

namespace report {
namespace {

namespace analysis = sixstep::analysis;
using analysis::Symptom;
using analysis::WiringDoes;
using analysis::WiringStudy;

constexpr double card_width = 384, card_gap = 6, card_chart_left = 12, chart_width = 112, text_left = 138;
constexpr std::size_t card_characters = 40;
/// Drawn fraction of a run; later the current does not change.
constexpr double shown_part = 0.4;

/// The current after one start. The scale ends at 1.3 times the current of the locked motor.
std::string current(const WiringStudy& s, const analysis::FreeRun& run, double top, double bottom) {
  const double most = 1.3 * s.bench.current_A;
  std::vector<Place> line;
  const auto rows = static_cast<std::size_t>(shown_part * static_cast<double>(run.current_A.size()));
  for (std::size_t n = 0; n < rows; ++n)
    line.push_back({card_chart_left + chart_width * static_cast<double>(n) / static_cast<double>(rows - 1),
                    bottom - (bottom - top) * std::min(run.current_A[n] / most, 1.0)});
  const double stalled = bottom - (bottom - top) / 1.3;
  return fmt::format(
      "<path class=\"w-axis\" d=\"M{0:.0f} {1:.1f}h{2:.0f}\"/><path class=\"w-level\" d=\"M{0:.0f} {3:.1f}h{2:.0f}\"/>"
      "<g transform=\"scale(.1)\"><path class=\"w-run\" d=\"{4}\"/></g>\n",
      card_chart_left, bottom, chart_width, stalled, line_through(line));
}

std::string figures(const WiringStudy& s, WiringDoes does, const Symptom& here) {
  const std::string moves =
      analysis::direction_of(does) != 0
          ? text::wiring_speed_text(s, here.speed_rad_s)
          : fmt::format("swings {} at {:.0f} Hz", text::way_text(s, here.swing_deg), here.swing_Hz);
  const auto amperes = [](double A) { return text::quantity_text(A, "A", 3); };
  return fmt::format("{}, {} rms, supply {}", moves, amperes(here.phase_rms_A), amperes(here.supply_A));
}

std::string card(const WiringStudy& s, WiringDoes does, double height) {
  const Symptom here = s.symptom(does);
  std::string svg = fmt::format(
      "<rect class=\"w-cell\" width=\"{:.0f}\" height=\"{:.1f}\" rx=\"6\"/><rect class=\"w-bar\" width=\"3\" height=\"{:.1f}\" "
      "rx=\"1.5\"/>{}<text class=\"b\" x=\"28\" y=\"19\">{}</text><text class=\"e q s\" x=\"{:.0f}\" y=\"19\">{} of {}</text>\n",
      card_width, height, height, mark_of(does, card_chart_left, 9), text::does_text(does), card_width - 10,
      here.ways, s.cases.size());
  svg += current(s, s.example(does)->measured.runs.front(), 28, height - 10);
  double y = 37;
  for (const auto& [what, style] : {std::pair{figures(s, does, here), "s q"},
                                    {text::symptom_text(s, does), "s"},
                                    {std::string(text::next_step_text(does)), "s b"}}) {
    svg += wrapped(what, card_characters, text_left, y, 13, style);
    y += 13 * static_cast<double>(lines_of(what, card_characters)) + 2;
  }
  return svg;
}

}  // namespace

Panel wiring_cards(const WiringStudy& s, double height) {
  std::vector<WiringDoes> seen;
  for (const WiringDoes does : text::told_order())
    if (s.example(does)) seen.push_back(does);
  constexpr double head = 20;
  const double each =
      (height - head - card_gap * static_cast<double>(seen.size() - 1)) / static_cast<double>(seen.size());
  std::string svg = fmt::format(
      "<text class=\"b\" x=\"0\" y=\"12\">Symptom</text><text class=\"e q s\" x=\"{:.0f}\" y=\"12\">current "
      "from rest on, {}; dashed: {}</text>\n",
      card_width, escaped(computed(shown_part * s.bench.free_s, "s")),
      escaped(computed(s.bench.current_A, "A")));
  double y = head;
  for (const WiringDoes does : seen) {
    svg += fmt::format("<g class=\"{}\" transform=\"translate(0 {:.1f})\">{}</g>\n", style_of(does), y,
                       card(s, does, each));
    y += each + card_gap;
  }
  return {card_width, height, std::move(svg)};
}

}  // namespace report
