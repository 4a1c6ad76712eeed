// SPDX-License-Identifier: Apache-2.0
// This file compiles alone for a chip: freestanding, without exceptions and RTTI.
#include "sixstep/control/retune.hpp"
