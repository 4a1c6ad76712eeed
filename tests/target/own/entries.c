/* SPDX-License-Identifier: Apache-2.0 */
/* The controller's source and its entries are one compilation unit: its description is a constant. The compiler can
 * therefore call or inline the functions as if the firmware named them, and omit design if nothing calls it. */
#include OWN_SOURCE

#include "tests/target/own/entries.h"

static inline void own_tick(void) {
  sixstep_own_controller()->step(own_config, own_state, &own_measured, own_setpoint, &own_answer);
}

static inline void own_hall(void) {
  const sixstep_controller* const own = sixstep_own_controller();
  if (own->hall) own->hall(own_config, own_state, own_measured.hall, &own_answer);
}

__attribute__((noinline, used)) void entry_tick(void) { own_tick(); }
__attribute__((noinline, used)) void entry_hall(void) { own_hall(); }

#if defined __AVR__
void __vector_1(void) { own_tick(); }
void __vector_2(void) { own_hall(); }
#endif
