// SPDX-License-Identifier: Apache-2.0
#include "tests/control/alone/sensorless_drive.hpp"

template struct firmware::Sensorless<float>;
