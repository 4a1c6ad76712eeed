// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/live_rig_parts.hpp"

namespace sixstep::study::detail {

template struct LiveRig<rig::ChipDrive>;
template struct LiveRig<rig::ChipDrive, plant::general::Plant<double>>;

}  // namespace sixstep::study::detail
