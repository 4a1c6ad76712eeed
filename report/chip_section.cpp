// SPDX-License-Identifier: Apache-2.0
#include "report/chip_section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/html.hpp"
#include "text/results/core_text.hpp"

namespace report {

namespace {

using sixstep::rig::InterruptTimes;

constexpr int least_bar_wide = 9, least_wide = 160, picture_high = 110, axis_high = 22;

struct Bins {
  int first = 0, last = 0;
  std::uint32_t most = 1;
};

/// The range of nonempty bins, with an empty bin on either side.
Bins bins_of(const InterruptTimes& t) {
  Bins b{InterruptTimes::bins - 1, 0, 1};
  for (int n = 0; n < InterruptTimes::bins; ++n) {
    if (t.bin[n] == 0) continue;
    b.first = std::min(b.first, n);
    b.last = std::max(b.last, n);
    b.most = std::max(b.most, t.bin[n]);
  }
  return {std::max(b.first - 1, 0), std::min(b.last + 1, InterruptTimes::bins - 1), b.most};
}

/// Bars with the number of interrupts per duration. The durations of the first and the last bar are printed
/// below them.
std::string histogram(const InterruptTimes& t, double clock_Hz) {
  const Bins b = bins_of(t);
  const int bins = b.last - b.first + 1, bar_wide = std::max(least_bar_wide, least_wide / bins);
  const int wide = bar_wide * bins;
  std::string bars;
  for (int n = b.first; n <= b.last; ++n) {
    const double high = 100.0 * t.bin[n] / b.most;
    const double from = n * double(t.bin_cycles), to = from + t.bin_cycles;
    bars += fmt::format(
        "<rect x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"currentColor\"><title>{} to {}: {}</title></rect>",
        bar_wide * (n - b.first), picture_high - high, bar_wide - 1, high, text::cycles_text(from, clock_Hz),
        text::cycles_text(to, clock_Hz), t.bin[n]);
  }
  return fmt::format(
      "<svg viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" aria-label=\"histogram of the durations\">{2}<text x=\"0\" y=\"{3}\" font-size=\"12\" fill=\"currentColor\">{4}</text><text x=\"{0}\" y=\"{3}\" font-size=\"12\" fill=\"currentColor\" text-anchor=\"end\">{5}</text></svg>",
      wide, picture_high + axis_high, bars, picture_high + axis_high - 6,
      text::cycles_text(b.first * double(t.bin_cycles), clock_Hz),
      text::cycles_text((b.last + 1) * double(t.bin_cycles), clock_Hz));
}

std::string card(const char* title, const InterruptTimes& t, double clock_Hz) {
  return t.count == 0 ? ""
                      : fmt::format("<figure><figcaption>{}: {} times</figcaption>{}</figure>\n", title,
                                    t.count, histogram(t, clock_Hz));
}

}  // namespace

std::string chip_section(const sixstep::study::Outcome& outcome) {
  if (!outcome.chip) return "";
  std::string html = "<h2>How long the chip's interrupts took</h2>\n";
  for (const std::string& told : text::core_texts(outcome))
    html += fmt::format("<p>{}.</p>\n", escaped(told));
  return html + card("Control interrupt", outcome.chip->times.control, outcome.chip->clock_Hz) +
         card("Hall interrupt", outcome.chip->times.hall, outcome.chip->clock_Hz);
}

}  // namespace report
