// SPDX-License-Identifier: Apache-2.0
// The fixed-point formats of a drive. Code that is compiled once for each format uses
// SIXSTEP_FIXED_FORMATS(each), where each(Q15) and the others are explicit instantiations. The names of the
// formats in scenario files are in study/scenario/choices.hpp.
#pragma once
#include "sixstep/control/fixed.hpp"

#define SIXSTEP_FIXED_FORMATS(each) each(Q15) each(Q31) each(Q14) each(Q30)
