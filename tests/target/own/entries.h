/* SPDX-License-Identifier: Apache-2.0 */
/* The two entries of a user's controller, as in firmware: step and hall are compile-time constants; configuration,
 * state, inputs and outputs are in static memory. In C and in C++, this file is included after the controller's
 * source. */
#ifndef SIXSTEP_TESTS_TARGET_OWN_ENTRIES_H
#define SIXSTEP_TESTS_TARGET_OWN_ENTRIES_H

#include "sixstep/control/own/own_controller.h"

#ifdef __cplusplus
extern "C" {
#endif

extern uint64_t own_config[], own_state[]; /* aligned as in the program */
extern sixstep_measured own_measured;      /* the Hall interrupt updates only its code */
extern sixstep_real own_setpoint;
extern sixstep_answer own_answer;

void entry_tick(void);
void entry_hall(void);

#if defined __AVR__
/* The same entries as interrupts INT0 and INT1, for avr_board.cpp. */
void __vector_1(void) __attribute__((signal, used));
void __vector_2(void) __attribute__((signal, used));
#endif

#ifdef __cplusplus
}
#endif

#endif
