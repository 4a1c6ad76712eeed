/* SPDX-License-Identifier: Apache-2.0 */
/* FMI 2.0 for co-simulation. A refused call changes nothing: it logs a message and returns fmi2Error, and the
 * instance continues. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "faces/fmu/drive.h"
#include "faces/fmu/fmi2_types.h"

#define ANY_PHASE                                                                                                       \
  (DRIVE_INSTANTIATED | DRIVE_INITIALIZATION | DRIVE_STEP_COMPLETE | DRIVE_STEP_FAILED | DRIVE_TERMINATED)
#define READABLE (DRIVE_INITIALIZATION | DRIVE_STEP_COMPLETE | DRIVE_STEP_FAILED | DRIVE_TERMINATED)
#define SETTABLE (DRIVE_INSTANTIATED | DRIVE_INITIALIZATION | DRIVE_STEP_COMPLETE)

typedef struct {
  drive unit; /* first member: the log function finds the instance by the drive's address */
  char* name;
  fmi2CallbackFunctions callbacks;
  int events;         /* whether changes of inputs are logged */
  fmi2Status stepped; /* result of the last step */
} instance;

static const char* const categories[] = {"logStatusError", "logStatusDiscard", "logEvents"};

/* The importer formats the message, so each percent sign is doubled. */
static void call_logger(const instance* i, fmi2Status status, const char* category, const char* message) {
  char text[2 * DRIVE_MESSAGE];
  size_t out = 0;
  if (!i->callbacks.logger) return;
  for (; *message && out + 2 < sizeof text; ++message) {
    if (*message == '%') text[out++] = '%';
    text[out++] = *message;
  }
  text[out] = '\0';
  i->callbacks.logger(i->callbacks.componentEnvironment, i->name, status, category, text);
}

static fmi2Status status_of(drive_result result) {
  return result == DRIVE_OK ? fmi2OK : result == DRIVE_DISCARD ? fmi2Discard : fmi2Error;
}

static void log_of(drive* unit, drive_result status, const char* category, const char* message) {
  const instance* i = (const instance*)(const void*)unit;
  if (status == DRIVE_OK && !i->events) return;
  call_logger(i, status_of(status), category, message);
}

static int may(fmi2Component c, const char* function, unsigned phases) {
  return c && drive_allowed(&((instance*)c)->unit, function, phases);
}

static fmi2Status fail(fmi2Component c, const char* function, const char* message) {
  return status_of(drive_fail(&((instance*)c)->unit, function, message));
}

const char* FMI2(GetTypesPlatform)(void) { return "default"; }
const char* FMI2(GetVersion)(void) { return "2.0"; }

static int is_category(const char* name) {
  size_t n;
  for (n = 0; name && n < sizeof categories / sizeof *categories; ++n)
    if (strcmp(categories[n], name) == 0) return 1;
  return 0;
}

fmi2Status FMI2(SetDebugLogging)(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String names[]) {
  instance* i = c;
  int events = count ? i && i->events : on;
  size_t n;
  if (!may(c, "fmi2SetDebugLogging", ANY_PHASE)) return fmi2Error;
  if (count && !names) return fail(c, "fmi2SetDebugLogging", "the categories are null");
  for (n = 0; n < count; ++n) {
    if (!is_category(names[n])) return fail(c, "fmi2SetDebugLogging", "a log category is not in modelDescription.xml");
    if (strcmp(names[n], "logEvents") == 0) events = on;
  }
  i->events = events;
  return fmi2OK;
}

/* Logs a message and frees an instance that cannot be created. */
static fmi2Component refuse(instance* i, const char* message) {
  call_logger(i, fmi2Error, "logStatusError", message);
  free(i->name);
  free(i);
  return NULL;
}

fmi2Component FMI2(Instantiate)(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                const fmi2CallbackFunctions* callbacks, fmi2Boolean visible, fmi2Boolean loggingOn) {
  instance* i = calloc(1, sizeof *i);
  (void)visible;
  if (!i) return NULL;
  if (callbacks) i->callbacks = *callbacks;
  i->unit.log = log_of;
  i->events = loggingOn;
  const size_t bytes = name ? strlen(name) + 1 : 1;
  if (!(i->name = malloc(bytes))) {
    free(i);
    return NULL;
  }
  memcpy(i->name, name ? name : "", bytes);
  if (!name || !*name) return refuse(i, "fmi2Instantiate: the instance needs a name");
  if (type != fmi2CoSimulation) return refuse(i, "fmi2Instantiate: the unit is for co-simulation only");
  if (drive_read(&i->unit, resources, guid) != DRIVE_OK) return refuse(i, "fmi2Instantiate: no instance was created");
  return i;
}

