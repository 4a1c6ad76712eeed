/* SPDX-License-Identifier: Apache-2.0 */
/* FMI 3.0 for co-simulation. A refused call changes nothing: it logs a message and returns fmi3Error, and the
 * instance continues. fmi3_step.c implements steps and event mode. fmi3_none.c contains the functions that the unit
 * must export but does not support. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "faces/fmu/fmi3_instance.h"

typedef fmi3_instance instance;

static const char* const categories[] = {"logStatusError", "logStatusDiscard", "logEvents"};

static void log_of(drive* unit, drive_result status, const char* category, const char* message) {
  const instance* i = (const instance*)(const void*)unit;
  if (!i->log || (status == DRIVE_OK && !i->events)) return;
  /* If the run is over, the step returns fmi3OK and terminateSimulation, so the log has a warning. */
  i->log(i->environment, status == DRIVE_DISCARD ? fmi3Warning : fmi3_status(status), category, message);
}

FMI3_EXPORT const char* FMI3(GetVersion)(void);
const char* FMI3(GetVersion)(void) { return "3.0"; }

static int is_category(const char* name) {
  size_t n;
  for (n = 0; name && n < sizeof categories / sizeof *categories; ++n)
    if (strcmp(categories[n], name) == 0) return 1;
  return 0;
}

FMI3_FUNCTION(SetDebugLogging, (fmi3Instance c, fmi3Boolean on, size_t count, const fmi3String names[])) {
  instance* i = c;
  int events = count ? i && i->events : on;
  size_t n;
  if (!fmi3_may(c, "fmi3SetDebugLogging", ANY_PHASE)) return fmi3Error;
  if (count && !names) return fmi3_fail(c, "fmi3SetDebugLogging", "the categories are null");
  for (n = 0; n < count; ++n) {
    if (!is_category(names[n])) return fmi3_fail(c, "fmi3SetDebugLogging", "a log category is not in modelDescription.xml");
    if (strcmp(names[n], "logEvents") == 0) events = on;
  }
  i->events = events;
  return fmi3OK;
}

/* Whether all references are signals, which can be read within a step. */
static int are_intermediate(drive* unit, const fmi3ValueReference r[], size_t count) {
  size_t n;
  for (n = 0; n < count; ++n)
    if (r[n] == 0 || r[n] >= DRIVE_SIGNALS || unit->variables.kinds[r[n]] != DRIVE_REAL) {
      drive_fail(unit, "fmi3InstantiateCoSimulation", "an intermediate variable is not marked as such in modelDescription.xml");
      return 0;
    }
  return 1;
}

FMI3_EXPORT fmi3Instance FMI3(InstantiateCoSimulation)(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                                       fmi3Boolean, fmi3Boolean, const fmi3ValueReference[], size_t,
                                                       fmi3InstanceEnvironment, fmi3LogMessageCallback,
                                                       fmi3IntermediateUpdateCallback);
fmi3Instance FMI3(InstantiateCoSimulation)(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                           fmi3Boolean loggingOn, fmi3Boolean eventModeUsed, fmi3Boolean earlyReturnAllowed,
                                           const fmi3ValueReference intermediate[], size_t intermediates,
                                           fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                           fmi3IntermediateUpdateCallback update) {
  instance* i = calloc(1, sizeof *i);
  const char* refused = NULL;
  (void)visible;
  if (!i) return NULL;
  i->unit.log = log_of;
  i->log = log;
  i->environment = environment;
  i->events = loggingOn;
  i->update = update;
  i->event_mode = eventModeUsed;
  i->early_return = earlyReturnAllowed;
  if (!name || !*name) refused = "the instance needs a name";
  if (intermediates && !intermediate) refused = "the intermediate variables are null";
  if (refused) drive_fail(&i->unit, "fmi3InstantiateCoSimulation", refused);
  if (refused || drive_read(&i->unit, resources, token) != DRIVE_OK || !are_intermediate(&i->unit, intermediate, intermediates)) {
    free(i);
    return NULL;
  }
  return i;
}

FMI3_EXPORT void FMI3(FreeInstance)(fmi3Instance);
void FMI3(FreeInstance)(fmi3Instance c) {
  if (c) drive_clear(&((instance*)c)->unit);
  free(c);
}

