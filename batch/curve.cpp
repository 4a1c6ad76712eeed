// SPDX-License-Identifier: Apache-2.0
#include "batch/curve.hpp"

#include <atomic>
#include <optional>
#include <vector>

namespace batch {

base::Result<study::Curve> torque_speed_curve(const study::CurveRequest& request,
                                              const study::ForEach& for_each,
                                              const std::function<bool()>& keep_going) {
  const base::Result<study::CurvePlan> plan = study::plan_curve(request);
  if (!plan) return plan.problems();
  std::vector<std::optional<base::Result<study::OperatingPoint>>> results(plan->speeds_rad_s.size());
  std::atomic<bool> ended = false;
  const study::ForEach each_until_ended = [&](std::size_t count,
                                              const std::function<void(std::size_t)>& work) {
    for_each(count, [&](std::size_t n) {
      if (!ended && keep_going && !keep_going()) ended = true;
      if (!ended) work(n);
    });
  };
  const base::Problem interrupted{.where = "curve", .limit = "was interrupted", .cure = "start it again"};
  each_until_ended(results.size(), [&](std::size_t n) {
    results[n] = study::operating_point(request.bench, plan->speeds_rad_s[n]);
  });
  if (ended) return interrupted;
  std::vector<study::OperatingPoint> found;
  for (const auto& result : results) {
    if (!*result) return result->problems();
    found.push_back(**result);
  }
  base::Result<study::Curve> curve = study::curve_of(request, *plan, found, each_until_ended);
  if (ended) return interrupted;
  return curve;
}

}  // namespace batch
