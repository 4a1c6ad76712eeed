// SPDX-License-Identifier: Apache-2.0
#include "tests/control/alone/field_drive.hpp"

template struct firmware::FieldOriented<float>;
