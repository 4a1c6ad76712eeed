/* SPDX-License-Identifier: Apache-2.0 */
/* Executes the steps of a unit: applies the inputs, then advances the run. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "faces/fmu/drive.h"
#include "faces/fmu/plant.h"

/* Whether the change was refused because no control tick is left in the run. It then has no effect. */
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
    default: return drive_refused(self, function, self->state.session);
  }
  memcpy(self->state.applied, self->state.wanted, sizeof self->state.applied);
  drive_number(number, sizeof number, at_s);
  snprintf(event, sizeof event, "inputs change at %.60s s of the run: %.800s", number, toml);
  self->log(self, DRIVE_OK, "logEvents", event);
  return DRIVE_OK;
}

/* Writes a number with at most nine digits, for messages. */
static void short_number(char* text, size_t room, double value) {
  char raw[64];
  double rounded;
  snprintf(raw, sizeof raw, "%.9g", value);
  rounded = strtod(raw, NULL);
  drive_number(text, room, rounded);
}

static drive_result stop_early(drive* self, const char* function, double asked_s) {
  char text[DRIVE_MESSAGE], at[64], asked[64];
  sixstep_problem fault;
  short_number(at, sizeof at, self->state.now_s);
  short_number(asked, sizeof asked, asked_s);
  if (sixstep_problem_at(self->state.session, 0, &fault) == SIXSTEP_OK)
    snprintf(text, sizeof text, "%s: a fault stopped the run at %s s, before %s s: %.200s%s%.300s; %.200s", function, at, asked,
             fault.value, *fault.value ? " " : "", fault.limit, fault.cure);
  else
    snprintf(text, sizeof text,
             "%s: the run ended at %s s, before %s s, because its duration has passed; set a later stop time before the initialization",
             function, at, asked);
  self->state.phase = DRIVE_STEP_FAILED;
  self->log(self, DRIVE_DISCARD, "logStatusDiscard", text);
  return DRIVE_DISCARD;
}

/* Applies the inputs at the present communication point. */
static drive_result apply_inputs(drive* self, const char* function) {
  const char* const wrong = plant_wrong_pair(&self->variables, &self->state);
  if (wrong) return drive_fail(self, function, wrong);
  if (change_inputs(self, function) != DRIVE_OK) return DRIVE_ERROR;
  switch (plant_apply(&self->variables, &self->state)) {
    case SIXSTEP_OK:
    case SIXSTEP_OVER: return DRIVE_OK; /* over: the advance reports the reason */
    default: return drive_refused(self, function, self->state.session);
  }
}

/* FMI: an importer that has set a stop time must not step beyond it. NaN: no stop time is set. */
static int is_past_stop(const drive_state* s, double to_s) { return to_s > s->stop_s + 1e-12 * (1 + fabs(s->stop_s)); }

static drive_result refuse_past_stop(drive* self, const char* function, double to_s) {
  char text[DRIVE_MESSAGE], to[64], stop[64];
  short_number(to, sizeof to, to_s);
  short_number(stop, sizeof stop, self->state.stop_s);
  snprintf(text, sizeof text, "the step ends at %s s, but the stop time is %s s; end the step there, or define no stop time",
           to, stop);
  return drive_fail(self, function, text);
}

drive_result drive_begin_step(drive* self, const char* function, double point, double size) {
  const double now_s = self->state.now_s;
  if (!(size > 0) || !isfinite(size)) return drive_fail(self, function, "the step size must be above 0");
  /* The library's resolution is 1 ps. Importers that add up step sizes deviate by more in the end. */
  if (!(fabs(point - now_s) <= 1e-9 * (1 + fabs(now_s))))
    return drive_fail(self, function, "the communication point must be the end of the previous step");
  if (is_past_stop(&self->state, point + size)) return refuse_past_stop(self, function, point + size);
  return apply_inputs(self, function);
}

drive_result drive_go_on(drive* self, const char* function, double to, unsigned stops, unsigned* events) {
  drive_state* s = &self->state;
  const double close_s = 1e-12 * (1 + fabs(to));
  switch (plant_advance_to_event(&self->variables, s, to - s->start_s, stops, events)) {
    case SIXSTEP_OK: s->now_s = *events ? s->start_s + sixstep_time(s->session) : to; break;
    case SIXSTEP_OVER:
      s->now_s = s->start_s + sixstep_time(s->session);
      if (s->now_s < to - close_s) return stop_early(self, function, to);
      break;
    default: return drive_refused(self, function, s->session);
  }
  if (s->now_s > to - plant_near(s->session)) s->now_s = to;
  return DRIVE_OK;
}

drive_result drive_step(drive* self, const char* function, double point, double size) {
  unsigned events;
  drive_result result = drive_begin_step(self, function, point, size);
  if (result == DRIVE_OK) result = drive_go_on(self, function, point + size, 0, &events);
  if (result == DRIVE_OK) plant_look(&self->variables, &self->state);
  return result;
}
