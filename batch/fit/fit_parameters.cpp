// SPDX-License-Identifier: Apache-2.0
#include "batch/fit/fit_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"
#include "sixstep/study/scenario/spread.hpp"

namespace batch {

namespace {

constexpr std::string_view motor_table = "motor_override.";
constexpr std::string_view inertia_key = "motor_override.inertia_gcm2";

struct ProbeWord {
  std::string_view word;
  FitRole role;
  std::string_view unit;  ///< empty: the unit of the column
};
constexpr ProbeWord probe_words[] = {{"shift_s", FitRole::shift, "s"},
                                     {"drift", FitRole::drift, "1"},
                                     {"offset", FitRole::offset, ""},
                                     {"gain", FitRole::gain, "1"},
                                     {"delay_s", FitRole::delay, "s"}};

bool of_a_column(FitRole role) {
  return role == FitRole::offset || role == FitRole::gain || role == FitRole::delay;
}

double span_of(const std::vector<double>& values) {
  double low = INFINITY, high = -INFINITY;
  for (const double x : values)
    if (x - x == 0.0) low = std::min(low, x), high = std::max(high, x);
  return high > low ? high - low : 1.0;
}

FitParameter of_probe(const ProbeWord& word, const FitRequest& request, std::size_t bench,
                      std::size_t column) {
  const FitBench& b = request.benches[bench];
  FitParameter p{.role = word.role,
                 .key = std::string(word.word),
                 .unit = std::string(word.unit),
                 .bench = bench,
                 .column = column};
  const double period_s = b.scenario.pwm.period_s;
  if (of_a_column(word.role)) p.key += "." + b.log.columns[column].name;
  switch (word.role) {
    case FitRole::shift:
      p.start = b.shift_s;
      p.scale = 20.0 * period_s;
      break;
    case FitRole::drift:
      p.scale = 1e-2;
      break;
    case FitRole::delay:
      p.scale = period_s;
      break;
    case FitRole::gain:
      p.start = 1.0;
      p.logarithmic = true;
      break;
    default:
      p.unit = b.log.columns[column].unit;
      p.scale = span_of(b.log.values[column]);
  }
  return p;
}

/// Adds the parameters of a probe's word: one for each bench, or for each column that the word means.
bool add_probes(std::string_view free, const FitRequest& request, std::vector<FitParameter>& out) {
  const std::size_t dot = free.find('.');
  const std::string_view word = free.substr(0, dot), name = dot == free.npos ? "" : free.substr(dot + 1);
  const auto* const found = std::find_if(std::begin(probe_words), std::end(probe_words),
                                         [&](const ProbeWord& p) { return p.word == word; });
  if (found == std::end(probe_words) || (!of_a_column(found->role) && !name.empty())) return false;
  const std::size_t before = out.size();
  for (std::size_t bench = 0; bench < request.benches.size(); ++bench) {
    const std::vector<study::Column>& columns = request.benches[bench].log.columns;
    if (!of_a_column(found->role))
      out.push_back(of_probe(*found, request, bench, 0));
    else
      for (std::size_t c = 1; c < columns.size(); ++c)
        if (name.empty() || columns[c].name == name) out.push_back(of_probe(*found, request, bench, c));
  }
  return out.size() > before;
}

bool is_friction(std::string_view key) {
  return key.find("friction") != key.npos || key.find("iron_") != key.npos;
}

base::Result<FitParameter> of_key(const std::string& key, const FitRequest& request) {
  const study::Scenario& s = request.benches[0].scenario;
  const std::optional<study::VaryingNumber> number = study::varying_number(s, key);
  if (!number)
    return base::Problem{
        "free", "\"" + key + "\"", "is no number of the motor, the bench or a probe that can be fitted",
        "write a key that differs from drive to drive (motor_override.inertia_gcm2, supply.voltage_V), or "
        "shift_s, drift, offset, gain, delay_s"};
  FitParameter p{.role = FitRole::key, .key = key, .unit = number->unit, .start = number->value};
  p.positive = is_friction(key);
  p.logarithmic = key.starts_with(motor_table) && !p.positive && p.start > 0;
  p.scale = std::fabs(p.start) > 0 ? std::fabs(p.start) : 1.0;
  return p;
}

/// A friction of 0 has no scale. The scale is a tenth of the torque of the sheet's nominal current, or of 1 A.
void scale_frictions(const FitRequest& request, std::vector<FitParameter>& parameters) {
  const study::Scenario& s = request.benches[0].scenario;
  const auto motor = design::motor_model(s.sheet);
  if (!motor) return;
  const double torque =
      0.1 * motor->K_t_Nm_A * (motor->nominal_current_A > 0 ? motor->nominal_current_A : 1.0);
  const double speed = s.supply.voltage_V / motor->K_t_Nm_A;
  for (FitParameter& p : parameters) {
    if (!p.positive || p.start > 0) continue;
    p.scale = p.key.ends_with("_mNm") ? 1e3 * torque : torque / speed;
  }
}

}  // namespace

double FitParameter::value(double u) const {
  const double x = logarithmic ? start * std::exp(u) : start + scale * u;
  return positive ? std::max(x, 0.0) : x;
}

study::Scenario with_both_frictions(study::Scenario scenario) {
  design::Sheet& sheet = scenario.sheet;
  sheet = design::in_standard_keys(std::move(sheet));
  if (!sheet.coulomb_friction_mNm) sheet.coulomb_friction_mNm.emplace();
  if (!sheet.viscous_friction_Nm_s) sheet.viscous_friction_Nm_s.emplace();
  return scenario;
}

std::vector<std::string> usual_free(const study::Scenario& scenario) {
  std::vector<std::string> out;
  for (const char* const key :
       {"resistance_ohm", "inductance_mH", "d_axis_inductance_mH", "q_axis_inductance_mH",
        "torque_constant_mNm_A", "inertia_gcm2", "viscous_friction_Nm_s", "coulomb_friction_mNm"})
    if (const std::string path = std::string(motor_table) + key; study::varying_number(scenario, path))
      out.push_back(path);
  out.emplace_back("offset");
  return out;
}

base::Result<std::vector<FitParameter>> fit_parameters(const FitRequest& request) {
  std::vector<FitParameter> out;
  for (const std::string& free :
       request.free.empty() ? usual_free(request.benches[0].scenario) : request.free) {
    if (add_probes(free, request, out)) continue;
    base::Result<FitParameter> key = of_key(free, request);
    if (!key) return key.problems();
    out.push_back(std::move(*key));
  }
  scale_frictions(request, out);
  return out;
}

bool is_inertia(const FitParameter& parameter) { return parameter.key == inertia_key; }

double inertia_factor(std::span<const FitParameter> parameters, std::span<const double> u) {
  for (std::size_t k = 0; k < parameters.size(); ++k)
    if (is_inertia(parameters[k])) return parameters[k].value(u[k]) / parameters[k].start;
  return 1.0;
}

base::Result<study::Scenario> bench_with(const study::Scenario& scenario,
                                         std::span<const FitParameter> parameters,
                                         std::span<const double> u) {
  study::Scenario s = scenario;
  const double inertia = inertia_factor(parameters, u);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const FitParameter& p = parameters[k];
    if (p.role != FitRole::key) continue;
    const double x = p.of_inertia ? p.value(u[k]) * inertia : p.value(u[k]);
    base::Result<study::Scenario> next = study::strayed_to(s, p.key, x);
    if (!next) return next.problems();
    s = std::move(*next);
  }
  return s;
}

}  // namespace batch
