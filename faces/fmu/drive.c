/* SPDX-License-Identifier: Apache-2.0 */
#include "faces/fmu/drive.h"

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

/* Logs the problems of the session's last call. */
static drive_result refused(drive* self, const char* function, const sixstep_session* session) {
  char text[DRIVE_MESSAGE];
  sixstep_problem p;
  size_t n = 0;
  for (; sixstep_problem_at(session, n, &p) == SIXSTEP_OK; ++n) {
    snprintf(text, sizeof text, "%.200s%s%.100s %.300s; %.280s", p.place, *p.value ? " = " : "", p.value, p.limit, p.cure);
    drive_fail(self, function, text);
  }
  return n ? DRIVE_ERROR : drive_fail(self, function, "memory ended");
}

/* snprintf() writes the locale's point. */
void drive_number(char* text, size_t room, double value) {
  char raw[64];
  size_t out = 0, in = 0;
  snprintf(raw, sizeof raw, "%.17g", value);
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
  memcpy(self->state.wanted, self->variables.starts, sizeof self->state.wanted);
  memcpy(self->state.applied, self->variables.starts, sizeof self->state.applied);
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

/* Only a longer run is requested: a shorter one would be another scenario, without advantage. */
static drive_result lengthen(drive* self) {
  char setting[64] = "duration_s=";
  const char* settings[2] = {setting, NULL};
  sixstep_options options = SIXSTEP_OPTIONS;
  sixstep_session* longer = NULL;
  const double wanted_s = self->state.stop_s - self->state.start_s;
  if (!(wanted_s > sixstep_duration(self->state.session))) return DRIVE_OK;
  drive_number(setting + strlen(setting), sizeof setting - strlen(setting), wanted_s);
  options.settings = settings;
  if (sixstep_open_file(self->scenario, &options, &longer) != SIXSTEP_OK) {
    refused(self, "stop time", longer);
    sixstep_free(longer);
    return DRIVE_ERROR;
  }
  close_session(&self->state);
  self->state.session = longer;
  return DRIVE_OK;
}

drive_result drive_initialize(drive* self) {
  sixstep_session* session = NULL;
  if (sixstep_open_file(self->scenario, NULL, &session) != SIXSTEP_OK) {
    refused(self, "initialization", session);
    sixstep_free(session);
    return DRIVE_ERROR;
  }
  self->state.session = session;
  if (lengthen(self) != DRIVE_OK) {
    close_session(&self->state);
    return DRIVE_ERROR;
  }
  self->state.phase = DRIVE_INITIALIZATION;
  return DRIVE_OK;
}

/* No control tick is left in the run for the change: it has no effect. */
static int is_too_late(const sixstep_session* session) {
  sixstep_problem p;
  return sixstep_problem_at(session, 0, &p) == SIXSTEP_OK && strcmp(p.place, "time_s") == 0;
}

static drive_result change_inputs(drive* self, const char* function) {
  char toml[DRIVE_INPUTS * 128] = "", number[64], event[DRIVE_MESSAGE];
  double at_s = 0.0;
  size_t used = 0;
  int n;
  for (n = 0; n < self->variables.inputs; ++n) {
    if (self->state.wanted[n] == self->state.applied[n]) continue;
    drive_number(number, sizeof number, self->state.wanted[n]);
    used += (size_t)snprintf(toml + used, sizeof toml - used, "%s = %s\n", self->variables.keys[n], number);
  }
  if (!used) return DRIVE_OK;
  switch (sixstep_change(self->state.session, toml, &at_s)) {
    case SIXSTEP_OK: break;
    case SIXSTEP_REFUSED:
      if (is_too_late(self->state.session)) return DRIVE_OK;
    /* fall through */
    default: return refused(self, function, self->state.session);
  }
  memcpy(self->state.applied, self->state.wanted, sizeof self->state.applied);
  drive_number(number, sizeof number, at_s);
  snprintf(event, sizeof event, "inputs change at %.60s s of the run: %.800s", number, toml);
  self->log(self, DRIVE_OK, "logEvents", event);
  return DRIVE_OK;
}

static drive_result stop_early(drive* self, const char* function, double asked_s) {
  char text[DRIVE_MESSAGE], at[64], asked[64];
  sixstep_problem fault;
  drive_number(at, sizeof at, self->state.now_s);
  drive_number(asked, sizeof asked, asked_s);
  if (sixstep_problem_at(self->state.session, 0, &fault) == SIXSTEP_OK)
    snprintf(text, sizeof text, "%s: a fault stopped the run before %s s: %.200s %.200s %.200s; %.200s", function, asked,
             fault.place, fault.value, fault.limit, fault.cure);
  else
    snprintf(text, sizeof text,
             "%s: the run is over at %s s, before %s s: its duration has passed; name a later stop time at the set-up",
             function, at, asked);
  self->state.phase = DRIVE_STEP_FAILED;
  self->log(self, DRIVE_DISCARD, "logStatusDiscard", text);
  return DRIVE_DISCARD;
}

drive_result drive_step(drive* self, const char* function, double point, double size) {
  drive_state* s = &self->state;
  double next;
  if (!(size > 0) || !isfinite(size)) return drive_fail(self, function, "the step size must be above 0");
  /* A picosecond is the library's resolution. Importers that add up steps deviate by more than that. */
  if (!(fabs(point - s->now_s) <= 1e-9 * (1 + fabs(s->now_s))))
    return drive_fail(self, function, "the communication point must be the end of the step before");
  if (change_inputs(self, function) != DRIVE_OK) return DRIVE_ERROR;
  next = point + size;
  switch (sixstep_advance(s->session, next - s->start_s)) {
    case SIXSTEP_OK: break;
    case SIXSTEP_OVER:
      s->now_s = s->start_s + sixstep_time(s->session);
      if (s->now_s < next - 1e-12 * (1 + fabs(next))) return stop_early(self, function, next);
      break;
    default: return refused(self, function, s->session);
  }
  s->now_s = next;
  return DRIVE_OK;
}

/* A copy is finished, so that the session can still be saved. */
drive_result drive_terminate(drive* self) {
  sixstep_session* end = NULL;
  drive_result result = DRIVE_OK;
  if (sixstep_copy(self->state.session, &end) != SIXSTEP_OK) return drive_fail(self, "terminate", "memory ended");
  if (sixstep_finish(end) == SIXSTEP_OK)
    snprintf(self->state.digest, sizeof self->state.digest, "%016llx", (unsigned long long)sixstep_digest(end));
  else
    result = refused(self, "terminate", end);
  sixstep_free(end);
  self->state.phase = DRIVE_TERMINATED;
  return result;
}

drive_result drive_get(drive* self, const char* function, unsigned reference, drive_kind kind, double* value) {
  char text[96];
  const drive_variables* v = &self->variables;
  const unsigned input = reference - DRIVE_FIRST_INPUT;
  if (reference == 0 && kind == DRIVE_REAL) {
    *value = self->state.now_s;
  } else if (reference < DRIVE_SIGNALS && v->kinds[reference] == kind && kind != DRIVE_NONE) {
    *value = v->factors[reference] * sixstep_value(self->state.session, (int)reference);
  } else if (kind == DRIVE_REAL && reference >= DRIVE_FIRST_INPUT && input < (unsigned)v->inputs) {
    *value = self->state.wanted[input];
  } else {
    snprintf(text, sizeof text, "%u is no reference of a variable of this type", reference);
    return drive_fail(self, function, text);
  }
  return DRIVE_OK;
}

drive_result drive_set(drive* self, const char* function, unsigned reference, double value) {
  char text[96];
  const unsigned input = reference - DRIVE_FIRST_INPUT;
  if (reference < DRIVE_FIRST_INPUT || input >= (unsigned)self->variables.inputs) {
    snprintf(text, sizeof text, "%u is no reference of an input", reference);
    return drive_fail(self, function, text);
  }
  if (!isfinite(value)) return drive_fail(self, function, "an input must be a finite number");
  self->state.wanted[input] = value;
  return DRIVE_OK;
}
