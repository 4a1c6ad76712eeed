// SPDX-License-Identifier: Apache-2.0
#include "batch/curve.hpp"

#include <optional>
#include <vector>

namespace batch {

base::Result<analysis::Curve> torque_speed_curve(const analysis::CurveRequest& asked,
                                                 const analysis::ForEach& for_each,
                                                 const std::function<bool()>& keep_going) {
  analysis::CurveRequest request = asked;
  request.bench.keep_going = keep_going;
  const base::Result<analysis::CurvePlan> plan = analysis::plan_curve(request);
  if (!plan) return plan.problems();
  std::vector<std::optional<base::Result<analysis::OperatingPoint>>> results(plan->speeds_rad_s.size());
  for_each(results.size(), [&](std::size_t n) {
    results[n] = analysis::operating_point(request.bench, plan->speeds_rad_s[n]);
  });
  std::vector<analysis::OperatingPoint> found;
  for (const auto& result : results) {
    if (!*result) return result->problems();
    found.push_back(**result);
  }
  return analysis::curve_of(request, *plan, found, for_each);
}

}  // namespace batch
