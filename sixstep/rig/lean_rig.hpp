// SPDX-License-Identifier: Apache-2.0
// The rig with LeanDrive: only the loops, with ideal measurements.
#pragma once
#include "sixstep/rig/lean_drive.hpp"
#include "sixstep/rig/rig.hpp"

namespace sixstep::rig {

template <class Real, class Scalar = Real>
using LeanRig = Rig<Real, LeanDrive<Scalar>>;

}  // namespace sixstep::rig
