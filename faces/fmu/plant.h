/* SPDX-License-Identifier: Apache-2.0 */
/* Additions of a unit without controller: inputs for the bridge, measurements of the controller, counts of
   converters. */
#ifndef SIXSTEP_FMU_PLANT_H
#define SIXSTEP_FMU_PLANT_H

#include "faces/fmu/drive.h"

/* References of inputs for the bridge. Inputs of legs a, b, c have consecutive references. */
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

/* Null, or the limit that the value of an input violates. */
const char* plant_limit(unsigned reference, double value);
/* Sets the inputs for the bridge to their start values in modelDescription.xml. Before this call they are 0. */
void plant_start(const drive_variables* variables, drive_state* state);
/* Null, or the limit that source and sink together violate. They are checked together, because an importer sets them
   one after the other. */
const char* plant_wrong_pair(const drive_variables* variables, const drive_state* state);
/* Sets changed inputs in the session. SIXSTEP_OVER: the run is over. */
sixstep_status plant_apply(const drive_variables* variables, drive_state* state);
/* Advances to an instant of the run, or to an earlier event of `stops`. If an external controller measures, advances
 * to a control tick within plant_near() of the instant. *events: the events at the reached instant. */
sixstep_status plant_advance_to_event(const drive_variables* variables, drive_state* state, double to_s, unsigned stops,
                                      unsigned* events);
/* Instants closer than this are equal, s. Sums of step sizes miss control ticks by rounding. */
double plant_near(const sixstep_session* session);
/* Reads the measurement of an external controller, if the run is at a control tick. An advance calls it at the last
   passed tick. */
void plant_measure(const drive_variables* variables, drive_state* state);
/* Reads the counts of converters. */
void plant_look(const drive_variables* variables, drive_state* state);

#endif
