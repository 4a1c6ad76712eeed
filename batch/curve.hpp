// SPDX-License-Identifier: Apache-2.0
// Computes the points of a torque-speed curve in parallel.
#pragma once
#include <functional>

#include "batch/rooms.hpp"
#include "sixstep/analysis/curve/curve.hpp"
#include "sixstep/analysis/for_each.hpp"

namespace batch {

/// Computes the curve. `for_each` distributes the points, for example on_threads(); the curve has the same
/// bits in any order. If `keep_going` returns false, the computation of points in progress ends, and the
/// result is a Problem "was interrupted".
base::Result<analysis::Curve> torque_speed_curve(const analysis::CurveRequest& request,
                                                 const analysis::ForEach& for_each,
                                                 const std::function<bool()>& keep_going = {});

}  // namespace batch
