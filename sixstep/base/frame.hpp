// SPDX-License-Identifier: Apache-2.0
// Frames are types with their own member names, so that a phase quantity cannot be used as an axis quantity.
#pragma once

namespace sixstep::base {

/// Phase quantities of a three-phase machine; currents are positive into the motor.
template <class Real>
struct Abc {
  Real a{}, b{}, c{};
  bool operator==(const Abc&) const = default;
};

}  // namespace sixstep::base
