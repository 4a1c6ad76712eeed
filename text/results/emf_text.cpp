// SPDX-License-Identifier: Apache-2.0
#include "text/results/emf_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/identification/emf/emf_doubts.hpp"
#include "sixstep/base/angle.hpp"
#include "text/escape/escape.hpp"
#include "text/results/interval_text.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/text_rows.hpp"

namespace text {
namespace {

using analysis::EmfResult;
using analysis::Interval;

constexpr double rad_s_per_krpm = 1000.0 * base::pi / 30.0, to_percent = 100.0;

std::string shown_constant(const Interval& x, const char* unit) {
  return fmt::format("{} {}", measured_text(x), unit);
}

std::string heading(const MeasuredEmf& m) {
  const EmfResult& r = m.result;
  std::string out = fmt::format("{}: {} rows in {}, {:.3g} periods of {} ({})", visible(m.name), r.rows,
                                quantity_text(r.seconds, "s", 4), r.periods,
                                shown_constant(r.frequency_Hz, "Hz"), bounds_text(r.frequency_Hz));
  if (std::fabs(r.change_Hz_s) * r.seconds > 1e-3 * r.frequency_Hz.value)
    out += fmt::format(", changing by {:.3g} Hz/s", r.change_Hz_s);
  out += "\n";
  if (r.pole_pairs > 0)
    out += fmt::format("  {} pole pairs: {:.5g} rpm\n", r.pole_pairs,
                       r.frequency_Hz.value * 60.0 / r.pole_pairs);
  if (r.all_phases)
    out += fmt::format("  the voltages follow each other {}\n",
                       r.backward ? "backward, c b a" : "forward, a b c");
  return out;
}

std::string channels_section(const EmfResult& r) {
  Rows rows;
  rows.add({"Channel", "fundamental, V", "95 %", "behind, deg", "offset, V", "noise, V rms", "step, V"});
  for (const analysis::EmfChannelResult& c : r.channels)
    rows.add({visible(c.name), measured_text(c.peak_V), bounds_text(c.peak_V),
              &c == &r.channels.front() ? "" : measured_text(c.phase_deg), fmt::format("{:.3g}", c.offset_V),
              fmt::format("{:.2g}", c.residual_rms_V), fmt::format("{:.2g}", c.step_V)});
  std::string out = rows.text();
  for (const analysis::EmfChannelResult& c : r.channels)
    if (analysis::may_be_clipped(c))
      out += fmt::format(
          "  {} stays at its greatest value for {:.2g} % of a period, and may be clipped; the upper bounds of the constants include this\n",
          visible(c.name), to_percent * c.clipped);
  return out;
}

struct ConstantRow {
  const char* name;
  const Interval& V_s_rad;
};

std::string constants_section(const EmfResult& r) {
  const analysis::EmfConstants& k = r.constants;
  const bool star = r.between == analysis::EmfBetween::star;
  const ConstantRow all[] = {{"line, peak", k.line_peak},
                             {"line, rms", k.line_rms},
                             {"phase, peak", k.phase_peak},
                             {"phase, rms", k.phase_rms},
                             {"phase, fundamental", k.phase_fundamental}};
  Rows rows;
  const double p = std::max(r.pole_pairs, 1);
  rows.add({"Constant", r.pole_pairs > 0 ? "mV s/rad" : "mWb", "95 %", r.pole_pairs > 0 ? "V/krpm" : "",
            r.pole_pairs > 0 ? "rpm/V" : ""});
  for (const ConstantRow& row : all) {
    const Interval V_s = analysis::scaled(row.V_s_rad, p);
    const Interval mV_s = analysis::scaled(V_s, 1e3), krpm = analysis::scaled(V_s, rad_s_per_krpm);
    rows.add({row.name, measured_text(mV_s), bounds_text(mV_s), r.pole_pairs > 0 ? measured_text(krpm) : "",
              r.pole_pairs > 0 ? fmt::format("{:.4g}", 1000.0 / krpm.value) : ""});
  }
  if (r.pole_pairs > 0) {
    const Interval K_t = analysis::scaled(k.phase_peak, 1e3 * p * r.shape_sector_mean),
                   flux = analysis::scaled(k.phase_fundamental, 1e3);
    rows.add({"K_t, six-step, mNm/A", measured_text(K_t), bounds_text(K_t)});
    rows.add({"flux linkage, mWb", measured_text(flux), bounds_text(flux)});
  }
  std::string out = rows.text();
  if (r.pole_pairs == 0)
    out += "  per electrical rad/s; give --pole-pairs or --speed for constants per turn of the shaft\n";
  if (!star)
    out += "  values of a phase, without harmonics of order 3, 9, 15, which cancel between two terminals\n";
  return out;
}

std::string harmonics_section(const EmfResult& r) {
  Rows rows;
  rows.add({"Harmonic", "% of the fundamental", "95 %", "noise below", "in phase"});
  std::size_t hidden = 0;
  for (const analysis::EmfHarmonic& h : r.harmonics) {
    const bool common = h.order % 3 == 0 && r.between == analysis::EmfBetween::lines;
    const bool usual = h.order == 3 || h.order == 5 || h.order == 7;
    if (!h.stands_out && !usual) {
      ++hidden;
      continue;
    }
    const Interval part = analysis::scaled(h.part, to_percent);
    rows.add({std::to_string(h.order), measured_text(part), bounds_text(part),
              fmt::format("{:.2g}", to_percent * h.floor),
              !h.stands_out ? ""
              : common ? "not from the motor, because harmonics of this order cancel between two terminals"
                       : fmt::format("{:+.2g} %", to_percent * h.in_phase)});
  }
  std::string out = rows.text();
  if (hidden > 0) out += fmt::format("  {} more do not exceed the noise\n", hidden);
  const char* const probed = r.between == analysis::EmfBetween::lines ? "line" : "phase";
  return out +
         fmt::format(
             "  {}: crest factor {:.4g} (a sine has 1.414), above 95 % of its peak for {:.3g} deg (a sine {:.3g}{})\n",
             probed, r.crest, r.flat_deg, analysis::flat_of_sine_deg,
             r.between == analysis::EmfBetween::star
                 ? fmt::format(", a trapezoid of 120 deg {:.3g}", analysis::flat_of_trapezoid_deg)
                 : "");
}

std::string check_words(const analysis::FrameCheck& c, double tolerance) {
  const analysis::FrameReading* const printed = c.as_printed();
  std::string fitting;
  for (const analysis::FrameReading& r : c.readings)
    if (r.fits) fitting += (fitting.empty() ? "" : ", ") + std::string(r.frame);
  if (printed && printed->fits)
    return "fits" +
           (fitting == printed->frame ? std::string() : "; within the tolerance these fit, too: " + fitting);
  if (fitting.empty())
    return fmt::format("CONTRADICTS: the recording fits the value in no frame within {:g} %",
                       to_percent * tolerance);
  if (!printed) return "names no frame; fits " + fitting;
  return "CONTRADICTS: the value fits " + fitting;
}

std::string sheet_section(const MeasuredEmf& m) {
  if (m.sheet.empty()) return "";
  std::string out = fmt::format("\nCompared with the sheet of {}, within {:g} %\n", visible(m.sheet),
                                to_percent * m.tolerance);
  if (m.checks.empty()) out += "  the sheet has no back-EMF value that can be compared\n";
  for (const analysis::FrameCheck& c : m.checks) {
    out +=
        fmt::format("  {} = {:g} {}: {}\n", visible(c.key), c.printed, c.unit, check_words(c, m.tolerance));
    Rows rows;
    for (const analysis::FrameReading& r : c.readings)
      rows.add({"", std::string(r.frame), measured_text(r.measured),
                fmt::format("{:+.1f} %", to_percent * r.deviation), r.fits ? "fits" : "",
                r.is_printed ? "as printed" : ""});
    out += rows.text();
  }
  return out;
}

}  // namespace

std::string emf_text(const MeasuredEmf& m) {
  return heading(m) + "\n" + channels_section(m.result) + "\n" + constants_section(m.result) + "\n" +
         harmonics_section(m.result) + sheet_section(m) + "\nFor the motor's file\n" + emf_motor_lines(m, "");
}

}  // namespace text