void FMI2(FreeInstance)(fmi2Component c) {
  instance* i = c;
  if (!i) return;
  drive_clear(&i->unit);
  free(i->name);
  free(i);
}

fmi2Status FMI2(SetupExperiment)(fmi2Component c, fmi2Boolean hasTolerance, fmi2Real tolerance, fmi2Real start,
                                 fmi2Boolean hasStop, fmi2Real stop) {
  (void)hasTolerance, (void)tolerance; /* a run is exact */
  if (!may(c, "fmi2SetupExperiment", DRIVE_INSTANTIATED)) return fmi2Error;
  return status_of(drive_set_up(&((instance*)c)->unit, start, hasStop, stop));
}

fmi2Status FMI2(EnterInitializationMode)(fmi2Component c) {
  if (!may(c, "fmi2EnterInitializationMode", DRIVE_INSTANTIATED)) return fmi2Error;
  return status_of(drive_initialize(&((instance*)c)->unit));
}

fmi2Status FMI2(ExitInitializationMode)(fmi2Component c) {
  if (!may(c, "fmi2ExitInitializationMode", DRIVE_INITIALIZATION)) return fmi2Error;
  ((instance*)c)->unit.state.phase = DRIVE_STEP_COMPLETE;
  return fmi2OK;
}

fmi2Status FMI2(Terminate)(fmi2Component c) {
  if (!may(c, "fmi2Terminate", DRIVE_STEP_COMPLETE | DRIVE_STEP_FAILED)) return fmi2Error;
  return status_of(drive_terminate(&((instance*)c)->unit));
}

fmi2Status FMI2(Reset)(fmi2Component c) {
  if (!may(c, "fmi2Reset", ANY_PHASE)) return fmi2Error;
  drive_reset(&((instance*)c)->unit);
  return fmi2OK;
}

/* ---- Values ---------------------------------------------------------------------------------------------------------- */

static int has_arrays(fmi2Component c, const char* function, unsigned phases, const void* references, size_t count,
                      const void* values) {
  if (!may(c, function, phases)) return 0;
  if (count == 0 || (references && values)) return 1;
  fail(c, function, "the references or the values are null");
  return 0;
}

fmi2Status FMI2(GetReal)(fmi2Component c, const fmi2ValueReference r[], size_t count, fmi2Real values[]) {
  size_t n;
  if (!has_arrays(c, "fmi2GetReal", READABLE, r, count, values)) return fmi2Error;
  for (n = 0; n < count; ++n)
    if (drive_get(&((instance*)c)->unit, "fmi2GetReal", r[n], DRIVE_REAL, &values[n]) != DRIVE_OK) return fmi2Error;
  return fmi2OK;
}

static fmi2Status get_whole(fmi2Component c, const char* function, drive_kind kind, const fmi2ValueReference r[], size_t count,
                            int values[]) {
  double value = 0.0;
  size_t n;
  if (!has_arrays(c, function, READABLE, r, count, values)) return fmi2Error;
  for (n = 0; n < count; ++n) {
    if (drive_get(&((instance*)c)->unit, function, r[n], kind, &value) != DRIVE_OK) return fmi2Error;
    values[n] = fabs(value) < 2147483647.0 ? (int)value : 0; /* NaN: 0 */
  }
  return fmi2OK;
}
fmi2Status FMI2(GetInteger)(fmi2Component c, const fmi2ValueReference r[], size_t count, fmi2Integer values[]) {
  return get_whole(c, "fmi2GetInteger", DRIVE_INTEGER, r, count, values);
}
fmi2Status FMI2(GetBoolean)(fmi2Component c, const fmi2ValueReference r[], size_t count, fmi2Boolean values[]) {
  return get_whole(c, "fmi2GetBoolean", DRIVE_BOOLEAN, r, count, values);
}

fmi2Status FMI2(GetString)(fmi2Component c, const fmi2ValueReference r[], size_t count, fmi2String values[]) {
  size_t n;
  if (!has_arrays(c, "fmi2GetString", READABLE, r, count, values)) return fmi2Error;
  for (n = 0; n < count; ++n) {
    if (r[n] != DRIVE_DIGEST) return fail(c, "fmi2GetString", "no string has this value reference");
    values[n] = ((instance*)c)->unit.state.digest;
  }
  return fmi2OK;
}

