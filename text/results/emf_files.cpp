// SPDX-License-Identifier: Apache-2.0
// Writes a measured back-EMF as lines of a motor's file, as a table, and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sixstep/base/angle.hpp"
#include "text/escape/escape.hpp"
#include "text/results/emf_text.hpp"
#include "text/results/interval_json.hpp"
#include "text/results/interval_text.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;
using analysis::EmfHarmonic;
using analysis::EmfResult;
using analysis::Interval;

/// Relative size below which harmonics do not matter: a drive with this shape behaves as with a sine.
constexpr double as_good_as_none = 0.01;
constexpr std::size_t most_listed = 5;  // limit of the list harmonic_orders
constexpr int highest_listed = 23;

bool counts(const EmfHarmonic& h, const EmfResult& r) {
  const bool common = h.order % 3 == 0 && r.between == analysis::EmfBetween::lines;
  return h.stands_out && !common && h.part.value >= as_good_as_none;
}

std::string measured_source(const MeasuredEmf& m) {
  return fmt::format("source = {}, kind = \"measured\"", toml_text(m.name));
}

/// The line with the constant. For a sine it is the voltage at a drill's speed. For any other shape it is the
/// flux linkage of the fundamental, because it does not depend on harmonics that the lines above omit.
std::string constant_line(const MeasuredEmf& m) {
  const EmfResult& r = m.result;
  const std::string pairs = r.pole_pairs > 0 ? fmt::format("pole_pairs = {}\n", r.pole_pairs) : "";
  if (r.pole_pairs > 0 && shape_words(r) == ShapeWords::sine) {
    const Interval V_krpm =
        analysis::scaled(r.constants.line_fundamental, r.pole_pairs * 1000.0 * base::pi / 30.0);
    return pairs +
           fmt::format(
               "back_emf_constant_V_krpm = {{ value = {}, frame = \"line-peak\", {} }}  # of the fundamental, "
               "95 %: {}\n",
               measured_text(V_krpm), measured_source(m), bounds_text(V_krpm));
  }
  const Interval mWb = analysis::scaled(r.constants.phase_fundamental, 1e3);
  return pairs + fmt::format("flux_linkage_mWb = {{ value = {}, {} }}  # 95 %: {}\n", measured_text(mWb),
                             measured_source(m), bounds_text(mWb));
}

std::string harmonic_lines(const EmfResult& r) {
  std::string orders, sizes;
  for (const EmfHarmonic& h : r.harmonics) {
    if (!counts(h, r)) continue;
    orders += fmt::format("{}{}", orders.empty() ? "" : ", ", h.order);
    sizes += fmt::format("{}{}", sizes.empty() ? "" : ", ", as_good_as(h.in_phase, h.part));
  }
  return fmt::format("harmonic_orders = [{}]\nharmonic_sizes = [{}]\n", orders, sizes);
}

std::string inline_table(const EmfResult& r) {
  std::string angles, values;
  for (std::size_t n = 0; n < r.angle_deg.size();
       n += 5) {  // every tenth degree, which is enough to type; a file has all values
    angles += fmt::format("{}{:g}", n == 0 ? "" : ", ", r.angle_deg[n]);
    values += fmt::format("{}{:.4f}", n == 0 ? "" : ", ", r.shape[n]);
  }
  return fmt::format("back_emf_angle_deg = [{}]\nback_emf_shape = [{}]\n", angles, values);
}

Json channel_json(const analysis::EmfChannelResult& c) {
  return {{"name", c.name},
          {"fundamental_V", interval_json(c.peak_V)},
          {"behind_deg", interval_json(c.phase_deg)},
          {"offset_V", c.offset_V},
          {"residual_rms_V", c.residual_rms_V},
          {"step_V", c.step_V}};
}

Json constants_json(const EmfResult& r) {
  const analysis::EmfConstants& k = r.constants;
  return {{"line_peak", interval_json(k.line_peak)},
          {"line_rms", interval_json(k.line_rms)},
          {"line_fundamental", interval_json(k.line_fundamental)},
          {"phase_peak", interval_json(k.phase_peak)},
          {"phase_rms", interval_json(k.phase_rms)},
          {"phase_fundamental", interval_json(k.phase_fundamental)}};
}

