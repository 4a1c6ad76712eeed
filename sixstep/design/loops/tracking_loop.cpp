// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/tracking_loop.hpp"

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::design {
namespace {

base::Problems mistakes(const TrackingSpec& spec) {
  base::Problems problems;
  const auto above_0 = [&](const char* where, double value, const char* cure) {
    if (!(value > 0 && value - value == 0))
      problems.push_back({where, base::written(value), "must be above 0 and finite", cure});
  };
  above_0("bandwidth_rad_s", spec.bandwidth_rad_s, "give the bandwidth of the angle's tracking loop");
  above_0("damping", spec.damping, "give the damping; with 1 the loop does not overshoot");
  above_0("period_s", spec.period_s, "give the time between two samples");
  if (problems.empty() && spec.bandwidth_rad_s * spec.period_s >= base::pi)
    problems.push_back(
        {"bandwidth_rad_s", base::written(spec.bandwidth_rad_s),
         "must be below half the sampling frequency, " + base::written(base::pi / spec.period_s),
         "lower this value, or sample more often"});
  return problems;
}

}  // namespace

base::Result<TrackingDesign> tracking_loop(const TrackingSpec& spec) {
  base::Problems problems = mistakes(spec);
  if (!problems.empty()) return problems;
  const double T = spec.period_s, D = spec.damping, a = 1 + 2 * D * D;
  TrackingDesign design;
  design.natural_rad_s = spec.bandwidth_rad_s / std::sqrt(a + std::sqrt(a * a + 1));
  const double x = design.natural_rad_s * T, shrunk = base::exp(-D * x);
  const double turned = x * std::sqrt(std::fabs(1 - D * D));
  const double half_sum =
      D <= 1 ? shrunk * base::cos(turned) : (base::exp(turned - D * x) + base::exp(-turned - D * x)) / 2;
  design.K_p = 1 - shrunk * shrunk;
  design.K_i = 2 - design.K_p - 2 * half_sum;
  design.K_a_per_s2 = design.K_i / (T * T);
  design.speed_rad_s_unit = 2 * base::pi / 4294967296.0 / T;
  return design;
}

double taken_over_limit(double damping) { return 2 * (std::sqrt(1 + damping * damping) - damping); }

control::TrackingConfig tracking_config(const TrackingDesign& design) {
  return {control::FixedGain<std::int32_t>(design.K_p), control::FixedGain<std::int32_t>(design.K_i)};
}

}  // namespace sixstep::design