fmi2Status FMI2(SetReal)(fmi2Component c, const fmi2ValueReference r[], size_t count, const fmi2Real values[]) {
  size_t n;
  if (!has_arrays(c, "fmi2SetReal", SETTABLE, r, count, values)) return fmi2Error;
  for (n = 0; n < count; ++n)
    if (drive_set(&((instance*)c)->unit, "fmi2SetReal", r[n], DRIVE_REAL, &values[n]) != DRIVE_OK) return fmi2Error;
  return fmi2OK;
}
static fmi2Status set_whole(fmi2Component c, const char* function, drive_kind kind, const fmi2ValueReference r[], size_t count,
                            const int values[]) {
  double value;
  size_t n;
  if (!has_arrays(c, function, SETTABLE, r, count, values)) return fmi2Error;
  for (n = 0; n < count; ++n) {
    value = kind == DRIVE_BOOLEAN ? values[n] != 0 : values[n];
    if (drive_set(&((instance*)c)->unit, function, r[n], kind, &value) != DRIVE_OK) return fmi2Error;
  }
  return fmi2OK;
}
fmi2Status FMI2(SetInteger)(fmi2Component c, const fmi2ValueReference r[], size_t count, const fmi2Integer values[]) {
  return set_whole(c, "fmi2SetInteger", DRIVE_INTEGER, r, count, values);
}
fmi2Status FMI2(SetBoolean)(fmi2Component c, const fmi2ValueReference r[], size_t count, const fmi2Boolean values[]) {
  return set_whole(c, "fmi2SetBoolean", DRIVE_BOOLEAN, r, count, values);
}
/* The only text variable is an output. */
fmi2Status FMI2(SetString)(fmi2Component c, const fmi2ValueReference r[], size_t count, const fmi2String values[]) {
  (void)r, (void)values;
  if (!may(c, "fmi2SetString", SETTABLE)) return fmi2Error;
  return count == 0 ? fmi2OK : fail(c, "fmi2SetString", "the unit has no such variable");
}

/* ---- State ----------------------------------------------------------------------------------------------------------- */

fmi2Status FMI2(GetFMUstate)(fmi2Component c, fmi2FMUstate* state) {
  if (!may(c, "fmi2GetFMUstate", ANY_PHASE)) return fmi2Error;
  return status_of(drive_save(&((instance*)c)->unit, "fmi2GetFMUstate", state));
}
fmi2Status FMI2(SetFMUstate)(fmi2Component c, fmi2FMUstate state) {
  if (!may(c, "fmi2SetFMUstate", ANY_PHASE)) return fmi2Error;
  return status_of(drive_restore(&((instance*)c)->unit, "fmi2SetFMUstate", state));
}
fmi2Status FMI2(FreeFMUstate)(fmi2Component c, fmi2FMUstate* state) {
  if (!may(c, "fmi2FreeFMUstate", ANY_PHASE)) return fmi2Error;
  return status_of(drive_forget(&((instance*)c)->unit, "fmi2FreeFMUstate", state));
}

fmi2Status FMI2(SerializedFMUstateSize)(fmi2Component c, fmi2FMUstate state, size_t* size) {
  size_t bytes;
  if (!may(c, "fmi2SerializedFMUstateSize", ANY_PHASE)) return fmi2Error;
  if (!size) return fail(c, "fmi2SerializedFMUstateSize", "the pointer to the size is null");
  bytes = drive_bytes(&((instance*)c)->unit, state, NULL, 0);
  if (!bytes) return fail(c, "fmi2SerializedFMUstateSize", "the state does not belong to this instance");
  *size = bytes;
  return fmi2OK;
}
fmi2Status FMI2(SerializeFMUstate)(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t room) {
  size_t size;
  if (!may(c, "fmi2SerializeFMUstate", ANY_PHASE)) return fmi2Error;
  size = drive_bytes(&((instance*)c)->unit, state, (unsigned char*)bytes, room);
  if (!size) return fail(c, "fmi2SerializeFMUstate", "the state does not belong to this instance");
  return bytes && size <= room ? fmi2OK : fail(c, "fmi2SerializeFMUstate", "the buffer is smaller than the state");
}
fmi2Status FMI2(DeSerializeFMUstate)(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate* state) {
  if (!may(c, "fmi2DeSerializeFMUstate", ANY_PHASE)) return fmi2Error;
  return status_of(drive_from_bytes(&((instance*)c)->unit, "fmi2DeSerializeFMUstate", (const unsigned char*)bytes, size, state));
}

/* ---- Steps ----------------------------------------------------------------------------------------------------------- */

