/* SPDX-License-Identifier: Apache-2.0 */
/* Steps of FMI 3.0: early return, intermediate update, and event mode with two output clocks, at control ticks and
 * at Hall edges. Events are located whether an importer requests them or not, so requests do not change a bit of the
 * run. */
#include <math.h>

#include "faces/fmu/fmi3_instance.h"
#include "faces/fmu/plant.h"

typedef fmi3_instance instance;

static unsigned stops_of(const instance* i) {
  const double* const uses = i->unit.state.uses;
  if (!i->event_mode && !i->update) return 0;
  return (uses[0] != 0 ? DRIVE_TICK : 0u) | (uses[1] != 0 ? DRIVE_HALL : 0u);
}

/* The first control tick at or after the present instant, in the importer's time. */
static double tick_from(const drive_state* s, double now_s) {
  return s->start_s + sixstep_tick_after(s->session, now_s - s->start_s);
}

FMI3_FUNCTION(ExitInitializationMode, (fmi3Instance c)) {
  instance* const i = c;
  drive_state* s;
  if (!fmi3_may(c, "fmi3ExitInitializationMode", DRIVE_INITIALIZATION)) return fmi3Error;
  s = &i->unit.state;
  s->phase = i->event_mode ? DRIVE_EVENT : DRIVE_STEP_COMPLETE;
  if (i->event_mode && s->uses[0] != 0 && tick_from(s, s->now_s - 1e-12) <= s->now_s) s->active = DRIVE_TICK;
  return fmi3OK;
}

FMI3_FUNCTION(EnterEventMode, (fmi3Instance c)) {
  if (!fmi3_may(c, "fmi3EnterEventMode", DRIVE_STEP_COMPLETE)) return fmi3Error;
  if (!((instance*)c)->event_mode)
    return fmi3_fail(c, "fmi3EnterEventMode", "the instance was made without event mode (eventModeUsed)");
  ((instance*)c)->unit.state.phase = DRIVE_EVENT;
  return fmi3OK;
}

FMI3_FUNCTION(EnterStepMode, (fmi3Instance c)) {
  if (!fmi3_may(c, "fmi3EnterStepMode", DRIVE_EVENT)) return fmi3Error;
  ((instance*)c)->unit.state.phase = DRIVE_STEP_COMPLETE;
  return fmi3OK;
}

FMI3_FUNCTION(UpdateDiscreteStates,
              (fmi3Instance c, fmi3Boolean* more, fmi3Boolean* end, fmi3Boolean* nominals, fmi3Boolean* values,
               fmi3Boolean* timed, fmi3Float64* time)) {
  drive_state* s;
  if (!fmi3_may(c, "fmi3UpdateDiscreteStates", DRIVE_EVENT)) return fmi3Error;
  if (!more || !end || !nominals || !values || !timed || !time)
    return fmi3_fail(c, "fmi3UpdateDiscreteStates", "a pointer to a result is null");
  s = &((instance*)c)->unit.state;
  s->active = 0;
  *more = *end = *nominals = *values = false;
  *timed = s->uses[0] != 0;
  *time = *timed ? tick_from(s, s->now_s + plant_near(s->session)) : 0.0;
  return fmi3OK;
}

FMI3_FUNCTION(GetClock, (fmi3Instance c, const fmi3ValueReference r[], size_t count, fmi3Clock values[])) {
  size_t n;
  if (!fmi3_may(c, "fmi3GetClock", DRIVE_EVENT)) return fmi3Error;
  if (count && (!r || !values)) return fmi3_fail(c, "fmi3GetClock", "the references or the values are null");
  for (n = 0; n < count; ++n) {
    if (r[n] != DRIVE_TICK_CLOCK && r[n] != DRIVE_HALL_CLOCK)
      return fmi3_fail(c, "fmi3GetClock", "no clock has this value reference");
    values[n] = (((instance*)c)->unit.state.active & (r[n] == DRIVE_TICK_CLOCK ? DRIVE_TICK : DRIVE_HALL)) != 0;
  }
  return fmi3OK;
}

/* Calls the importer at an event within a step. Returns whether the importer requests a return from the step; *to is
   then the requested instant. */
static int update_asks_to_return(instance* i, double* to) {
  drive_state* const s = &i->unit.state;
  fmi3Boolean asked = false;
  fmi3Float64 at = s->now_s;
  if (!i->update) return 0;
  s->phase = DRIVE_INTERMEDIATE;
  i->update(i->environment, s->now_s, false, true, true, i->early_return, &asked, &at);
  s->phase = DRIVE_STEP_COMPLETE;
  if (!asked || !i->early_return) return 0;
  *to = at > s->now_s && at < *to ? at : at > s->now_s ? *to : s->now_s; /* NaN: the present instant */
  return 1;
}

/* Advances from event to event up to `to`. *needed: whether a clock ticks at the reached instant. */
static drive_result step_to(instance* i, double to, fmi3Boolean* needed) {
  drive_state* const s = &i->unit.state;
  const unsigned stops = stops_of(i);
  unsigned events;
  for (;;) {
    const drive_result result = drive_go_on(&i->unit, "fmi3DoStep", to, stops, &events);
    if (result != DRIVE_OK) return result;
    s->active = i->event_mode ? events : 0;
    *needed = s->active != 0;
    if (s->now_s >= to) return DRIVE_OK;
    if (events && update_asks_to_return(i, &to) && s->now_s >= to) return DRIVE_OK;
    if (*needed && i->early_return) return DRIVE_OK;
  }
}

FMI3_FUNCTION(DoStep, (fmi3Instance c, fmi3Float64 point, fmi3Float64 size, fmi3Boolean noStateBefore,
                       fmi3Boolean* eventHandlingNeeded, fmi3Boolean* terminateSimulation, fmi3Boolean* earlyReturn,
                       fmi3Float64* lastSuccessfulTime)) {
  instance* const i = c;
  drive_result result;
  (void)noStateBefore;
  if (!fmi3_may(c, "fmi3DoStep", DRIVE_STEP_COMPLETE)) return fmi3Error;
  if (!eventHandlingNeeded || !terminateSimulation || !earlyReturn || !lastSuccessfulTime)
    return fmi3_fail(c, "fmi3DoStep", "a pointer to a result is null");
  *eventHandlingNeeded = *earlyReturn = *terminateSimulation = false;
  *lastSuccessfulTime = i->unit.state.now_s;
  result = drive_begin_step(c, "fmi3DoStep", point, size);
  if (result == DRIVE_OK) result = step_to(i, point + size, eventHandlingNeeded);
  *lastSuccessfulTime = i->unit.state.now_s;
  if (result == DRIVE_ERROR) return fmi3Error;
  if (result == DRIVE_OK) plant_look(&i->unit.variables, &i->unit.state);
  *terminateSimulation = result == DRIVE_DISCARD;
  if (*terminateSimulation) *eventHandlingNeeded = false;
  *earlyReturn = i->early_return && i->unit.state.now_s < point + size;
  return fmi3OK;
}
