/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the firmware of esc.c on a simulated drone motor: start, full throttle, a clamped propeller, restart, stop.
 *   esc [STEP_S [LOG [SUPPLY_V]]]
 * STEP_S: longest step of a call of hal_run(), s. SUPPLY_V: bus voltage from 0.44 s on, V. */
#include <math.h>
#include <stdlib.h>

#include "hal.h"
#include "hal_sixstep.h"

static const char scenario[] =
    "motor = \"dji-2212-920kv\"\n"
    "duration_s = 1.01\n"
    "control.mode = \"duty\"\n"
    "pwm.period_s = 50e-6\n"
    "supply.voltage_V = 12\n"
    "bridge.on_resistance_ohm = 5e-3\n"
    "bridge.diode_drop_V = 0.7\n"
    "load.fan_Nm_s2 = 1.2e-7\n"
    "load.inertia_kg_m2 = 8e-6\n"
    "load.coulomb_Nm = 1e-3\n"
    "sensors.currents = \"phases\"\n"
    "sensors.current_range_A = 102.4\n"
    "sensors.current_noise_A = 0.05\n"
    "sensors.bus_range_V = 20.48\n";

static const struct {
  double at_s;
  int throttle;       /* throttle from this instant on, % */
  const char* change; /* change of the load, or null */
} course[] = {{0.01, 40, NULL},
              {0.36, 100, NULL},
              {0.50, 100, "load.locked = true"},
              {0.51, 100, "load.locked = false"},
              {0.94, 0, NULL}};
enum { STEPS = sizeof course / sizeof course[0] };

static sixstep_session* drive;

static double value(const char* name) { return sixstep_value(drive, sixstep_signal_index(name)); }

static void print_row(double at_s, int throttle) {
  static const char* const state[] = {"off", "align", "ramp", "run", "wait", "fault"};
  const esc_status* is = esc_look();
  const double a = fabs(value("i_a_A")), b = fabs(value("i_b_A")), c = fabs(value("i_c_A"));
  printf("%5.0f %8d %7.1f %7.2f   %-5s %12lu %6lu %7lu\n", 1e3 * at_s, throttle, value("speed_rad_s"),
         fmax(a, fmax(b, c)), state[is->state], (unsigned long)is->commutations, (unsigned long)is->missed,
         (unsigned long)is->desyncs);
}

static int fail(void) {
  sixstep_problem problem;
  size_t k;
  for (k = 0; sixstep_problem_at(drive, k, &problem) == SIXSTEP_OK; k++)
    fprintf(stderr, "%s = %s %s; %s\n", problem.place, problem.value, problem.limit, problem.cure);
  return 1;
}

/* Advances to an instant in steps of at most step_s. */
static void run(double from_s, double to_s, double step_s) {
  int n;
  for (n = 1; from_s + n * step_s < to_s; n++)
    if (hal_run(from_s + n * step_s) != SIXSTEP_OK) return;
  hal_run(to_s);
}

int main(int count, char** words) {
  const double row_s = 0.04, step_s = count > 1 ? atof(words[1]) : row_s;
  FILE* log = count > 2 ? fopen(words[2], "w") : NULL;
  sixstep_options options = SIXSTEP_OPTIONS;
  char supply[64];
  int row, next = 0, throttle = 0;
  options.chip = SIXSTEP_CHIP_GATES;
  if (sixstep_open_text(scenario, &options, &drive) != SIXSTEP_OK) return fail();
  hal_connect(drive, log);
  printf("%5s %8s %7s %7s   %-5s %12s %6s %7s\n", "ms", "throttle", "rad/s", "A", "state", "commutations", "missed",
         "desyncs");
  for (row = 1; row <= 25; row++) {
    double from_s = (row - 1) * row_s;
    for (; next < STEPS && course[next].at_s < row * row_s; next++) {
      run(from_s, course[next].at_s, step_s);
      from_s = course[next].at_s;
      throttle = course[next].throttle;
      hal_set_throttle((uint16_t)(throttle * 4095 / 100));
      if (course[next].change != NULL && sixstep_change(drive, course[next].change, NULL) != SIXSTEP_OK) return fail();
    }
    if (count > 3 && row == 12) {
      snprintf(supply, sizeof supply, "supply.voltage_V = %s", words[3]);
      if (sixstep_change(drive, supply, NULL) != SIXSTEP_OK) return fail();
    }
    run(from_s, row * row_s, step_s);
    print_row(row * row_s, throttle);
  }
  if (log != NULL) fclose(log);
  if (sixstep_finish(drive) != SIXSTEP_OK) return fail();
  printf("digest %016llx\n", (unsigned long long)sixstep_digest(drive));
  sixstep_free(drive);
  return 0;
}
