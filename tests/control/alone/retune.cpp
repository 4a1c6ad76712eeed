// SPDX-License-Identifier: Apache-2.0
// This file is compiled separately for a chip: freestanding, without exceptions and RTTI.
#include "sixstep/control/retune.hpp"
