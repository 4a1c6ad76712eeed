/* SPDX-License-Identifier: Apache-2.0 */
/* Implements hal.h on libsixstep. Time is an integer in picoseconds. hal_run() advances from event to event: an edge
 * of the PWM timer, the end of a dead time, a compare match, a sample, a change of a comparator or of a Hall line.
 * At each event it calls the firmware and sets the resulting gates. An interrupt takes no time. */
#include "hal_sixstep.h"

#include "hal.h"

#define PWM_COUNT_PS 20000
#define COUNT_PS 500000
#define PERIOD_PS ((int64_t)HAL_PWM_TOP * PWM_COUNT_PS)
#define DEAD_PS ((int64_t)HAL_DEAD_COUNTS * PWM_COUNT_PS)
#define HOLD_PS 2000000     /* time for which a comparator's output is held after each change of a gate */
#define HYSTERESIS_V 0.02   /* of a comparator, to either side of zero */
#define NEVER INT64_MAX

static struct {
  sixstep_session* session;
  sixstep_status status;
  int u[3], e[3], hall_lines;   /* signals: voltages of the terminals, back-EMFs, Hall code */
  FILE* log;
  int64_t now, period;          /* present instant; beginning of the present PWM period */
  uint8_t leg[3];
  uint8_t wanted[3];            /* commanded switch of each leg: 0 none, 1 upper, 2 lower */
  int64_t since[3];             /* instant of the last change of `wanted` */
  uint32_t gates;
  int64_t changed;              /* last change of a gate */
  uint16_t compare, preload;
  int64_t sample, timer;        /* instants of the next sample and compare match */
  int64_t blank;                /* end of the firmware's blanking */
  int phase, level, sought;     /* watched comparator (-1: none); its output; output that causes an interrupt */
  int hall;                     /* last Hall code (-1: the Hall lines are not watched) */
  uint16_t adc[HAL_CHANNELS], captured;
} hal;

static double seconds(int64_t ps) { return (double)ps / 1e12; }
static int64_t least(int64_t a, int64_t b) { return a < b ? a : b; }
static int64_t after(int64_t at) { return at > hal.now ? at : NEVER; }


static void note(const char* word, long long number) {
  if (hal.log != NULL) fprintf(hal.log, "%lld %s %lld\n", (long long)hal.now, word, number);
}

/* ---- PWM timer ---- */

static int wanted_of(int k) {
  if (hal.leg[k] == HAL_FLOAT) return 0;
  return hal.leg[k] == HAL_PWM && hal.now - hal.period < (int64_t)hal.compare * PWM_COUNT_PS ? 1 : 2;
}

/* A switch turns off at once, and on after the dead time. */
static void set_gates(void) {
  uint32_t gates = 0;
  int k;
  for (k = 0; k < 3; k++) {
    if (wanted_of(k) != hal.wanted[k]) {
      hal.wanted[k] = (uint8_t)wanted_of(k);
      hal.since[k] = hal.now;
    }
    if (hal.now >= hal.since[k] + DEAD_PS) gates |= (uint32_t)hal.wanted[k] << 2 * k;
  }
  if (gates == hal.gates) return;
  hal.gates = gates;
  hal.changed = hal.now;
  hal.status = sixstep_set_gates(hal.session, gates);
  note("gates", gates);
}

static int64_t next_edge(void) {
  int64_t next = least(hal.period + PERIOD_PS, after(hal.period + (int64_t)hal.compare * PWM_COUNT_PS));
  int k;
  for (k = 0; k < 3; k++) next = least(next, after(hal.since[k] + DEAD_PS));
  return next;
}

static void convert(void) {
  sixstep_counts counts;
  int k;
  sixstep_convert(hal.session, &counts);
  for (k = 0; k < 3; k++) hal.adc[HAL_CURRENT_A + k] = counts.current[k];
  hal.adc[HAL_BUS] = counts.bus;
}

void hal_legs(const uint8_t leg[3]) {
  int k;
  for (k = 0; k < 3; k++) hal.leg[k] = leg[k];
}
void hal_duty(uint16_t compare) { hal.preload = compare < HAL_PWM_TOP ? compare : (uint16_t)HAL_PWM_TOP; }
uint16_t hal_adc(uint8_t channel) { return hal.adc[channel]; }
void hal_set_throttle(uint16_t counts) { hal.adc[HAL_THROTTLE] = counts; }

/* ---- Counter ---- */

uint16_t hal_counter(void) { return (uint16_t)(hal.now / COUNT_PS); }
void hal_timer(uint16_t counts) { hal.timer = (hal.now / COUNT_PS + (counts > 0 ? counts : 1)) * COUNT_PS; }
void hal_timer_off(void) { hal.timer = NEVER; }

