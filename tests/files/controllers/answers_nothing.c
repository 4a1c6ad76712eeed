/* SPDX-License-Identifier: Apache-2.0 */
/* A controller file whose function returns no controller. */
#include "sixstep/control/own/own_controller.h"

const sixstep_controller* sixstep_own_controller(void) { return 0; }
