// SPDX-License-Identifier: Apache-2.0
// Selects the scalar of a walk under the exporter's name (-DTARGET_SCALAR_q15 and others).
#pragma once
#include "sixstep/control/fixed.hpp"

#define TARGET_IS_WHOLE 0
#if defined TARGET_SCALAR_q15
#define TARGET_SCALAR sixstep::control::Q15
#define TARGET_SCALAR_NAME "q15"
#elif defined TARGET_SCALAR_q14
#define TARGET_SCALAR sixstep::control::Q14
#define TARGET_SCALAR_NAME "q14"
#elif defined TARGET_SCALAR_q31
#define TARGET_SCALAR sixstep::control::Q31
#define TARGET_SCALAR_NAME "q31"
#elif defined TARGET_SCALAR_q30
#define TARGET_SCALAR sixstep::control::Q30
#define TARGET_SCALAR_NAME "q30"
#elif defined TARGET_SCALAR_float
#define TARGET_SCALAR float
#define TARGET_SCALAR_NAME "float"
#else
#undef TARGET_IS_WHOLE
#define TARGET_IS_WHOLE 1
#define TARGET_SCALAR_NAME "whole"
#endif
