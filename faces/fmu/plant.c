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

/* An input by its reference. */
static double input(const double* set, unsigned reference) { return set[reference - DRIVE_FIRST_SET]; }
static uint8_t byte(const double* set, unsigned reference) { return (uint8_t)input(set, reference); }

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

/* At a control tick the library measures only if the run was advanced to the tick itself. */
static sixstep_status advance(const drive_variables* variables, sixstep_session* run, double to_s) {
  const double near_s = plant_near(run), tick_s = sixstep_tick_after(run, to_s - near_s);
  sixstep_status status = SIXSTEP_OK;
  if (variables->chip != SIXSTEP_CHIP_PAIR && variables->chip != SIXSTEP_CHIP_LEGS) return sixstep_advance(run, to_s);
  if (!(tick_s <= to_s + near_s)) return sixstep_advance(run, to_s);
  if (sixstep_tick_after(run, sixstep_time(run)) < tick_s) status = sixstep_advance(run, tick_s - sixstep_period(run) / 2);
  return status == SIXSTEP_OK ? sixstep_advance_to_tick(run) : status;
}

/* Hall edges are searched up to a picosecond before the end, which may be a tick. */
sixstep_status plant_advance_to_event(const drive_variables* variables, drive_state* state, double to_s, unsigned stops,
                                      unsigned* events) {
  sixstep_session* const run = state->session;
  const int hall = sixstep_signal_index("hall");
  const double code = sixstep_value(run, hall), tick_s = sixstep_tick_after(run, sixstep_time(run));
  const int to_tick = (stops & DRIVE_TICK) && tick_s <= to_s + plant_near(run);
  const double end_s = to_tick ? tick_s : to_s, before_s = end_s - 1e-12;
  sixstep_status status = SIXSTEP_OK;
  *events = 0;
  if ((stops & DRIVE_HALL) && before_s > sixstep_time(run)) {
    status = sixstep_advance_to_hall_edge(run, before_s);
    if (status == SIXSTEP_OK && sixstep_value(run, hall) != code) *events = DRIVE_HALL;
    if (status != SIXSTEP_OK || *events) return status;
  }
  status = advance(variables, run, end_s);
  if ((stops & DRIVE_HALL) && sixstep_value(run, hall) != code) *events |= DRIVE_HALL;
  if (to_tick) *events |= DRIVE_TICK;
  return status;
}

static void look_at_measured(drive_state* state) {
  double* const to = state->measured;
  sixstep_measured seen;
  double setpoint;
  unsigned k;
  if (sixstep_measure(state->session, &seen, &setpoint) != SIXSTEP_OK) return; /* between two ticks */
  for (k = 0; k < 3; ++k) to[k] = seen.current_A[k];
  to[3] = seen.speed_rad_s;
  to[4] = seen.position_deg;
  to[5] = seen.bus_V;
  to[6] = seen.magnet_cos;
  to[7] = seen.magnet_sin;
  to[8] = seen.hall;
  to[9] = setpoint;
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
  if (variables->chip != SIXSTEP_CHIP_GATES) look_at_measured(state);
  look_at_counts(variables, state);
}
