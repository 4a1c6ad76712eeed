// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/live_rig_parts.hpp"

namespace sixstep::study::detail {

template struct LiveRig<rig::SensedDrive<double>>;
template struct LiveRig<rig::SensedDrive<float>>;
template struct LiveRig<rig::SensedDrive<control::Q15>>;
template struct LiveRig<rig::SensedDrive<control::Q14>>;
template struct LiveRig<rig::SensedDrive<control::Q31>>;
template struct LiveRig<rig::SensedDrive<control::Q30>>;

}  // namespace sixstep::study::detail
