// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/chip_behind.hpp"

namespace sixstep::study::detail {

PairChip sensed_chip(const Scenario& s, const Compiled& c) {
  return in_each_arithmetic<rig::SensedDrive>(s, c);
}

}  // namespace sixstep::study::detail
