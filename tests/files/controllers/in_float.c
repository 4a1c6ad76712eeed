/* SPDX-License-Identifier: Apache-2.0 */
/* A controller that is compiled in float, as for a chip. */
#ifndef SIXSTEP_REAL
#define SIXSTEP_REAL float
#endif
#include "data/controllers/sine_voltage.c"
