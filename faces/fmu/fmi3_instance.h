/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SIXSTEP_FMI3_INSTANCE_H
#define SIXSTEP_FMI3_INSTANCE_H

#include "faces/fmu/drive.h"
#include "faces/fmu/fmi3_types.h"

typedef struct {
  drive unit; /* first member: the log function finds the instance by the drive's address */
  fmi3LogMessageCallback log;
  fmi3IntermediateUpdateCallback update; /* null: the importer requests no intermediate update */
  fmi3InstanceEnvironment environment;
  int events; /* changes of inputs are logged */
  int event_mode, early_return;
} fmi3_instance;

#define ANY_PHASE                                                                                          \
  (DRIVE_INSTANTIATED | DRIVE_INITIALIZATION | DRIVE_STEP_COMPLETE | DRIVE_STEP_FAILED | DRIVE_TERMINATED | \
   DRIVE_EVENT)
#define READABLE \
  (DRIVE_INITIALIZATION | DRIVE_STEP_COMPLETE | DRIVE_STEP_FAILED | DRIVE_TERMINATED | DRIVE_EVENT | DRIVE_INTERMEDIATE)
#define SETTABLE (DRIVE_INSTANTIATED | DRIVE_INITIALIZATION | DRIVE_STEP_COMPLETE | DRIVE_EVENT)

/* Whether the call is allowed in the instance's phase; if not, logs a message. A null instance has no logger. */
static inline int fmi3_may(fmi3Instance c, const char* function, unsigned phases) {
  return c && drive_allowed((drive*)c, function, phases);
}
static inline fmi3Status fmi3_status(drive_result result) {
  return result == DRIVE_OK ? fmi3OK : result == DRIVE_DISCARD ? fmi3Discard : fmi3Error;
}
static inline fmi3Status fmi3_fail(fmi3Instance c, const char* function, const char* message) {
  return c ? fmi3_status(drive_fail((drive*)c, function, message)) : fmi3Error;
}

#endif
