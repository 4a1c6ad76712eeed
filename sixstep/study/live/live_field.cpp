// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/live_rig_parts.hpp"

namespace sixstep::study::detail {

template struct LiveRig<rig::FieldDrive<double>>;
template struct LiveRig<rig::FieldDrive<float>>;

}  // namespace sixstep::study::detail
