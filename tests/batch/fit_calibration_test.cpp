// SPDX-License-Identifier: Apache-2.0
// Reliability of fit() over random motors and recordings. The 95 % bounds contain the true value in 93 to 97
// of 100 cases. Their median width is at most 1.5 times the least possible width (Cramer and Rao).
#include <algorithm>
#include <cstdio>
#include <map>

#include "batch/fit/fit_model.hpp"
#include "sixstep/analysis/identification/symmetric.hpp"
#include "tests/analysis/identification/counted.hpp"
#include "tests/batch/drawn_bench.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::Fit;
using batch::FitBench;
using batch::FitRequest;
using study::ColumnId;

struct DrawnFit {
  BenchMotor truth;
  FitRequest request;
  std::map<std::string, double> probes;  ///< true values of the probes' parameters
  std::vector<std::pair<double, double>>
      noise{};  ///< for each column of all benches: deviation and quantisation step
};

double true_value(const DrawnFit& drawn, const std::string& key, const std::string& bench) {
  const BenchMotor& m = drawn.truth;
  const std::map<std::string, double> motor = {{"motor_override.resistance_ohm", m.R_ohm},
                                               {"motor_override.inductance_mH", m.L_mH},
                                               {"motor_override.torque_constant_mNm_A", m.K_mNm_A},
                                               {"motor_override.inertia_gcm2", m.J_gcm2},
                                               {"motor_override.viscous_friction_Nm_s", m.viscous_Nm_s},
                                               {"motor_override.coulomb_friction_mNm", m.coulomb_mNm}};
  const auto found = motor.find(key);
  return found != motor.end() ? found->second : drawn.probes.at(key + " of " + bench);
}

/// A random instrument for a column of this size. Its noise is 0.2 to 2 %, it has an offset, and often a
/// converter of 6 to 10 bits.
Instrument drawn_instrument(Draw& draw, double size) {
  Instrument by{.noise = draw.decades(2e-3, 2e-2) * size, .offset = draw.between(-0.05, 0.05) * size};
  if (draw.chance(0.6)) by.step = size * std::pow(2.0, -draw.between(6.0, 10.0));
  return by;
}

void add_bench(DrawnFit& drawn, Bench kind, const BenchMotor& sheet, Draw& draw) {
  FitBench bench{
      "bench " + std::to_string(drawn.request.benches.size()), bench_scenario(kind, drawn.truth), {}, 0.0};
  const BenchMotor& m = drawn.truth;
  const double stall_A = 24.0 / m.R_ohm, free_rad_s = m.no_load_rad_s(24.0);
  std::vector<ColumnId> columns;
  std::vector<Instrument> by;
  double interval_s = bench.scenario.duration_s / 400;
  if (kind == Bench::locked_pulse || kind == Bench::run_up)
    columns.push_back(ColumnId::i_a), by.push_back(drawn_instrument(draw, 0.3 * stall_A));
  if (kind == Bench::run_up || kind == Bench::coast_down)
    columns.push_back(ColumnId::speed), by.push_back(drawn_instrument(draw, 0.5 * free_rad_s));
  if (kind == Bench::turned)
    columns.push_back(ColumnId::u_ab), by.push_back(drawn_instrument(draw, 0.4 * 24.0));
  by[0].dropped = draw.chance(0.3) ? 0.2 : 0.0;
  if (kind == Bench::turned) by[0].drift = draw.between(-5e-3, 5e-3);
  bench.log = recorded(bench.scenario, columns, interval_s, by, draw);
  bench.scenario = bench_scenario(kind, m);
  bench.scenario.sheet = sheet_of(sheet);
  for (std::size_t c = 0; c < by.size(); ++c) {
    drawn.noise.emplace_back(by[c].noise, by[c].step);
    drawn.probes["offset." + bench.log.columns[c + 1].name + " of " + bench.name] = by[c].offset;
  }
  drawn.probes["drift of " + bench.name] = by[0].drift;
  drawn.request.benches.push_back(std::move(bench));
}

DrawnFit drawn_fit(std::uint64_t seed) {
  Draw draw(seed);
  DrawnFit drawn{drawn_motor(draw), {}, {}};
  const BenchMotor sheet = printed(drawn.truth, draw, 0.3);
  switch (draw.one_of(4)) {
    case 0:
      add_bench(drawn, Bench::locked_pulse, sheet, draw);
      break;
    case 1:  // with a locked rotor, so that no value hangs on one that the recordings do not determine
      add_bench(drawn, Bench::locked_pulse, sheet, draw);
      add_bench(drawn, Bench::turned, sheet, draw);
      drawn.request.free = batch::usual_free(drawn.request.benches[0].scenario);
      drawn.request.free.push_back("drift");
      break;
    case 2:
      add_bench(drawn, Bench::coast_down, sheet, draw);
      break;
    default:
      add_bench(drawn, Bench::turned, sheet, draw);
      drawn.request.free = {"motor_override.torque_constant_mNm_A", "offset", "drift"};
  }
  return drawn;
}

