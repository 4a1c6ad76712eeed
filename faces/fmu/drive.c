/* SPDX-License-Identifier: Apache-2.0 */
#include "faces/fmu/drive.h"
#include "faces/fmu/plant.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

drive_result drive_fail(drive* self, const char* where, const char* message) {
  char text[DRIVE_MESSAGE];
  snprintf(text, sizeof text, "%.100s: %.900s", where, message);
  self->log(self, DRIVE_ERROR, "logStatusError", text);
  return DRIVE_ERROR;
}

static const char* name_of(drive_phase phase) {
  switch (phase) {
    case DRIVE_INSTANTIATED: return "instantiated";
    case DRIVE_INITIALIZATION: return "initialization mode";
    case DRIVE_STEP_COMPLETE: return "step complete";
    case DRIVE_STEP_FAILED: return "step failed: the run is over";
    case DRIVE_EVENT: return "event mode";
    case DRIVE_INTERMEDIATE: return "intermediate update";
    default: return "terminated";
  }
}

int drive_allowed(drive* self, const char* function, unsigned phases) {
  char text[128];
  if (self->state.phase & phases) return 1;
  snprintf(text, sizeof text, "not allowed in the state \"%s\"", name_of(self->state.phase));
  drive_fail(self, function, text);
  return 0;
}

drive_result drive_refused(drive* self, const char* function, const sixstep_session* session) {
  char text[DRIVE_MESSAGE];
  sixstep_problem p;
  size_t n = 0;
  for (; sixstep_problem_at(session, n, &p) == SIXSTEP_OK; ++n) {
    snprintf(text, sizeof text, "%.200s%s%.100s %.300s; %.280s", p.place, *p.value ? " = " : "", p.value, p.limit, p.cure);
    drive_fail(self, function, text);
  }
  return n ? DRIVE_ERROR : drive_fail(self, function, "not enough memory");
}

/* snprintf() writes the decimal separator of the locale; this function writes a point. */
void drive_number(char* text, size_t room, double value) {
  char raw[64];
  size_t out = 0, in = 0;
  int digits = 6;
  do snprintf(raw, sizeof raw, "%.*g", digits, value); /* the fewest digits that give the value to the bit */
  while (digits++ < 17 && strtod(raw, NULL) != value);
  for (; raw[in] && out + 1 < room; ++in) {
    if (raw[in] && strchr("0123456789+-eE", raw[in]))
      text[out++] = raw[in];
    else if (out == 0 || text[out - 1] != '.')
      text[out++] = '.';
  }
  text[out] = '\0';
}

static void close_session(drive_state* state) {
  sixstep_free(state->session);
  state->session = NULL;
}

void drive_reset(drive* self) {
  close_session(&self->state);
  memset(&self->state, 0, sizeof self->state);
  self->state.phase = DRIVE_INSTANTIATED;
  self->state.stop_s = NAN;
  self->state.uses[0] = self->state.uses[1] = 1;
  memcpy(self->state.wanted, self->variables.starts, sizeof self->state.wanted);
  memcpy(self->state.applied, self->variables.starts, sizeof self->state.applied);
  plant_start(&self->variables, &self->state);
}

void drive_clear(drive* self) {
  close_session(&self->state);
  while (self->saved) {
    void* first = self->saved;
    drive_forget(self, "", &first);
  }
}

drive_result drive_set_up(drive* self, double start_s, int has_stop, double stop_s) {
  if (!isfinite(start_s)) return drive_fail(self, "start time", "must be a number");
  if (has_stop && !(stop_s > start_s)) return drive_fail(self, "stop time", "must be after the start time");
  self->state.start_s = self->state.now_s = start_s;
  self->state.stop_s = has_stop && isfinite(stop_s) ? stop_s : NAN;
  return DRIVE_OK;
}

/* Opens a longer run if the stop time is later than the end of the run. An earlier stop time changes nothing, because a
 * shorter run would be another scenario. */
static drive_result lengthen(drive* self) {
  char setting[64] = "duration_s=";
  const char* settings[2] = {setting, NULL};
  sixstep_options options = SIXSTEP_OPTIONS;
  sixstep_session* longer = NULL;
  const double wanted_s = self->state.stop_s - self->state.start_s;
  if (!(wanted_s > sixstep_duration(self->state.session))) return DRIVE_OK;
  drive_number(setting + strlen(setting), sizeof setting - strlen(setting), wanted_s);
  options.settings = settings;
  options.chip = self->variables.chip;
  if (sixstep_open_file(self->scenario, &options, &longer) != SIXSTEP_OK) {
    drive_refused(self, "stop time", longer);
    sixstep_free(longer);
    return DRIVE_ERROR;
  }
  close_session(&self->state);
  self->state.session = longer;
  return DRIVE_OK;
}

