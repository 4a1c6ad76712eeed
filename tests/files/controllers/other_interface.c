/* SPDX-License-Identifier: Apache-2.0 */
/* A controller compiled with another interface version. */
#include "sixstep/control/own/own_controller.h"

const sixstep_controller* sixstep_own_controller(void) {
  static sixstep_controller own;
  own.interface = SIXSTEP_OWN_INTERFACE + 1;
  return &own;
}