fmi2Status FMI2(DoStep)(fmi2Component c, fmi2Real point, fmi2Real size, fmi2Boolean noStateBefore) {
  instance* i = c;
  (void)noStateBefore;
  if (!may(c, "fmi2DoStep", DRIVE_STEP_COMPLETE)) return fmi2Error;
  return i->stepped = status_of(drive_step(&i->unit, "fmi2DoStep", point, size));
}

fmi2Status FMI2(CancelStep)(fmi2Component c) {
  return c ? fail(c, "fmi2CancelStep", "no step is pending: each step ends before fmi2DoStep returns") : fmi2Error;
}

static int has_status(fmi2Component c, const char* function, const void* value) {
  if (!may(c, function, DRIVE_STEP_COMPLETE | DRIVE_STEP_FAILED | DRIVE_TERMINATED)) return 0;
  if (!value) fail(c, function, "the pointer to the value is null");
  return value != NULL;
}

/* The standard's return value for a status that the unit does not have. */
static fmi2Status no_status(fmi2Component c, const char* message) {
  call_logger(c, fmi2Discard, "logStatusDiscard", message);
  return fmi2Discard;
}

fmi2Status FMI2(GetStatus)(fmi2Component c, fmi2StatusKind kind, fmi2Status* value) {
  if (!has_status(c, "fmi2GetStatus", value)) return fmi2Error;
  if (kind != fmi2DoStepStatus) return no_status(c, "fmi2GetStatus: accepts only fmi2DoStepStatus");
  *value = ((instance*)c)->stepped;
  return fmi2OK;
}
fmi2Status FMI2(GetRealStatus)(fmi2Component c, fmi2StatusKind kind, fmi2Real* value) {
  if (!has_status(c, "fmi2GetRealStatus", value)) return fmi2Error;
  if (kind != fmi2LastSuccessfulTime) return no_status(c, "fmi2GetRealStatus: accepts only fmi2LastSuccessfulTime");
  *value = ((instance*)c)->unit.state.now_s;
  return fmi2OK;
}
fmi2Status FMI2(GetIntegerStatus)(fmi2Component c, fmi2StatusKind kind, fmi2Integer* value) {
  (void)kind;
  return has_status(c, "fmi2GetIntegerStatus", value) ? no_status(c, "fmi2GetIntegerStatus: the unit has no integer status") : fmi2Error;
}
fmi2Status FMI2(GetBooleanStatus)(fmi2Component c, fmi2StatusKind kind, fmi2Boolean* value) {
  if (!has_status(c, "fmi2GetBooleanStatus", value)) return fmi2Error;
  if (kind != fmi2Terminated) return no_status(c, "fmi2GetBooleanStatus: accepts only fmi2Terminated");
  *value = ((instance*)c)->unit.state.phase == DRIVE_STEP_FAILED;
  return fmi2OK;
}
fmi2Status FMI2(GetStringStatus)(fmi2Component c, fmi2StatusKind kind, fmi2String* value) {
  if (!has_status(c, "fmi2GetStringStatus", value)) return fmi2Error;
  if (kind != fmi2PendingStatus) return no_status(c, "fmi2GetStringStatus: accepts only fmi2PendingStatus");
  *value = "";
  return fmi2OK;
}

/* ---- Not offered: modelDescription.xml says so ----------------------------------------------------------------------- */

fmi2Status FMI2(GetDirectionalDerivative)(fmi2Component c, const fmi2ValueReference unknown[], size_t unknowns,
                                          const fmi2ValueReference known[], size_t knowns, const fmi2Real in[],
                                          fmi2Real out[]) {
  (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)in, (void)out;
  return c ? fail(c, "fmi2GetDirectionalDerivative", "the unit computes no derivatives") : fmi2Error;
}
fmi2Status FMI2(SetRealInputDerivatives)(fmi2Component c, const fmi2ValueReference r[], size_t count,
                                         const fmi2Integer orders[], const fmi2Real values[]) {
  (void)r, (void)count, (void)orders, (void)values;
  return c ? fail(c, "fmi2SetRealInputDerivatives", "inputs are constant between communication points") : fmi2Error;
}
fmi2Status FMI2(GetRealOutputDerivatives)(fmi2Component c, const fmi2ValueReference r[], size_t count,
                                          const fmi2Integer orders[], fmi2Real values[]) {
  (void)r, (void)count, (void)orders, (void)values;
  return c ? fail(c, "fmi2GetRealOutputDerivatives", "the unit computes no derivatives") : fmi2Error;
}
