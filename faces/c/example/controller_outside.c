/* SPDX-License-Identifier: Apache-2.0 */
/* The program is the controller: at each control tick it reads the measurement and answers with a driven pair and
 * its duty. A proportional controller follows the current setpoint of the scenario.
 *   cc controller_outside.c $(pkg-config --cflags --libs sixstep) -o controller_outside && ./controller_outside SCENARIO */
#include <sixstep.h>
#include <stdio.h>

/* Driven pair for torque in the positive direction. Index: Hall code H1 H2 H3; codes 0 and 7 do not occur. */
static const uint8_t source[8] = {0, 2, 1, 1, 0, 2, 0, 0}, sink[8] = {0, 0, 2, 0, 1, 1, 2, 0};

static void control(const sixstep_measured* seen, double setpoint_A, sixstep_answer* answer) {
  const uint8_t code = seen->hall & 7, from = source[code], to = sink[code];
  const double current_A = (seen->current_A[from] - seen->current_A[to]) / 2;
  const double duty = 0.5 * (setpoint_A - current_A); /* negative: torque in the negative direction */
  answer->enabled = from != to;
  answer->source = duty < 0 ? to : from;
  answer->sink = duty < 0 ? from : to;
  answer->chopping = SIXSTEP_SOFT;
  answer->duty = duty < -1 || duty > 1 ? 1 : duty < 0 ? -duty : duty;
}

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  sixstep_options options = SIXSTEP_OPTIONS;
  options.chip = SIXSTEP_CHIP_PAIR;
  sixstep_session* drive;
  sixstep_problem problem;
  if (sixstep_open_file(argv[1], &options, &drive) != SIXSTEP_OK) {
    if (sixstep_problem_at(drive, 0, &problem) == SIXSTEP_OK) fprintf(stderr, "%s %s\n", problem.place, problem.limit);
    sixstep_free(drive);
    return 2;
  }

  sixstep_measured measured;
  double setpoint_A;
  sixstep_answer answer = {0};
  do {
    if (sixstep_measure(drive, &measured, &setpoint_A) == SIXSTEP_OK) {
      control(&measured, setpoint_A, &answer);
      sixstep_command(drive, &answer);
    }
  } while (sixstep_advance_to_tick(drive) == SIXSTEP_OK);

  sixstep_finish(drive);
  fputs(sixstep_outcome(drive), stdout);
  sixstep_free(drive);
  return 0;
}
