/* SPDX-License-Identifier: Apache-2.0 */
/* A second firmware on the layer of faces/c/example/esc. It commutates by the Hall lines, at a quarter of the full
   duty. */
#include "hal.h"

static esc_status is;

const esc_status* esc_look(void) { return &is; }

static void drive(void) {
  static const uint8_t order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};
  static const uint8_t sector_of_hall[8] = {0, 4, 2, 3, 0, 5, 1, 0};
  const uint8_t* by_state = order[sector_of_hall[hal_hall()]];
  uint8_t leg[3];
  leg[by_state[0]] = HAL_PWM;
  leg[by_state[1]] = HAL_LOW;
  leg[by_state[2]] = HAL_FLOAT;
  hal_legs(leg);
}

void esc_start(void) { hal_hall_on(); }

void esc_on_hall(void) {
  static uint16_t last;
  is.interval = (uint16_t)(hal_captured() - last);
  last = hal_captured();
  is.commutations++;
  if (is.state == ESC_RUN) drive();
}

void esc_on_pwm(void) {
  static const uint8_t off[3] = {HAL_FLOAT, HAL_FLOAT, HAL_FLOAT};
  hal_duty(HAL_PWM_TOP / 4);
  if (hal_adc(HAL_THROTTLE) == 0) {
    is.state = ESC_OFF;
    hal_legs(off);
  } else if (is.state == ESC_OFF) {
    is.state = ESC_RUN;
    drive();
  }
}

void esc_on_timer(void) {}
void esc_on_comparator(void) {}
