// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/live_rig_parts.hpp"

namespace sixstep::study::detail {

template struct LiveRig<rig::ProductDrive<double>>;
template struct LiveRig<rig::ProductDrive<float>>;
template struct LiveRig<rig::ProductDrive<control::Q15>>;
template struct LiveRig<rig::ProductDrive<control::Q14>>;
template struct LiveRig<rig::ProductDrive<control::Q31>>;
template struct LiveRig<rig::ProductDrive<control::Q30>>;

}  // namespace sixstep::study::detail
