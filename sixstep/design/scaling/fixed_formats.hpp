// SPDX-License-Identifier: Apache-2.0
// The fixed-point formats that a drive is offered in: what is compiled once for each of them says so by SIXSTEP_FIXED_FORMATS(each),
// where each(Q15) and its like are explicit instantiations. The keys' words for them: study/scenario/choices.hpp.
#pragma once
#include "sixstep/control/fixed.hpp"

#define SIXSTEP_FIXED_FORMATS(each) each(Q15) each(Q31) each(Q14) each(Q30)
