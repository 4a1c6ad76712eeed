/* SPDX-License-Identifier: Apache-2.0 */
/* Prints the layout of the structs of sixstep.h in strict C99. The tests compare it with the declarations in other languages. */
#include <stdio.h>

#include "faces/c/sixstep.h"

#define SIZE(type) printf(#type " %u\n", (unsigned)sizeof(type))
#define PLACE(type, member) printf(#type "." #member " %u\n", (unsigned)offsetof(type, member))

int main(void) {
  sixstep_options options = SIXSTEP_OPTIONS;
  sixstep_session* session = NULL;
  SIZE(sixstep_options);
  SIZE(sixstep_problem);
  SIZE(sixstep_signal);
  SIZE(sixstep_measured);
  SIZE(sixstep_answer);
  SIZE(sixstep_counts);
  PLACE(sixstep_options, chip);
  PLACE(sixstep_measured, hall);
  PLACE(sixstep_answer, leg);
  PLACE(sixstep_answer, speed_reference_rad_s);
  PLACE(sixstep_counts, hall);
  return sixstep_abi() == SIXSTEP_ABI && sixstep_open_text("", &options, &session) == SIXSTEP_REFUSED ? (sixstep_free(session), 0) : 1;
}
