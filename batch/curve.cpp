// SPDX-License-Identifier: Apache-2.0
#include "batch/curve.hpp"

#include <optional>
#include <vector>

namespace batch {

base::Result<study::Curve> torque_speed_curve(const study::CurveRequest& asked,
                                              const study::ForEach& for_each,
                                              const std::function<bool()>& keep_going) {
  study::CurveRequest request = asked;
  request.bench.keep_going = keep_going;
  const base::Result<study::CurvePlan> plan = study::plan_curve(request);
  if (!plan) return plan.problems();
  std::vector<std::optional<base::Result<study::OperatingPoint>>> results(plan->speeds_rad_s.size());
  for_each(results.size(),
           [&](std::size_t n) { results[n] = study::operating_point(request.bench, plan->speeds_rad_s[n]); });
  std::vector<study::OperatingPoint> found;
  for (const auto& result : results) {
    if (!*result) return result->problems();
    found.push_back(**result);
  }
  return study::curve_of(request, *plan, found, for_each);
}

}  // namespace batch
