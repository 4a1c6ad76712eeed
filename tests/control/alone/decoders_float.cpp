// SPDX-License-Identifier: Apache-2.0
// Only the decoders, for a chip, in single precision.
#include "tests/control/alone/decoders.hpp"

template struct firmware::Decoders<float>;
