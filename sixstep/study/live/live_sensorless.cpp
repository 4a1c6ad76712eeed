// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/live_rig_parts.hpp"

namespace sixstep::study::detail {

template struct LiveRig<rig::SensorlessDrive<double>>;
template struct LiveRig<rig::SensorlessDrive<float>>;
template struct LiveRig<rig::SensorlessDrive<control::Q15>>;
template struct LiveRig<rig::SensorlessDrive<control::Q14>>;
template struct LiveRig<rig::SensorlessDrive<control::Q31>>;
template struct LiveRig<rig::SensorlessDrive<control::Q30>>;

}  // namespace sixstep::study::detail
