// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/live_rig_parts.hpp"

namespace sixstep::study::detail {

template struct LiveRig<rig::ProductDrive<double>, plant::general::Plant<double>>;
template struct LiveRig<rig::ProductDrive<float>, plant::general::Plant<double>>;
template struct LiveRig<rig::ProductDrive<control::Q15>, plant::general::Plant<double>>;
template struct LiveRig<rig::ProductDrive<control::Q14>, plant::general::Plant<double>>;
template struct LiveRig<rig::ProductDrive<control::Q31>, plant::general::Plant<double>>;
template struct LiveRig<rig::ProductDrive<control::Q30>, plant::general::Plant<double>>;

}  // namespace sixstep::study::detail
