// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/live_rig_parts.hpp"

namespace sixstep::study::detail {

template struct LiveRig<rig::LeanDrive<double>>;
template struct LiveRig<rig::LeanDrive<float>>;
template struct LiveRig<rig::LeanDrive<control::Q15>>;
template struct LiveRig<rig::LeanDrive<control::Q14>>;
template struct LiveRig<rig::LeanDrive<control::Q31>>;
template struct LiveRig<rig::LeanDrive<control::Q30>>;

}  // namespace sixstep::study::detail
