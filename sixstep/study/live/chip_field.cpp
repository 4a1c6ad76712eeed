// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/chip_behind.hpp"

namespace sixstep::study::detail {

/// check() has refused the fixed-point formats.
LegChip field_chip(const Scenario& s, const Compiled& c) {
  if (s.control.arithmetic == Arithmetic::float32) return behind<rig::FieldDrive<float>>(s, c);
  return behind<rig::FieldDrive<double>>(s, c);
}

}  // namespace sixstep::study::detail
