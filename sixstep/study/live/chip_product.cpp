// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/chip_behind.hpp"

namespace sixstep::study::detail {

PairChip product_chip(const Scenario& s, const Compiled& c) {
  return in_each_arithmetic<rig::ProductDrive>(s, c);
}

}  // namespace sixstep::study::detail
