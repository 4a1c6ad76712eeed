// SPDX-License-Identifier: Apache-2.0
// The torque-speed curve, its points side by side.
#pragma once
#include <functional>

#include "batch/rooms.hpp"
#include "sixstep/study/curve.hpp"

namespace batch {

/// On up to `jobs` threads (0: one per core); the curve has the same bits however many there are. Where
/// `keep_going` says no, the points not begun are left out and there is no curve: a Problem "interrupted".
base::Result<study::Curve> torque_speed_curve(const study::CurveRequest& request, unsigned jobs,
                                              const std::function<bool()>& keep_going = {});

}  // namespace batch