/// Least possible standard deviations at the fitted values (Cramer and Rao). The noise of each column is the
/// true noise; the start values are uncertain by the factor e.
std::map<std::string, double> least_deviations(const DrawnFit& drawn, const Fit& fit) {
  const auto parameters = batch::fit_parameters(drawn.request);
  std::vector<double> u(parameters->size());
  std::vector<std::size_t> free;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const batch::FitParameter& p = (*parameters)[k];
    const auto found = std::find_if(fit.values.begin(), fit.values.end(), [&](const auto& v) {
      return v.key == p.key && (v.bench.empty() || v.bench == drawn.request.benches[p.bench].name);
    });
    if (found != fit.values.end() && found->at_zero) continue;
    free.push_back(k);
    if (found == fit.values.end()) continue;
    u[k] = p.logarithmic ? std::log(found->value.value / p.start) : (found->value.value - p.start) / p.scale;
  }
  analysis::NormalEquations equations(free.size());
  std::size_t column = 0;
  for (std::size_t n = 0; n < drawn.request.benches.size(); ++n) {
    const auto model = batch::FitModel::of(drawn.request.benches[n], n);
    std::vector<std::vector<double>> derivatives;
    for (const std::size_t k : free) {
      constexpr double step = 3e-4;
      std::vector<double> above = u, below = u;
      above[k] += step, below[k] -= step;
      std::vector<double> high = *model->values(*parameters, above);
      const std::vector<double> low = *model->values(*parameters, below);
      for (std::size_t c = 0; c < high.size(); ++c) high[c] = (high[c] - low[c]) / (2 * step);
      derivatives.push_back(std::move(high));
    }
    for (std::size_t c = 0; c < model->cells().size(); ++c) {
      const auto [noise, step] = drawn.noise[column + model->cells()[c].column - 1];
      std::vector<double> row;
      for (const std::vector<double>& d : derivatives) row.push_back(d[c]);
      equations.add(row, 0.0, 1.0 / (noise * noise + step * step / 12));
    }
    column += drawn.request.benches[n].log.columns.size() - 1;
  }
  for (std::size_t k = 0; k < free.size(); ++k) {
    std::vector<double> of_start(free.size());
    of_start[k] = 1.0;
    equations.add(of_start, 0.0);
  }
  const auto solution = analysis::solution_of(equations);
  std::map<std::string, double> out;
  for (std::size_t k = 0; solution && k < free.size(); ++k) {
    const batch::FitParameter& p = (*parameters)[free[k]];
    out[p.key] =
        (p.value(u[free[k]] + 1e-6) - p.value(u[free[k]])) / 1e-6 * std::sqrt(solution->cofactors.at(k, k));
  }
  return out;
}

TEST(FitCalibration, BoundsHoldTheTruthAndAreAsNarrowAsTheNoiseAllows) {
  const int count = drawn_count(50);
  HeldOften held("bounds of fitted values");
  std::map<std::string, HeldOften> of_key;
  std::vector<double> ratios;
  std::size_t simulations = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const DrawnFit drawn = drawn_fit(static_cast<std::uint64_t>(seed));
    const auto found = batch::fit(drawn.request);
    ASSERT_TRUE(found) << "seed " << seed << ": " << to_string(found.problems()[0]);
    simulations += found->simulations;
    const std::map<std::string, double> least = least_deviations(drawn, *found);
    for (const analysis::FittedValue& v : found->values) {
      if (!v.given.empty()) continue;  // it holds for a kept value, which is not the true one
      held.count(v.value.holds(true_value(drawn, v.key, v.bench)), static_cast<std::uint64_t>(seed));
      of_key.try_emplace(v.key, HeldOften(v.key))
          .first->second.count(v.value.holds(true_value(drawn, v.key, v.bench)),
                               static_cast<std::uint64_t>(seed));
      if (const auto at = least.find(v.key + v.bench); at != least.end())
        ratios.push_back(v.value.half_width() / (1.96 * at->second));
    }
  }
  std::sort(ratios.begin(), ratios.end());
  const double median = ratios[ratios.size() / 2];
  std::printf(
      "median half width %.3f of the least possible one, tenth %.3f, ninetieth %.3f; %zu simulations\n",
      median, ratios[ratios.size() / 10], ratios[ratios.size() * 9 / 10], simulations);
  for (const auto& [key, one] : of_key) std::printf("  %-45s %.1f %%\n", key.c_str(), 100 * one.part());
  held.expect_95();
  EXPECT_LT(median, 1.5);
  EXPECT_GT(median, 0.8);
}

}  // namespace SIXSTEP_TEST_FILE
