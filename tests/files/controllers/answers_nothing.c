/* SPDX-License-Identifier: Apache-2.0 */
/* One that has no controller to show. */
#include "sixstep/control/own/own_controller.h"

const sixstep_controller* sixstep_own_controller(void) { return 0; }
