/* SPDX-License-Identifier: Apache-2.0 */
/* The board around the firmware, for the program that simulates it (hal_sixstep.c). */
#ifndef HAL_SIXSTEP_H
#define HAL_SIXSTEP_H

#include <sixstep.h>
#include <stdio.h>

/* Connects the layer to a session with SIXSTEP_CHIP_GATES at t = 0, and calls esc_start(). `log` may be null. Each of its
 * lines is an instant in ps, a word and a number: "gates" with the six bits, "blank" with the instant at which blanking
 * ends, "taken" or "masked" with the back-EMF, nV, of the phase whose comparator changed to the sought level. */
void hal_connect(sixstep_session* session, FILE* log);
/* Runs firmware and motor up to an instant, s. Returns what the session last returned. */
sixstep_status hal_run(double to_s);
/* Counts of the throttle's potentiometer from now on, 0 to 4095. */
void hal_set_throttle(uint16_t counts);

#endif
