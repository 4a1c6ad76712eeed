// SPDX-License-Identifier: Apache-2.0
// Only the decoders, compiled for a chip in fixed point. This file is compiled without floating-point
// registers if the compiler has such an option.
#include "tests/control/alone/decoders.hpp"

namespace firmware {

template struct Decoders<Q15>;
template struct Decoders<Q31>;

BinaryAngle lines(const QuadratureConfig& config, QuadratureState& state, bool a, bool b, bool z);
HallEdges learnt(const HallCalibrationConfig& config, HallCalibrationState& state, std::uint8_t edge,
                 std::int8_t direction, std::uint32_t time);

BinaryAngle lines(const QuadratureConfig& config, QuadratureState& state, bool a, bool b, bool z) {
  quadrature_step(config, state, a, b, z);
  return quadrature_angle(config, state);
}

HallEdges learnt(const HallCalibrationConfig& config, HallCalibrationState& state, std::uint8_t edge,
                 std::int8_t direction, std::uint32_t time) {
  hall_calibrate(config, state, edge, direction, time);
  return hall_edges(hall_deviations(state), 0, 0);
}

}  // namespace firmware