FMI3_FUNCTION(EnterInitializationMode, (fmi3Instance c, fmi3Boolean hasTolerance, fmi3Float64 tolerance, fmi3Float64 start,
                                        fmi3Boolean hasStop, fmi3Float64 stop)) {
  (void)hasTolerance, (void)tolerance; /* a run is exact */
  if (!fmi3_may(c, "fmi3EnterInitializationMode", DRIVE_INSTANTIATED)) return fmi3Error;
  if (drive_set_up(c, start, hasStop, stop) != DRIVE_OK) return fmi3Error;
  return fmi3_status(drive_initialize(c));
}
FMI3_FUNCTION(Terminate, (fmi3Instance c)) {
  if (!fmi3_may(c, "fmi3Terminate", DRIVE_STEP_COMPLETE | DRIVE_STEP_FAILED | DRIVE_EVENT)) return fmi3Error;
  return fmi3_status(drive_terminate(c));
}
FMI3_FUNCTION(Reset, (fmi3Instance c)) {
  if (!fmi3_may(c, "fmi3Reset", ANY_PHASE)) return fmi3Error;
  drive_reset(c);
  return fmi3OK;
}

/* ---- Values ---------------------------------------------------------------------------------------------------------- */

static int has_arrays(fmi3Instance c, const char* function, unsigned phases, const void* references, size_t count,
                      const void* values) {
  if (!fmi3_may(c, function, phases)) return 0;
  if (count == 0 || (references && values)) return 1;
  fmi3_fail(c, function, "the references or the values are null");
  return 0;
}

/* Whether these references have `room` values in all, as the standard requires. */
static int fits(fmi3Instance c, const char* function, const fmi3ValueReference r[], size_t count, size_t room) {
  size_t n, needed = 0;
  for (n = 0; n < count; ++n) needed += (size_t)drive_size(c, r[n]);
  if (needed == room) return 1;
  fmi3_fail(c, function, "the number of values must equal the number of elements of all variables");
  return 0;
}

FMI3_FUNCTION(GetFloat64, (fmi3Instance c, const fmi3ValueReference r[], size_t count, fmi3Float64 values[], size_t room)) {
  size_t n, at = 0;
  if (!has_arrays(c, "fmi3GetFloat64", READABLE, r, count, values) || !fits(c, "fmi3GetFloat64", r, count, room)) return fmi3Error;
  for (n = 0; n < count; at += (size_t)drive_size(c, r[n++]))
    if (drive_get(c, "fmi3GetFloat64", r[n], DRIVE_REAL, values + at) != DRIVE_OK) return fmi3Error;
  return fmi3OK;
}
FMI3_FUNCTION(SetFloat64,
              (fmi3Instance c, const fmi3ValueReference r[], size_t count, const fmi3Float64 values[], size_t room)) {
  size_t n, at = 0;
  if (!has_arrays(c, "fmi3SetFloat64", SETTABLE, r, count, values) || !fits(c, "fmi3SetFloat64", r, count, room)) return fmi3Error;
  for (n = 0; n < count; at += (size_t)drive_size(c, r[n++]))
    if (drive_set(c, "fmi3SetFloat64", r[n], DRIVE_REAL, values + at) != DRIVE_OK) return fmi3Error;
  return fmi3OK;
}

