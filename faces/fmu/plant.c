/* SPDX-License-Identifier: Apache-2.0 */
#include "faces/fmu/plant.h"

#include <math.h>
#include <string.h>

static int is_of(unsigned reference, unsigned first, unsigned count) {
  return reference >= first && reference < first + count;
}

static const char* whole(double value, double most, const char* limit) {
  return value >= 0 && value <= most && value == floor(value) ? NULL : limit;
}

const char* plant_limit(unsigned reference, double value) {
  if (reference < DRIVE_FIRST_SET) return NULL;
  if (reference == PLANT_SOURCE || reference == PLANT_SINK) return whole(value, 2, "a leg must be 0, 1 or 2");
  if (reference == PLANT_CHOPPING) return whole(value, 2, "chopping must be 0 (soft), 1 (hard) or 2 (complementary)");
  if (reference == PLANT_CHOPPED) return whole(value, 1, "the chopped switch must be 0 (upper) or 1 (lower)");
  if (is_of(reference, PLANT_LEG_STATES, 3)) return whole(value, 3, "the state of a leg must be 0 to 3");
  if (is_of(reference, PLANT_LEG_SWITCHES, 3)) return whole(value, 3, "the switches of a leg must be 0 to 3");
  if (reference == PLANT_OVERLAP) return fabs(value) <= 1 ? NULL : "the overlap must be -1 to 1";
  if (reference == PLANT_DUTY || is_of(reference, PLANT_LEG_DUTIES, 3))
    return value >= 0 && value <= 1 ? NULL : "a duty must be 0 to 1";
  return NULL;
}

static uint32_t gates_of(const double* set) {
  uint32_t gates = 0;
  unsigned k;
  for (k = 0; k < 6; ++k)
    if (set[k] != 0) gates |= 1u << k;
  return gates;
}

/* The value of an input, by its reference. */
static double input(const double* set, unsigned reference) { return set[reference - DRIVE_FIRST_SET]; }
static uint8_t byte(const double* set, unsigned reference) { return (uint8_t)input(set, reference); }

void plant_start(const drive_variables* variables, drive_state* state) {
  if (variables->chip == SIXSTEP_CHIP_PAIR) state->set[PLANT_SINK - DRIVE_FIRST_SET] = 1;
  memcpy(state->set_applied, state->set, sizeof state->set);
}

const char* plant_wrong_pair(const drive_variables* variables, const drive_state* state) {
  const double* const set = state->set;
  if (variables->chip != SIXSTEP_CHIP_PAIR || !byte(set, PLANT_PAIR_ENABLED)) return NULL;
  return byte(set, PLANT_SOURCE) != byte(set, PLANT_SINK)
             ? NULL
             : "the inputs source and sink are the same leg; set two different legs while enabled is true";
}

static sixstep_answer answer_of(sixstep_chip chip, const double* set) {
  sixstep_answer answer;
  unsigned k;
  memset(&answer, 0, sizeof answer);
  if (chip == SIXSTEP_CHIP_PAIR) {
    answer.enabled = byte(set, PLANT_PAIR_ENABLED);
    answer.source = byte(set, PLANT_SOURCE);
    answer.sink = byte(set, PLANT_SINK);
    answer.chopping = byte(set, PLANT_CHOPPING);
    answer.chopped = byte(set, PLANT_CHOPPED);
    answer.duty = input(set, PLANT_DUTY);
    answer.overlap = input(set, PLANT_OVERLAP);
    return answer;
  }
  answer.enabled = byte(set, PLANT_LEGS_ENABLED);
  for (k = 0; k < 3; ++k) {
    answer.leg[k].state = byte(set, PLANT_LEG_STATES + k);
    answer.leg[k].switches = byte(set, PLANT_LEG_SWITCHES + k);
    answer.leg[k].duty = input(set, PLANT_LEG_DUTIES + k);
  }
  return answer;
}

sixstep_status plant_apply(const drive_variables* variables, drive_state* state) {
  sixstep_answer answer;
  sixstep_status status;
  /* The bytes are compared. 0 and -0 count as different values, and setting an equal value again changes nothing. */
  /* NOLINTNEXTLINE(bugprone-suspicious-memory-comparison) */
  if (variables->chip == SIXSTEP_CHIP_OF_SCENARIO || memcmp(state->set, state->set_applied, sizeof state->set) == 0)
    return SIXSTEP_OK;
  if (variables->chip == SIXSTEP_CHIP_GATES) {
    status = sixstep_set_gates(state->session, gates_of(state->set));
  } else {
    answer = answer_of(variables->chip, state->set);
    status = sixstep_command(state->session, &answer);
  }
  if (status == SIXSTEP_OK) memcpy(state->set_applied, state->set, sizeof state->set);
  return status;
}

double plant_near(const sixstep_session* session) {
  const double period_s = sixstep_period(session);
  return period_s < 1e-6 ? period_s / 1000 : 1e-9;
}

static int has_caller(const drive_variables* variables) {
  return variables->chip == SIXSTEP_CHIP_PAIR || variables->chip == SIXSTEP_CHIP_LEGS;
}

