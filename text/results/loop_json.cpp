// SPDX-License-Identifier: Apache-2.0
#include "text/results/loop_json.hpp"
#include "text/escape/json_number.hpp"

#include <cmath>

#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/design/thesis/thesis_figures.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;
using sixstep::base::Motion;
using sixstep::design::DriveDesign;
using sixstep::design::LoopDesign;
using sixstep::design::LoopFigures;

Json figures(const LoopFigures& f) {
  return {{"stable", f.stable},
          {"crossover_rad_s", or_null(f.crossover_rad_s)},
          {"phase_margin_rad", or_null(f.phase_rad)},
          {"gain_margin", or_null(f.gain)},
          {"delay_margin_s", or_null(f.delay_s)},
          {"bandwidth_rad_s", or_null(f.bandwidth_rad_s)},
          {"sensitivity_peak", f.sensitivity_peak},
          {"sensitivity_peak_rad_s", f.sensitivity_peak_rad_s}};
}

Json bode(const LoopDesign& loop, double period_s) {
  Json out{{"w_rad_s", Json::array()},
           {"gain", Json::array()},
           {"phase_rad", Json::array()},
           {"closed_gain", Json::array()}};
  const double from = loop.figures.crossover_rad_s.value_or(0.1 / period_s) / 100;
  for (const auto& p : sixstep::design::bode(loop.loop, period_s, from, 200)) {
    out["w_rad_s"].push_back(p.w_rad_s);
    out["gain"].push_back(p.gain);
    out["phase_rad"].push_back(p.phase_rad);
    out["closed_gain"].push_back(p.closed_gain);
  }
  return out;
}

/// The step response with at most some 500 samples, each at the end of a whole number of periods.
Json step(const LoopDesign& loop, double period_s) {
  Json out{{"t_s", Json::array()}, {"value", Json::array()}};
  const auto& samples = loop.step.samples;
  const std::size_t every = samples.size() / 500 + 1;
  for (std::size_t n = 0; n < samples.size(); n += every) {
    out["t_s"].push_back(static_cast<double>(n) * period_s);
    out["value"].push_back(samples[n]);
  }
  out["settling_s"] = figure_json(loop.step.settling_s);
  out["overshoot"] = finite(loop.step.overshoot);
  return out;
}

}  // namespace

Json steps_json(const std::vector<sixstep::design::DerivationStep>& steps) {
  Json out = Json::array();
  for (const auto& s : steps)
    out.push_back({{"symbol", s.symbol}, {"formula", s.formula}, {"value", s.value}, {"unit", s.unit}});
  return out;
}

Json loop_json(const LoopDesign& loop, const DriveDesign& d) {
  Json out{{"name", loop.name}, {"method", loop.method}};
  const Motion motion = sixstep::design::motion_of(d.motor);
  if (loop.name == "position")
    out[motion.linear ? "gain_m_s_per_mm" : "gain_rad_s_per_deg"] =
        loop.gains.d1 * motion.unit("rad/s/deg").factor;
  else
    out["gains"] = {{"d1", loop.gains.d1}, {"d0", loop.gains.d0}, {"K_i", loop.gains.d1 + loop.gains.d0}};
  out["steps"] = Json::array();
  for (const auto& s : loop.steps) {
    Json row{{"symbol", s.symbol}, {"formula", s.formula}, {"value", s.value}, {"unit", s.unit}};
    if (loop.placed)
      if (const auto printed = sixstep::design::thesis_figure(loop.name, *loop.placed, s.symbol))
        row["thesis"] = *printed;
    out["steps"].push_back(row);
  }
  out["open_loop_in_z_minus_1"] = {{"num", loop.loop.num}, {"den", loop.loop.den}};
  const bool half = d.spec.sampled_in_middle;
  out["margins"] = {{half ? "half_a_period_late" : "at_once", figures(d.sooner(loop))},
                    {half ? "one_and_a_half_periods_late" : "one_period_late", figures(d.later(loop))}};
  out["bode"] = bode(loop, d.spec.period_s);
  out["step"] = step(loop, d.spec.period_s);
  return out;
}

}  // namespace text