/* Integers and Booleans pass through doubles, which represent all their values exactly. A NaN becomes 0. */
#define WHOLE_TYPE(type, kind)                                                                                           \
  FMI3_FUNCTION(Get##type, (fmi3Instance c, const fmi3ValueReference r[], size_t count, fmi3##type values[], size_t room)) { \
    double v[DRIVE_ARRAY];                                                                                               \
    size_t n, at = 0;                                                                                                    \
    int k;                                                                                                               \
    if (!has_arrays(c, "fmi3Get" #type, READABLE, r, count, values) || !fits(c, "fmi3Get" #type, r, count, room))        \
      return fmi3Error;                                                                                                  \
    for (n = 0; n < count; ++n) {                                                                                        \
      if (drive_get(c, "fmi3Get" #type, r[n], kind, v) != DRIVE_OK) return fmi3Error;                                    \
      for (k = 0; k < drive_size(c, r[n]); ++k) values[at++] = (fmi3##type)(fabs(v[k]) < 2147483647.0 ? v[k] : 0.0);     \
    }                                                                                                                    \
    return fmi3OK;                                                                                                       \
  }                                                                                                                      \
  FMI3_FUNCTION(Set##type,                                                                                               \
                (fmi3Instance c, const fmi3ValueReference r[], size_t count, const fmi3##type values[], size_t room)) {  \
    double v[DRIVE_ARRAY];                                                                                               \
    size_t n, at = 0;                                                                                                    \
    int k;                                                                                                               \
    if (!has_arrays(c, "fmi3Set" #type, SETTABLE, r, count, values) || !fits(c, "fmi3Set" #type, r, count, room))        \
      return fmi3Error;                                                                                                  \
    for (n = 0; n < count; ++n) {                                                                                        \
      for (k = 0; k < drive_size(c, r[n]); ++k) v[k] = (double)values[at++];                                             \
      if (drive_set(c, "fmi3Set" #type, r[n], kind, v) != DRIVE_OK) return fmi3Error;                                    \
    }                                                                                                                    \
    return fmi3OK;                                                                                                       \
  }
WHOLE_TYPE(Int32, DRIVE_INTEGER)
WHOLE_TYPE(Boolean, DRIVE_BOOLEAN)

FMI3_FUNCTION(GetString, (fmi3Instance c, const fmi3ValueReference r[], size_t count, fmi3String values[], size_t room)) {
  size_t n;
  if (!has_arrays(c, "fmi3GetString", READABLE, r, count, values)) return fmi3Error;
  if (room != count) return fmi3_fail(c, "fmi3GetString", "needs as many values as references");
  for (n = 0; n < count; ++n) {
    if (r[n] != DRIVE_DIGEST) return fmi3_fail(c, "fmi3GetString", "no string has this value reference");
    values[n] = ((instance*)c)->unit.state.digest;
  }
  return fmi3OK;
}

/* ---- State ----------------------------------------------------------------------------------------------------------- */

FMI3_FUNCTION(GetFMUState, (fmi3Instance c, fmi3FMUState* state)) {
  if (!fmi3_may(c, "fmi3GetFMUState", ANY_PHASE)) return fmi3Error;
  return fmi3_status(drive_save(c, "fmi3GetFMUState", state));
}
FMI3_FUNCTION(SetFMUState, (fmi3Instance c, fmi3FMUState state)) {
  if (!fmi3_may(c, "fmi3SetFMUState", ANY_PHASE)) return fmi3Error;
  return fmi3_status(drive_restore(c, "fmi3SetFMUState", state));
}
FMI3_FUNCTION(FreeFMUState, (fmi3Instance c, fmi3FMUState* state)) {
  if (!fmi3_may(c, "fmi3FreeFMUState", ANY_PHASE)) return fmi3Error;
  return fmi3_status(drive_forget(c, "fmi3FreeFMUState", state));
}
FMI3_FUNCTION(SerializedFMUStateSize, (fmi3Instance c, fmi3FMUState state, size_t* size)) {
  size_t bytes;
  if (!fmi3_may(c, "fmi3SerializedFMUStateSize", ANY_PHASE)) return fmi3Error;
  if (!size) return fmi3_fail(c, "fmi3SerializedFMUStateSize", "the pointer to the size is null");
  bytes = drive_bytes(c, state, NULL, 0);
  if (!bytes) return fmi3_fail(c, "fmi3SerializedFMUStateSize", "the state does not belong to this instance");
  *size = bytes;
  return fmi3OK;
}
FMI3_FUNCTION(SerializeFMUState, (fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t room)) {
  size_t size;
  if (!fmi3_may(c, "fmi3SerializeFMUState", ANY_PHASE)) return fmi3Error;
  size = drive_bytes(c, state, bytes, room);
  if (!size) return fmi3_fail(c, "fmi3SerializeFMUState", "the state does not belong to this instance");
  return bytes && size <= room ? fmi3OK : fmi3_fail(c, "fmi3SerializeFMUState", "the buffer is smaller than the state");
}
FMI3_FUNCTION(DeserializeFMUState, (fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState* state)) {
  if (!fmi3_may(c, "fmi3DeserializeFMUState", ANY_PHASE)) return fmi3Error;
  return fmi3_status(drive_from_bytes(c, "fmi3DeserializeFMUState", bytes, size, state));
}
