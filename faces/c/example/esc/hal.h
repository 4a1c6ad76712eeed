/* SPDX-License-Identifier: Apache-2.0 */
/* Hardware abstraction layer of a small speed controller (ESC): a PWM timer with three complementary outputs and
 * dead time, a free-running counter with one compare interrupt, a comparator per phase, converters and Hall capture.
 *
 * The firmware calls the functions hal_... and defines the functions esc_.... The layer calls the functions esc_...
 * as interrupts, which are never nested. hal_sixstep.c implements the layer on the simulated motor. The layer of a
 * real board writes registers instead. */
#ifndef HAL_H
#define HAL_H

#include <stdint.h>

/* ---- PWM timer: one count lasts 20 ns, a period 50 us ---- */

#define HAL_PWM_TOP 2500u      /* counts of a period */
#define HAL_DEAD_COUNTS 25u    /* dead time before each turn-on: 500 ns */

enum { HAL_FLOAT, HAL_LOW, HAL_PWM }; /* HAL_FLOAT: both switches off; HAL_LOW: lower switch on;
                                         HAL_PWM: upper switch on below the compare value, else the lower one */
/* Sets the states of legs a, b, c at once. */
void hal_legs(const uint8_t leg[3]);
/* Sets the compare value of all legs, 0 to HAL_PWM_TOP. It is preloaded: it acts from the next period on. */
void hal_duty(uint16_t compare);

/* ---- Counter: 16 bits at 2 MHz ---- */

#define HAL_COUNTS_PER_US 2u

uint16_t hal_counter(void);
/* Calls esc_on_timer() once, after `counts` counts (at least 1). A later call replaces an earlier one. */
void hal_timer(uint16_t counts);
void hal_timer_off(void);

/* ---- Comparators: terminal against the mean of the three terminals ---- */

/* Watches the comparator of `phase` (0 to 2): calls esc_on_comparator() at each change of its output to `high` (1 or
 * 0). Changes within `blank` counts from now are ignored. The hardware also holds the output for 2 us after each
 * change of a gate. */
void hal_comparator(uint8_t phase, uint8_t high, uint16_t blank);
void hal_comparator_off(void);
/* Level of the watched comparator's output. */
uint8_t hal_comparator_level(void);

/* ---- Converters, 12 bits: sampled in the middle of the on-time, before esc_on_pwm() ---- */

enum { HAL_CURRENT_A, HAL_CURRENT_B, HAL_CURRENT_C, HAL_BUS, HAL_THROTTLE, HAL_CHANNELS };
#define HAL_CURRENT_ZERO 2048u
#define HAL_COUNTS_PER_A 20u   /* the range is +-102.4 A */
#define HAL_COUNTS_PER_V 200u  /* the range is 20.48 V */

uint16_t hal_adc(uint8_t channel);

/* ---- Hall lines ---- */

/* Calls esc_on_hall() at each edge from now on, while no comparator is watched. */
void hal_hall_on(void);
/* H1 H2 H3 as bits 2, 1, 0. */
uint8_t hal_hall(void);

/* Counter value that was captured at the edge of the present comparator or Hall interrupt. */
uint16_t hal_captured(void);

/* ---- The firmware ---- */

void esc_start(void);         /* once, after reset */
void esc_on_pwm(void);        /* once per period, after the converters */
void esc_on_timer(void);
void esc_on_comparator(void);
void esc_on_hall(void);

enum { ESC_OFF, ESC_ALIGN, ESC_RAMP, ESC_RUN, ESC_WAIT, ESC_FAULT };
/* Values for telemetry. */
typedef struct {
  uint8_t state;
  uint16_t interval;      /* counts of a sector, filtered */
  uint32_t commutations;
  uint32_t missed;        /* sectors without a crossing */
  uint32_t desyncs;
} esc_status;
const esc_status* esc_look(void);

#endif
