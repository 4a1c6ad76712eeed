// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/live_rig_parts.hpp"

namespace sixstep::study::detail {

template struct LiveRig<rig::SensorlessDrive<double>, plant::general::Plant<double>>;
template struct LiveRig<rig::SensorlessDrive<float>, plant::general::Plant<double>>;
template struct LiveRig<rig::SensorlessDrive<control::Q15>, plant::general::Plant<double>>;
template struct LiveRig<rig::SensorlessDrive<control::Q14>, plant::general::Plant<double>>;
template struct LiveRig<rig::SensorlessDrive<control::Q31>, plant::general::Plant<double>>;
template struct LiveRig<rig::SensorlessDrive<control::Q30>, plant::general::Plant<double>>;

}  // namespace sixstep::study::detail
