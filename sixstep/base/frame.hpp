// SPDX-License-Identifier: Apache-2.0
// Frames are types with their own member names: the compiler rejects a phase quantity where an axis quantity
// is needed.
#pragma once

namespace sixstep::base {

/// Phase quantities of a three-phase machine; currents are positive into the motor.
template <class Real>
struct Abc {
  Real a{}, b{}, c{};
  bool operator==(const Abc&) const = default;
};

}  // namespace sixstep::base