/* ---- Comparators and Hall lines ---- */

static double above_mean(int phase) {
  double u[3];
  int k;
  for (k = 0; k < 3; k++) u[k] = sixstep_value(hal.session, hal.u[k]);
  return u[phase] - (u[0] + u[1] + u[2]) / 3;
}

/* Voltage at which the output of the watched comparator changes. */
static double threshold(void) { return hal.level ? -HYSTERESIS_V : HYSTERESIS_V; }
static int level_now(void) { return above_mean(hal.phase) > threshold(); }
static int holds(void) { return hal.now < hal.changed + HOLD_PS; }

void hal_comparator(uint8_t phase, uint8_t high, uint16_t blank) {
  hal.phase = phase;
  hal.sought = high;
  hal.level = above_mean(phase) > 0;
  hal.blank = hal.now + (int64_t)blank * COUNT_PS;
  note("blank", hal.blank);
}
void hal_comparator_off(void) { hal.phase = -1; }
uint8_t hal_comparator_level(void) { return (uint8_t)hal.level; }

uint8_t hal_hall(void) { return (uint8_t)sixstep_value(hal.session, hal.hall_lines); }
void hal_hall_on(void) { hal.hall = hal_hall(); }
uint16_t hal_captured(void) { return hal.captured; }

static void interrupt(void (*handler)(void)) {
  hal.captured = hal_counter();
  handler();
}

static void look_at_hall(void) {
  if (hal.hall == hal_hall()) return;
  hal.hall = hal_hall();
  interrupt(esc_on_hall);
}

static void look_at_comparator(void) {
  if (level_now() == hal.level) return;
  hal.level = !hal.level;
  if (hal.level != hal.sought) return;
  note(hal.now < hal.blank ? "masked" : "taken", (long long)(1e9 * sixstep_value(hal.session, hal.e[hal.phase])));
  if (hal.now >= hal.blank) interrupt(esc_on_comparator);
}

/* ---- The loop ---- */

/* Advances to the instant `to`, or to an earlier change of the comparator, end of its hold, or Hall edge. */
static void advance(int64_t to) {
  if (hal.phase >= 0 && !holds())
    hal.status = sixstep_advance_to_crossing(hal.session, hal.phase, threshold(), seconds(to));
  else if (hal.phase < 0 && hal.hall >= 0)
    hal.status = sixstep_advance_to_hall_edge(hal.session, seconds(to));
  else
    hal.status = sixstep_advance(hal.session, seconds(hal.phase >= 0 ? least(to, hal.changed + HOLD_PS) : to));
  hal.now = (int64_t)(sixstep_time(hal.session) * 1e12 + 0.5);
  if (hal.phase >= 0 && !holds()) look_at_comparator();
  else if (hal.phase < 0 && hal.hall >= 0) look_at_hall();
}

/* Starts the PWM period and calls the interrupts that are due at the present instant; then sets the gates. */
static void act(void) {
  if (hal.now == hal.period + PERIOD_PS) {
    hal.period = hal.now;
    hal.compare = hal.preload;
    hal.sample = hal.now + (int64_t)(hal.compare / 2) * PWM_COUNT_PS;
  }
  if (hal.now >= hal.sample) {
    hal.sample = NEVER;
    convert();
    esc_on_pwm();
  }
  if (hal.now >= hal.timer) {
    hal.timer = NEVER;
    esc_on_timer();
  }
  set_gates();
}

sixstep_status hal_run(double to_s) {
  const int64_t to = (int64_t)(to_s * 1e12 + 0.5);
  while (hal.now < to && hal.status == SIXSTEP_OK) {
    advance(least(least(to, next_edge()), least(hal.sample, hal.timer)));
    if (hal.status == SIXSTEP_OK) act();
  }
  return hal.status;
}

void hal_connect(sixstep_session* session, FILE* log) {
  static const char* const names[] = {"u_a_V", "u_b_V", "u_c_V", "e_a_V", "e_b_V", "e_c_V"};
  int k;
  for (k = 0; k < 3; k++) {
    hal.u[k] = sixstep_signal_index(names[k]);
    hal.e[k] = sixstep_signal_index(names[3 + k]);
  }
  hal.hall_lines = sixstep_signal_index("hall");
  hal.session = session;
  hal.log = log;
  hal.status = SIXSTEP_OK;
  hal.period = -PERIOD_PS;
  hal.timer = NEVER;
  hal.sample = NEVER;
  hal.phase = hal.hall = -1;
  esc_start();
  act();
}
