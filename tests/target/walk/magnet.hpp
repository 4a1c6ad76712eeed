// SPDX-License-Identifier: Apache-2.0
// Walks of the field-oriented drive's blocks without a scalar.
#pragma once
#include "sixstep/control/field/field_direction.hpp"
#include "tests/target/walk/counted.hpp"
#include "tests/target/walk/digest.hpp"
#include "tests/target/walk/draw.hpp"

namespace target {

struct MagnetAngleWalk {
  void draw(Random&) {}
  void step(Random& r, Digest& mix) {
    const BinaryAngle electrical = r.long_bits();
    const BinaryAngle magnet = counted<0>("magnet_angle", [&] { return magnet_angle(electrical); });
    mix(magnet);
    saw("beyond half a turn", magnet > half_turn);
  }
};

}  // namespace target
