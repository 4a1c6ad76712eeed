// SPDX-License-Identifier: Apache-2.0
#include "report/wiring_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/commutation_picture.hpp"
#include "report/html.hpp"
#include "report/wiring_grid.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "text/results/wiring_words.hpp"

namespace report {
namespace {

using sixstep::analysis::WiringStudy;

constexpr double sheet_margin = 20, sheet_gap = 22, head = 60;

/// The page's colours (web/report.css), for a picture that is not in a page.
constexpr std::string_view colours =
    R"(svg{--page:#f6f7f8;--paper:#fff;--ink:#171b20;--quiet:#59636e;--line:#dce0e5;--a:#0072b2;--b:#d55e00;--c:#008f66}
@media (prefers-color-scheme:dark){svg{--page:#101316;--paper:#171b1f;--ink:#e7eaed;--quiet:#9ca6b1;--line:#2c333a;--a:#56b4e9;--b:#f08a3c;--c:#2fc79a}}
)";

std::string placed(const Panel& panel, double x, double y) {
  return fmt::format("<g transform=\"translate({:.0f} {:.0f})\">\n{}</g>\n", x, y, panel.svg);
}

Panel steps(double width) {
  constexpr std::size_t characters = 58;
  std::string svg = "<text class=\"b\" x=\"0\" y=\"14\">If the wires are not labelled</text>\n";
  double y = 36;
  for (const auto& [seen, step] : text::recipe_steps()) {
    svg += fmt::format("<text class=\"b s\" x=\"0\" y=\"{:.0f}\">{}</text>\n", y, escaped(seen));
    svg += wrapped(step, characters, 0, y + 14, 14, "s");
    y += 14 * static_cast<double>(lines_of(step, characters)) + 20;
  }
  svg += wrapped(text::recipe_note(), characters, 0, y + 4, 14, "s q");
  return {width, y + 4 + 14 * static_cast<double>(lines_of(text::recipe_note(), characters)), std::move(svg)};
}

}  // namespace

std::string in_figure(const Panel& panel, std::string_view label) {
  return fmt::format(
      "<figure class=\"wiring\"><svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n{}</svg></figure>\n",
      panel.width, panel.height, escaped(label), panel.svg);
}

std::string wiring_picture(const WiringStudy& s, std::string_view version) {
  const Panel grid = wiring_grid(s), cards = wiring_cards(s, grid.height),
              commutation = commutation_picture(s);
  const Panel recipe = steps(cards.width);
  const double right = sheet_margin + grid.width + sheet_gap, below = head + grid.height + sheet_gap;
  const double width = right + cards.width + sheet_margin;
  const double height = below + std::max(commutation.height, recipe.height) + sheet_margin;
  const std::string title = fmt::format("The 36 ways to connect the {}", s.subject.sheet.name);
  const sixstep::base::Motion motion = sixstep::design::motion_of(s.subject.sheet);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"wiring\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
             "height=\"{1:.0f}\" role=\"img\"><desc>Made by sixstep {2}</desc>\n<title>{3}</title>\n<style>{4}{5}</style>\n"
             "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" style=\"fill:var(--page)\"/>\n"
             "<text class=\"b\" style=\"font-size:19px\" x=\"{6:.0f}\" y=\"30\">{3}</text>\n"
             "<text class=\"q\" x=\"{6:.0f}\" y=\"48\">{7}</text>\n",
             width, height, escaped(version), escaped(motion.words(title)), colours, wiring_style(),
             sheet_margin, escaped(text::bench_text(s))) +
         placed(grid, sheet_margin, head) + placed(cards, right, head) +
         placed(commutation, sheet_margin, below) + placed(recipe, right, below) + "</svg>\n";
}

}  // namespace report
