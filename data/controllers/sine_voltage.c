/* SPDX-License-Identifier: Apache-2.0 */
/* The simplest controller that commands all three legs. It has no control loop. It applies three sines of voltage, a quarter
 * of an electrical turn ahead of the magnet. The setpoint is the signed duty: at 1, the amplitude is half the bus voltage. */
#include "sixstep/control/own/own_controller.h"

static const char* design(const sixstep_given* given, const sixstep_real* values, void* config) {
  (void)values, (void)config;
  return given->mode == SIXSTEP_DUTY ? 0 : "has no loop: set control.mode = \"duty\"";
}

static void step(const void* config, void* state, const sixstep_measured* seen, sixstep_real setpoint, sixstep_answer* answer) {
  static const sixstep_real half_root_3 = (sixstep_real)0.86602540378443864676;
  const sixstep_real c = seen->magnet_cos, s = seen->magnet_sin;
  /* The unit vector a quarter of an electrical turn ahead of the magnet, as values of the phases a, b, c. */
  const sixstep_real across[3] = {-s, s / 2 + half_root_3 * c, s / 2 - half_root_3 * c};
  int k;
  (void)config, (void)state;
  answer->enabled = 1;
  for (k = 0; k < 3; ++k) {
    sixstep_real duty = (sixstep_real)0.5 + setpoint / 2 * across[k];
    if (duty < 0) duty = 0;
    if (duty > 1) duty = 1;
    answer->leg[k].state = SIXSTEP_LEG_PWM;
    answer->leg[k].switches = SIXSTEP_PWM_COMPLEMENTARY;
    answer->leg[k].duty = duty;
  }
  answer->duty = setpoint < 0 ? -setpoint : setpoint; /* the report shows this duty */
}

const sixstep_controller* sixstep_own_controller(void) {
  static const sixstep_controller own = {
      SIXSTEP_OWN_INTERFACE, SIXSTEP_ANSWERS_LEGS, "sine voltage", "applies sines of voltage and measures no current",
      0, 0, 0, 0, design, 0, step, 0};
  return &own;
}
