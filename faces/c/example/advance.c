/* SPDX-License-Identifier: Apache-2.0 */
/* Runs a scenario in steps of 1 ms, prints speed and current at each, and at last the outcome as JSON.
 *   cc advance.c $(pkg-config --cflags --libs sixstep) -o advance && ./advance SCENARIO */
#include <sixstep.h>
#include <stdio.h>

static int refused(sixstep_session* drive) {
  sixstep_problem p;
  for (size_t k = 0; sixstep_problem_at(drive, k, &p) == SIXSTEP_OK; ++k)
    fprintf(stderr, "%s: %s %s; %s\n", p.place, p.value, p.limit, p.cure);
  sixstep_free(drive);
  return 2;
}

int main(int argc, char** argv) {
  if (argc != 2 || sixstep_abi() != SIXSTEP_ABI) return 2;
  sixstep_session* drive;
  if (sixstep_open_file(argv[1], NULL, &drive) != SIXSTEP_OK) return refused(drive);

  const int speed = sixstep_signal_index("speed_rad_s"), current = sixstep_signal_index("i_m_A");
  for (int ms = 1; sixstep_advance(drive, 1e-3 * ms) == SIXSTEP_OK; ++ms)
    printf("%.3f ms  %.4f rad/s  %.4f A\n", 1e3 * sixstep_time(drive), sixstep_value(drive, speed), sixstep_value(drive, current));

  if (sixstep_finish(drive) != SIXSTEP_OK) return refused(drive);
  fputs(sixstep_outcome(drive), stdout);
  sixstep_free(drive);
  return 0;
}
