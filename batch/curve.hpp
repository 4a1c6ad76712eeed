// SPDX-License-Identifier: Apache-2.0
// The torque-speed curve, its points side by side.
#pragma once
#include <functional>

#include "batch/rooms.hpp"
#include "sixstep/analysis/curve/curve.hpp"
#include "sixstep/analysis/for_each.hpp"

namespace batch {

/// The points as `for_each` takes them, on_threads() for one; the curve has the same bits in whatever order.
/// Where `keep_going` says no, the points under way end and there is no curve: a Problem "was interrupted".
base::Result<analysis::Curve> torque_speed_curve(const analysis::CurveRequest& request,
                                                 const analysis::ForEach& for_each,
                                                 const std::function<bool()>& keep_going = {});

}  // namespace batch
