// SPDX-License-Identifier: Apache-2.0
// The sensorless drive in fixed point. This file is compiled without floating-point registers if the compiler
// has such an option.
#include "tests/control/alone/sensorless_drive.hpp"

namespace firmware {

template struct Sensorless<Q15>;
template struct Sensorless<Fixed<std::int16_t, 12>>;
template struct Sensorless<Q31>;
template struct Sensorless<Fixed<std::int32_t, 24>>;

}  // namespace firmware