drive_result drive_initialize(drive* self) {
  sixstep_options options = SIXSTEP_OPTIONS;
  sixstep_session* session = NULL;
  options.chip = self->variables.chip;
  if (sixstep_open_file(self->scenario, &options, &session) != SIXSTEP_OK) {
    drive_refused(self, "initialization", session);
    sixstep_free(session);
    return DRIVE_ERROR;
  }
  self->state.session = session;
  if (lengthen(self) != DRIVE_OK) {
    close_session(&self->state);
    return DRIVE_ERROR;
  }
  plant_measure(&self->variables, &self->state);
  plant_look(&self->variables, &self->state);
  self->state.phase = DRIVE_INITIALIZATION;
  return DRIVE_OK;
}

/* Finishes a copy of the session, so that the session itself can still be saved. */
drive_result drive_terminate(drive* self) {
  sixstep_session* end = NULL;
  drive_result result = DRIVE_OK;
  if (sixstep_copy(self->state.session, &end) != SIXSTEP_OK) return drive_fail(self, "terminate", "not enough memory");
  if (sixstep_finish(end) == SIXSTEP_OK)
    snprintf(self->state.digest, sizeof self->state.digest, "%016llx", (unsigned long long)sixstep_digest(end));
  else
    result = drive_refused(self, "terminate", end);
  sixstep_free(end);
  self->state.phase = DRIVE_TERMINATED;
  return result;
}

int drive_size(const drive* self, unsigned reference) {
  return reference < DRIVE_REFERENCES && self->variables.counts[reference] > 0 ? self->variables.counts[reference] : 1;
}

static double value_of(const drive* self, unsigned reference) {
  const drive_state* s = &self->state;
  if (reference == 0) return s->now_s;
  if (reference < DRIVE_SIGNALS) return self->variables.factors[reference] * sixstep_value(s->session, (int)reference);
  if (reference >= DRIVE_USES_TICKS && reference <= DRIVE_USES_HALL) return s->uses[reference - DRIVE_USES_TICKS];
  if (reference < DRIVE_FIRST_SET) return s->wanted[reference - DRIVE_FIRST_INPUT];
  if (reference < DRIVE_FIRST_MEASURED) return s->set[reference - DRIVE_FIRST_SET];
  if (reference < DRIVE_FIRST_COUNT) return s->measured[reference - DRIVE_FIRST_MEASURED];
  return s->counts[reference - DRIVE_FIRST_COUNT];
}

static int has_kind(const drive* self, unsigned reference, drive_kind kind) {
  return reference < DRIVE_REFERENCES && kind != DRIVE_NONE && self->variables.kinds[reference] == kind;
}

drive_result drive_get(drive* self, const char* function, unsigned reference, drive_kind kind, double* values) {
  char text[96];
  int n;
  if (!has_kind(self, reference, kind)) {
    snprintf(text, sizeof text, "no variable of this type has the value reference %u", reference);
    return drive_fail(self, function, text);
  }
  for (n = 0; n < drive_size(self, reference); ++n) values[n] = value_of(self, reference + (unsigned)n);
  return DRIVE_OK;
}

drive_result drive_set(drive* self, const char* function, unsigned reference, drive_kind kind, const double* values) {
  char text[96];
  int n;
  const char* limit = NULL;
  if (!has_kind(self, reference, kind) || reference < DRIVE_FIRST_INPUT || reference >= DRIVE_FIRST_MEASURED) {
    snprintf(text, sizeof text, "no input of this type has the value reference %u", reference);
    return drive_fail(self, function, text);
  }
  for (n = 0; n < drive_size(self, reference) && !limit; ++n)
    limit = isfinite(values[n]) ? plant_limit(reference + (unsigned)n, values[n]) : "an input must be a finite number";
  if (reference >= DRIVE_USES_TICKS && reference <= DRIVE_USES_HALL && !(self->state.phase & (DRIVE_INSTANTIATED | DRIVE_INITIALIZATION)))
    limit = "a parameter can be set only before the initialization ends";
  if (limit) return drive_fail(self, function, limit);
  if (reference >= DRIVE_USES_TICKS && reference <= DRIVE_USES_HALL)
    self->state.uses[reference - DRIVE_USES_TICKS] = values[0];
  else if (reference < DRIVE_FIRST_SET)
    self->state.wanted[reference - DRIVE_FIRST_INPUT] = values[0];
  else
    memcpy(self->state.set + (reference - DRIVE_FIRST_SET), values, sizeof *values * (size_t)drive_size(self, reference));
  return DRIVE_OK;
}
