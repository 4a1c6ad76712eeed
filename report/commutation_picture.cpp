// SPDX-License-Identifier: Apache-2.0
#include "report/commutation_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"

namespace report {
namespace {

namespace analysis = sixstep::analysis;

constexpr double wave_left = 102, sector_width = 126, wave_right = wave_left + 6 * sector_width;
// heights of headings, lines, and levels of a Hall line; pixels
constexpr double heads_height = 34, line_height = 24, level_height = 13;
constexpr double emf_half = 30;
constexpr const char* leg_letters[] = {"a", "b", "c"};
constexpr const char* phase_colours[] = {"--a", "--b", "--c"};

std::string name(const std::string& what, double y) {
  return fmt::format("<text class=\"e\" x=\"{:.0f}\" y=\"{:.1f}\">{}</text>\n", wave_left - 12, y + 4, what);
}

std::string sectors(double bottom) {
  std::string out;
  for (std::uint8_t s = 0; s < 6; ++s) {
    const double x = wave_left + s * sector_width;
    const unsigned code = analysis::commutation(s).code;
    out += fmt::format(
        "<path class=\"w-axis\" d=\"M{0:.0f} {1:.0f}V{2:.0f}\"/><text class=\"m b\" x=\"{3:.0f}\" y=\"14\">sector {4}</text>"
        "<text class=\"m q s\" x=\"{3:.0f}\" y=\"28\">{5}…{6}°, code {7}{8}{9}</text>\n",
        x, heads_height, bottom, x + sector_width / 2, s, 60 * s, 60 * s + 60, code >> 2, code >> 1 & 1,
        code & 1);
  }
  return out + fmt::format("<path class=\"w-axis\" d=\"M{:.0f} {:.0f}V{:.0f}\"/>\n", wave_right, heads_height,
                           bottom);
}

std::string hall_lines(double y) {
  std::string out;
  for (unsigned line = 0; line < 3; ++line) {
    const double base = y + line_height * line + 18;
    std::string d;
    for (std::uint8_t s = 0; s < 6; ++s) {
      const double at = base - ((analysis::commutation(s).code >> (2 - line) & 1U) ? level_height : 0);
      d += fmt::format("{}{:.0f} {:.1f}H{:.0f}", s == 0 ? 'M' : 'L', wave_left + s * sector_width, at,
                       wave_left + (s + 1) * sector_width);
    }
    out += name(fmt::format("Hall H{}", line + 1), base - level_height / 2) +
           fmt::format("<path class=\"w-wire\" d=\"{}\"/>\n", d);
  }
  return out;
}

std::string back_emf(const analysis::WiringStudy& study, double middle) {
  const analysis::PairTorque torque(study.machine, study.bench.current_A);
  constexpr int points = 30;
  double most = 0.0;
  std::array<std::vector<Place>, 3> curves;
  for (std::size_t phase = 0; phase < 3; ++phase)
    for (std::uint8_t s = 0; s < 6; ++s)
      for (int n = 0; n <= points; ++n) {
        const double part = static_cast<double>(n) / points;
        const double e = torque.emf_V_s(s, part * sixstep::base::sector_rad, phase);
        most = std::max(most, std::fabs(e));
        curves[phase].push_back({wave_left + sector_width * (s + part), e});
      }
  std::string out =
      name("back-EMF", middle) +
      fmt::format("<path class=\"w-axis\" d=\"M{:.0f} {:.0f}H{:.0f}\"/><g transform=\"scale(.1)\">\n",
                  wave_left, middle, wave_right);
  for (std::size_t phase = 0; phase < 3; ++phase) {
    for (Place& p : curves[phase]) p.y = middle - emf_half * p.y / most;
    out += fmt::format("<path class=\"w-emf\" style=\"stroke:var({})\" d=\"{}\"/>\n", phase_colours[phase],
                       line_through(curves[phase]));
  }
  out += "</g>\n";
  for (std::size_t phase = 0; phase < 3; ++phase)  // each label is in the middle of the phase's flat top
    out += fmt::format("<text class=\"m b s\" style=\"fill:var({})\" x=\"{:.0f}\" y=\"{:.1f}\">{}</text>\n",
                       phase_colours[phase], wave_left + sector_width * (1 + 2 * static_cast<double>(phase)),
                       middle - emf_half + 13, leg_letters[phase]);
  return out;
}

/// A leg's six sectors: filled if the leg is high, empty if it is low, a dashed line if it floats.
std::string leg_band(std::size_t leg, double y) {
  std::string out = name(fmt::format("leg {}", leg_letters[leg]), y + 9) +
                    fmt::format("<g style=\"color:var({})\">", phase_colours[leg]);
  for (std::uint8_t s = 0; s < 6; ++s) {
    const analysis::Commutation row = analysis::commutation(s);
    const double x = wave_left + s * sector_width;
    const bool high = row.high == leg, low = row.low == leg;
    if (!high && !low) {
      out += fmt::format("<path class=\"w-float\" d=\"M{:.0f} {:.1f}h{:.0f}\"/>", x + 2, y + 9,
                         sector_width - 4);
      continue;
    }
    const std::size_t transistor = 2 * leg + (high ? 1 : 2);
    out += fmt::format(
        "<rect class=\"{}\" x=\"{:.0f}\" y=\"{:.1f}\" width=\"{:.0f}\" height=\"18\"/><text class=\"m s {}\" "
        "x=\"{:.0f}\" y=\"{:.1f}\">{} · T{}</text>",
        high ? "w-high" : "w-low", x + 1, y, sector_width - 2, high ? "w-on" : "", x + sector_width / 2,
        y + 13, high ? "high" : "low", transistor);
  }
  return out + "</g>\n";
}

}  // namespace

Panel commutation_picture(const analysis::WiringStudy& study) {
  const double emf_top = heads_height + 3 * line_height + 12, bands = emf_top + 2 * emf_half + 12;
  const double bottom = bands + 3 * line_height;
  std::string svg = sectors(bottom) + hall_lines(heads_height) + back_emf(study, emf_top + emf_half);
  for (std::size_t leg = 0; leg < 3; ++leg)
    svg += leg_band(leg, bands + line_height * static_cast<double>(leg));
  return {wave_right + 8, bottom + 6, std::move(svg)};
}

}  // namespace report
