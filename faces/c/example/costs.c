/* SPDX-License-Identifier: Apache-2.0 */
/* Measures the time of calls on this machine. The first opening in the process is measured once. For every other
 * call, the best of seven measurements counts.
 *   cc -O2 costs.c $(pkg-config --cflags --libs sixstep) -o costs && ./costs SCENARIO */
#define _POSIX_C_SOURCE 199309L
#include <sixstep.h>
#include <stdio.h>
#include <time.h>

static double now_us(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

enum { FIRST, OPEN, VALUE, PERIOD, ONE_GO, CHANGE, COPY, SAVE, LOAD, CALLS };
static const char* const name[CALLS] = {"open the first file", "open a file",       "read a value", "advance by a period", "a period of one long advance",
                                        "change the supply",   "copy",              "save",         "load"};

int main(int argc, char** argv) {
  double best_us[CALLS], volatile_sum = 0;
  for (int k = 0; k < CALLS; ++k) best_us[k] = 1e300;
  for (int round = 0; argc == 2 && round < 7; ++round) {
    double us[CALLS], begin = now_us();
    static char bytes[1 << 20];
    sixstep_session *drive, *copy, *loaded, *other;
    if (sixstep_open_file(argv[1], NULL, &drive) != SIXSTEP_OK) return 2;
    us[FIRST] = us[OPEN] = now_us() - begin;
    const int signal = sixstep_signal_index("i_a_A");
    begin = now_us();
    for (int k = 0; k < 100000; ++k) volatile_sum += sixstep_value(drive, signal);
    us[VALUE] = (now_us() - begin) / 100000;
    const double period_s = sixstep_period(drive);
    begin = now_us();
    for (int k = 1; k <= 200; ++k) sixstep_advance(drive, k * period_s);
    us[PERIOD] = (now_us() - begin) / 200;
    if (sixstep_open_file(argv[1], NULL, &other) != SIXSTEP_OK) return 2;
    begin = now_us(), sixstep_advance(other, 200 * period_s), us[ONE_GO] = (now_us() - begin) / 200;
    begin = now_us(), sixstep_change(drive, "supply.voltage_V = 20", NULL), us[CHANGE] = now_us() - begin;
    begin = now_us(), sixstep_copy(drive, &copy), us[COPY] = now_us() - begin;
    size_t size;
    begin = now_us(), size = sixstep_save(drive, bytes, sizeof bytes), us[SAVE] = now_us() - begin;
    begin = now_us(), sixstep_load(bytes, size, &loaded), us[LOAD] = now_us() - begin;
    for (int k = 0; k < CALLS; ++k)
      if (k == FIRST ? round == 0 : us[k] < best_us[k]) best_us[k] = us[k];
    sixstep_free(drive), sixstep_free(copy), sixstep_free(loaded), sixstep_free(other);
  }
  for (int k = 0; argc == 2 && k < CALLS; ++k) printf("%-30s%10.3f us\n", name[k], best_us[k]);
  return argc == 2 && volatile_sum == volatile_sum ? 0 : 2;
}
