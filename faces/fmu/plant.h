/* SPDX-License-Identifier: Apache-2.0 */
/* What a unit without controller adds: inputs for the bridge, what the controller measures, counts of converters. */
#ifndef SIXSTEP_FMU_PLANT_H
#define SIXSTEP_FMU_PLANT_H

#include "faces/fmu/drive.h"

/* References of inputs for the bridge. Legs a, b, c have consecutive ones. */
enum {
  PLANT_GATES = 1100, /* six: upper a, lower a, upper b, lower b, upper c, lower c */
  PLANT_PAIR_ENABLED = 1110,
  PLANT_SOURCE,
  PLANT_SINK,
  PLANT_CHOPPING,
  PLANT_CHOPPED,
  PLANT_DUTY,
  PLANT_OVERLAP,
  PLANT_LEGS_ENABLED = 1120,
  PLANT_LEG_STATES,
  PLANT_LEG_SWITCHES = PLANT_LEG_STATES + 3,
  PLANT_LEG_DUTIES = PLANT_LEG_SWITCHES + 3,
  PLANT_ENCODER_COUNT = 1307
};

/* Null, or the limit that the value of an input for the bridge breaks. */
const char* plant_limit(unsigned reference, double value);
/* Start values of the inputs for the bridge, which are 0 in `state`: those of modelDescription.xml. */
void plant_start(const drive_variables* variables, drive_state* state);
/* Null, or the limit that the inputs of a pair break together: each alone could be on its way to a valid pair. */
const char* plant_wrong_pair(const drive_variables* variables, const drive_state* state);
/* Gives inputs that have changed to the session. SIXSTEP_OVER: the run is over. */
sixstep_status plant_apply(const drive_variables* variables, drive_state* state);
/* Advances to an instant of the run, or to the first event of `stops` before or at it; to a control tick within
 * plant_near() of it, where a controller measures. *events: those at the instant reached. */
sixstep_status plant_advance_to_event(const drive_variables* variables, drive_state* state, double to_s, unsigned stops,
                                      unsigned* events);
/* Instants this near are one, s: sums of step sizes miss control ticks by rounding. */
double plant_near(const sixstep_session* session);
/* Reads what a controller outside measures, if the run stands at a control tick. An advance does it at the last tick passed. */
void plant_measure(const drive_variables* variables, drive_state* state);
/* Reads the counts of converters. */
void plant_look(const drive_variables* variables, drive_state* state);

#endif