/* Between two ticks, and if no external controller exists, the library refuses to measure. The values of the last
   tick then remain. */
void plant_measure(const drive_variables* variables, drive_state* state) {
  double* const to = state->measured;
  sixstep_measured seen;
  double setpoint;
  unsigned k;
  if (!has_caller(variables) || sixstep_measure(state->session, &seen, &setpoint) != SIXSTEP_OK) return;
  for (k = 0; k < 3; ++k) to[k] = seen.current_A[k];
  to[3] = seen.speed_rad_s;
  to[4] = seen.position_deg;
  to[5] = seen.bus_V;
  to[6] = seen.magnet_cos;
  to[7] = seen.magnet_sin;
  to[8] = seen.hall;
  to[9] = setpoint;
}

/* The last control tick at or before an instant of the run, or within plant_near() after it. NaN: no tick after the
   present instant. */
static double last_tick(const sixstep_session* run, double to_s) {
  const double near_s = plant_near(run), now_s = sixstep_time(run);
  double tick_s = sixstep_tick_after(run, fmax(now_s, to_s - 1.5 * sixstep_period(run))), next_s;
  if (!(tick_s <= to_s + near_s)) return NAN;
  while ((next_s = sixstep_tick_after(run, tick_s + near_s)) <= to_s + near_s) tick_s = next_s;
  return tick_s;
}

/* The library measures only at a control tick, and only if the run was advanced to the tick itself. */
static sixstep_status advance(const drive_variables* variables, drive_state* state, double to_s) {
  sixstep_session* const run = state->session;
  const double tick_s = has_caller(variables) ? last_tick(run, to_s) : NAN;
  sixstep_status status = SIXSTEP_OK;
  if (isnan(tick_s)) return sixstep_advance(run, to_s);
  if (sixstep_tick_after(run, sixstep_time(run)) < tick_s) status = sixstep_advance(run, tick_s - sixstep_period(run) / 2);
  if (status == SIXSTEP_OK) status = sixstep_advance_to_tick(run);
  /* A tick may be at the run's end. After a fault, plant_measure() is not called, so that the session's problem
     remains. */
  if (status == SIXSTEP_OK || sixstep_time(run) >= to_s - 1e-12) plant_measure(variables, state);
  return status == SIXSTEP_OK && tick_s < to_s - plant_near(run) ? sixstep_advance(run, to_s) : status;
}

/* Whether a Hall edge occurs before an instant. The instant may be a tick, so the search ends a picosecond earlier. */
static sixstep_status advance_to_edge(sixstep_session* run, double end_s, int* found) {
  const int hall = sixstep_signal_index("hall");
  const double code = sixstep_value(run, hall), before_s = end_s - 1e-12;
  sixstep_status status = SIXSTEP_OK;
  if (before_s > sixstep_time(run)) status = sixstep_advance_to_hall_edge(run, before_s);
  *found = status == SIXSTEP_OK && sixstep_value(run, hall) != code;
  return status;
}

sixstep_status plant_advance_to_event(const drive_variables* variables, drive_state* state, double to_s, unsigned stops,
                                      unsigned* events) {
  sixstep_session* const run = state->session;
  const int hall = sixstep_signal_index("hall");
  const double code = sixstep_value(run, hall), near_s = plant_near(run);
  const unsigned edges = stops & DRIVE_HALL, ticks = stops & DRIVE_TICK;
  sixstep_status status = SIXSTEP_OK;
  int is_tick, found = 0;
  *events = 0;
  do { /* from tick to tick: an external controller must measure at each tick before the edge */
    const double tick_s = sixstep_tick_after(run, sixstep_time(run));
    is_tick = (ticks || (edges && has_caller(variables))) && tick_s <= to_s + near_s;
    if (edges) status = advance_to_edge(run, is_tick ? tick_s : to_s, &found);
    if (status == SIXSTEP_OK && !found) {
      status = advance(variables, state, is_tick ? tick_s : to_s);
      if (is_tick) *events |= ticks;
    }
    if (edges && sixstep_value(run, hall) != code) *events |= DRIVE_HALL;
  } while (status == SIXSTEP_OK && is_tick && !*events && sixstep_time(run) < to_s - near_s);
  return status;
}

static void look_at_counts(const drive_variables* variables, drive_state* state) {
  double* const to = state->counts;
  sixstep_counts counts;
  const unsigned first = DRIVE_FIRST_COUNT, encoder = PLANT_ENCODER_COUNT;
  unsigned k;
  if (variables->kinds[encoder])
    to[encoder - first] =
        floor(variables->factors[encoder] * sixstep_value(state->session, sixstep_signal_index("angle_rad")));
  if (!variables->kinds[first] && !variables->kinds[first + 3]) return;
  if (sixstep_convert(state->session, &counts) != SIXSTEP_OK) return;
  for (k = 0; k < 3; ++k) {
    to[k] = counts.current[k];
    to[3 + k] = counts.terminal[k];
  }
  to[6] = counts.bus;
}

void plant_look(const drive_variables* variables, drive_state* state) {
  if (variables->chip == SIXSTEP_CHIP_OF_SCENARIO) return;
  look_at_counts(variables, state);
}
