/* SPDX-License-Identifier: Apache-2.0 */
/* A proportional current controller of the driven pair, without a Hall interrupt. It runs as a scenario's controller
   and in a calling program. */
#include "sixstep/control/own/own_controller.h"

static const char* design(const sixstep_given* given, const sixstep_real* values, void* config) {
  (void)given, (void)values, (void)config;
  return 0;
}

static void step(const void* config, void* state, const sixstep_measured* seen, sixstep_real setpoint, sixstep_answer* answer) {
  static const uint8_t source[8] = {0, 2, 1, 1, 0, 2, 0, 0}, sink[8] = {0, 0, 2, 0, 1, 1, 2, 0}; /* index: code H1 H2
                                                                                                    H3 */
  const uint8_t code = seen->hall & 7;
  const sixstep_real current = (seen->current_A[source[code]] - seen->current_A[sink[code]]) / 2;
  sixstep_real duty = (sixstep_real)0.15 + (sixstep_real)0.1 * (setpoint - current);
  (void)config, (void)state;
  answer->enabled = source[code] != sink[code];
  answer->source = source[code];
  answer->sink = sink[code];
  answer->chopping = SIXSTEP_SOFT;
  answer->duty = duty < 0 ? 0 : duty > 1 ? 1 : duty;
}

const sixstep_controller* sixstep_own_controller(void) {
  static const sixstep_controller own = {
      SIXSTEP_OWN_INTERFACE, SIXSTEP_ANSWERS_PAIR, "pair of the code", "drives the pair of the last code", 0, 0, 0, 0, design, 0, step, 0};
  return &own;
}