Json check_json(const analysis::FrameCheck& c) {
  Json out = {{"key", c.key}, {"unit", c.unit}, {"printed", c.printed}, {"holds", c.holds()}};
  out["readings"] = Json::array();
  for (const analysis::FrameReading& r : c.readings)
    out["readings"].push_back({{"frame", r.frame},
                               {"measured", interval_json(r.measured)},
                               {"deviation", r.deviation},
                               {"fits", r.fits},
                               {"as_printed", r.is_printed}});
  return out;
}

}  // namespace

ShapeWords shape_words(const EmfResult& r) {
  ShapeWords words = ShapeWords::sine;
  std::size_t listed = 0;
  for (const EmfHarmonic& h : r.harmonics) {
    if (!counts(h, r)) continue;
    const bool mirrored = h.order % 2 == 1 && h.order <= highest_listed &&
                          std::fabs(h.across) < std::max(h.floor, as_good_as_none / 2.0);
    if (!mirrored || ++listed > most_listed) return ShapeWords::table;
    words = ShapeWords::harmonics;
  }
  return words;
}

std::string emf_motor_lines(const MeasuredEmf& m, const std::string& shape_file) {
  const ShapeWords words = shape_words(m.result);
  if (words == ShapeWords::sine)
    return "back_emf = \"sine\"  # no harmonic of 1 % and more\n" + constant_line(m);
  if (words == ShapeWords::harmonics && shape_file.empty())
    return "back_emf = \"sine\"\n" + harmonic_lines(m.result) + constant_line(m);
  return "back_emf = \"table\"\n" +
         (shape_file.empty() ? inline_table(m.result)
                             : fmt::format("back_emf_file = {}\n", toml_text(shape_file))) +
         constant_line(m);
}

std::string emf_shape_csv(const MeasuredEmf& m) {
  std::string out = "angle_deg,shape\n";
  // The mean of the table must be zero, so that its rounding error is subtracted.
  double mean = 0.0;
  for (const double x : m.result.shape) mean += x / static_cast<double>(m.result.shape.size());
  for (std::size_t n = 0; n < m.result.shape.size(); ++n)
    out += fmt::format("{:g},{:.6f}\n", m.result.angle_deg[n], m.result.shape[n] - mean);
  return out;
}

std::string emf_json(const MeasuredEmf& m) {
  const EmfResult& r = m.result;
  Json out = {{"sixstep", SIXSTEP_VERSION},
              {"recording", m.name},
              {"rows", r.rows},
              {"seconds", r.seconds},
              {"periods", r.periods}};
  out["between"] = r.between == analysis::EmfBetween::lines ? "lines" : "star";
  out["frequency_Hz"] = interval_json(r.frequency_Hz);
  out["change_Hz_s"] = r.change_Hz_s;
  out["pole_pairs"] = r.pole_pairs > 0 ? Json(r.pole_pairs) : Json(nullptr);
  out["turned"] = !r.all_phases ? Json(nullptr) : Json(r.backward ? "backward" : "forward");
  out["channels"] = Json::array();
  for (const analysis::EmfChannelResult& c : r.channels) out["channels"].push_back(channel_json(c));
  out["constants_V_s_per_electrical_rad"] = constants_json(r);
  out["torque_constant_over_phase_peak"] = r.shape_sector_mean;
  out["crest"] = r.crest;
  out["above_95_percent_deg"] = r.flat_deg;
  out["harmonics"] = Json::array();
  for (const EmfHarmonic& h : r.harmonics)
    out["harmonics"].push_back({{"order", h.order},
                                {"part", interval_json(h.part)},
                                {"noise_below", h.floor},
                                {"stands_out", h.stands_out},
                                {"in_phase", h.in_phase},
                                {"across", h.across}});
  out["shape"] = {{"angle_deg", r.angle_deg}, {"value", r.shape}};
  out["sheet"] = nullptr;
  if (!m.sheet.empty()) {
    out["sheet"] = {{"name", m.sheet}, {"tolerance", m.tolerance}, {"checks", Json::array()}};
    for (const analysis::FrameCheck& c : m.checks) out["sheet"]["checks"].push_back(check_json(c));
  }
  return visible(out.dump(2, ' ', false, Json::error_handler_t::replace), Lines::kept) + "\n";
}

}  // namespace text
