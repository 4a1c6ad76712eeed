// SPDX-License-Identifier: Apache-2.0
// The field-oriented drive in fixed point. This file is compiled without floating-point registers if the
// compiler has such an option.
#include "tests/control/alone/field_drive.hpp"

namespace firmware {

template struct FieldOriented<Q15>;
template struct FieldOriented<Fixed<std::int16_t, 12>>;
template struct FieldOriented<Q31>;
template struct FieldOriented<Fixed<std::int32_t, 24>>;

}  // namespace firmware
