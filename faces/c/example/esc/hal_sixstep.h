/* SPDX-License-Identifier: Apache-2.0 */
/* Connects the firmware to a simulated board (hal_sixstep.c). */
#ifndef HAL_SIXSTEP_H
#define HAL_SIXSTEP_H

#include <sixstep.h>
#include <stdio.h>

/* Connects the layer to a session with SIXSTEP_CHIP_GATES at t = 0, and calls esc_start(). `log` may be null. Each
 * line of the log is an instant in ps, a word and a number:
 *   gates   the six bits
 *   blank   instant at which blanking ends, ps
 *   taken   a change to the sought level that called esc_on_comparator(): back-EMF of the phase, nV
 *   masked  a change to the sought level during blanking: back-EMF of the phase, nV */
void hal_connect(sixstep_session* session, FILE* log);
/* Runs firmware and motor up to an instant, s. Returns the session's last status. */
sixstep_status hal_run(double to_s);
/* Sets the converter reading of the throttle's potentiometer from now on, 0 to 4095. */
void hal_set_throttle(uint16_t counts);

#endif
