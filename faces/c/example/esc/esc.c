/* SPDX-License-Identifier: Apache-2.0 */
/* Six-step speed controller without a rotor sensor. It aligns the rotor and commutates it open-loop along a speed
 * ramp. Then it commutates by the zero crossings of the free phase's back-EMF. All arithmetic is on integers,
 * because a Cortex-M0 has no floating-point unit. */
#include "hal.h"

#define PERIODS_PER_MS 20u
#define ALIGN_PERIODS (150u * PERIODS_PER_MS)
#define WAIT_PERIODS (20u * PERIODS_PER_MS)      /* pause after a loss of synchronism */
#define ALIGN_DUTY 200u
#define ALIGN_SLEW 10u                           /* PWM periods per count of duty: a slow rise prevents swing of the
                                                    rotor */
#define FIRST_INTERVAL 16000u                    /* counts of the first sector of the ramp: 8 ms */
#define LAST_INTERVAL 3000u                      /* counts of the ramp's last sector: 1.5 ms */
#define RAMP_CUBE 7000u                          /* constant acceleration: interval -= interval^3/(2^16 RAMP_CUBE) */
#define EMF_DUTY 700000u                         /* EMF_DUTY/interval is the duty that balances the back-EMF */
#define MIN_DUTY 200u
#define SLEW 4u                                  /* greatest rise of the duty per period */
#define CATCH_CROSSINGS 12u                      /* crossings found by polling before interrupts are used */
#define CATCH_SAMPLES 2u                         /* equal samples that confirm a polled crossing */
#define MISSES 4u                                /* sectors in a row without a crossing: loss of synchronism */
#define THROTTLE_ON 120u                         /* least throttle that starts the motor, of 4095 */
#define LIMIT (30u * HAL_COUNTS_PER_A)           /* current above which the duty falls */
#define TRIP (80u * HAL_COUNTS_PER_A)            /* current above which the bridge turns off until the throttle is
                                                    released */
#define LOWEST_BUS (9u * HAL_COUNTS_PER_V)

/* For each step: the chopped leg, the low leg, the free leg. The free phase's back-EMF rises in odd steps and falls
 * in even ones. */
static const uint8_t order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};

static esc_status is;
static uint8_t step, waits, same, misses;  /* waits: whether this sector's crossing is still missing */
static uint16_t periods, duty, last;       /* last: counter at the last crossing */
static uint16_t crossings;

const esc_status* esc_look(void) { return &is; }

static void bridge_off(void) {
  static const uint8_t off[3] = {HAL_FLOAT, HAL_FLOAT, HAL_FLOAT};
  hal_legs(off);
  hal_timer_off();
  hal_comparator_off();
  duty = 0;
}

static void enter(uint8_t state) {
  is.state = state;
  periods = 0;
}

static void drive(void) {
  uint8_t leg[3];
  leg[order[step][0]] = HAL_PWM;
  leg[order[step][1]] = HAL_LOW;
  leg[order[step][2]] = HAL_FLOAT;
  hal_legs(leg);
}

static void commutate(void) {
  step = (uint8_t)(step == 5 ? 0 : step + 1);
  is.commutations++;
  drive();
}

static uint8_t catching(void) { return crossings < CATCH_CROSSINGS; }
static uint8_t sought(void) { return step & 1u; }

static void next_sector(void) {
  commutate();
  waits = 1;
  same = 0;
  hal_comparator(order[step][2], sought(), (uint16_t)(catching() ? is.interval / 8 : is.interval / 4));
  hal_timer((uint16_t)(is.interval + is.interval / 2));
}

/* A current in all three legs holds the rotor on phase a's axis, and the two low legs damp its swing. */
static void align(void) {
  static const uint8_t hold[3] = {HAL_PWM, HAL_LOW, HAL_LOW};
  enter(ESC_ALIGN);
  hal_legs(hold);
}

static void ramp(void) {
  enter(ESC_RAMP);
  is.interval = FIRST_INTERVAL;
  step = 1; /* commutate() enters step 2: its current leads the aligned rotor by 90 degrees */
  commutate();
  hal_timer(is.interval);
}

static void follow(void) {
  enter(ESC_RUN);
  crossings = 0;
  misses = 0;
  last = (uint16_t)(hal_counter() - is.interval / 2);
  next_sector();
}

static void desync(void) {
  is.desyncs++;
  bridge_off();
  enter(ESC_WAIT);
}

static void crossing(uint16_t at) {
  const uint16_t measured = (uint16_t)(at - last), late = (uint16_t)(hal_counter() - at);
  uint16_t delay;
  waits = 0;
  misses = 0;
  last = at;
  if (catching()) crossings++;
  is.interval = (uint16_t)((3u * (uint32_t)is.interval + measured) / 4u);
  delay = (uint16_t)(is.interval / 2); /* 30 degrees */
  hal_timer((uint16_t)(delay > late ? delay - late : 1));
}

void esc_on_comparator(void) {
  if (is.state == ESC_RUN && waits && !catching()) crossing(hal_captured());
}

/* A sector without a crossing. Commutates at the last interval, because the blanking may have masked the crossing. */
static void miss(void) {
  is.missed++;
  if (++misses >= MISSES) {
    desync();
    return;
  }
  last = (uint16_t)(last + is.interval);
  next_sector();
}

static void ramp_on(void) {
  const uint32_t square = (uint32_t)is.interval * is.interval >> 16;
  is.interval = (uint16_t)(is.interval - square * is.interval / RAMP_CUBE);
  if (is.interval <= LAST_INTERVAL) {
    follow();
    return;
  }
  commutate();
  hal_timer(is.interval);
}

void esc_on_timer(void) {
  if (is.state == ESC_RAMP) ramp_on();
  else if (is.state == ESC_RUN && waits) miss();
  else if (is.state == ESC_RUN) next_sector();
}

/* Greatest current of the three phases, in counts from zero. */
static uint16_t current(void) {
  uint16_t most = 0;
  int k;
  for (k = HAL_CURRENT_A; k <= HAL_CURRENT_C; k++) {
    const uint16_t i = hal_adc((uint8_t)k);
    const uint16_t size = (uint16_t)(i > HAL_CURRENT_ZERO ? i - HAL_CURRENT_ZERO : HAL_CURRENT_ZERO - i);
    if (size > most) most = size;
  }
  return most;
}

/* The first CATCH_CROSSINGS crossings are polled. After the ramp the rotor may be anywhere in the sector, also past
   the crossing, so the comparator's level is read instead of its edge. */
static void poll(void) {
  if (!waits || !catching()) return;
  if ((uint16_t)(hal_counter() - last) < is.interval / 2) return;
  same = (uint8_t)(hal_comparator_level() == sought() ? same + 1 : 0);
  if (same >= CATCH_SAMPLES) crossing(hal_counter());
}

static void run_duty(uint16_t throttle, uint16_t amperes) {
  uint16_t wanted = (uint16_t)((uint32_t)throttle * HAL_PWM_TOP / 4095u);
  if (wanted < MIN_DUTY) wanted = MIN_DUTY;
  if (amperes > LIMIT) duty = (uint16_t)(duty - duty / 16);
  else if (duty < wanted && !catching()) duty = (uint16_t)(duty + SLEW > wanted ? wanted : duty + SLEW);
  else if (duty > wanted) duty = wanted;
}

static void act(uint16_t throttle, uint16_t amperes) {
  switch (is.state) {
    case ESC_ALIGN:
      if (duty < ALIGN_DUTY && periods % ALIGN_SLEW == 0) duty++;
      if (++periods >= ALIGN_PERIODS) ramp();
      break;
    case ESC_RAMP:
      duty = (uint16_t)(ALIGN_DUTY + EMF_DUTY / is.interval);
      break;
    case ESC_RUN:
      poll();
      run_duty(throttle, amperes);
      break;
    case ESC_WAIT:
      if (++periods >= WAIT_PERIODS) align();
      break;
    default:
      if (throttle >= THROTTLE_ON && is.state == ESC_OFF) align();
  }
}

void esc_on_pwm(void) {
  const uint16_t throttle = hal_adc(HAL_THROTTLE), amperes = current();
  if (throttle < THROTTLE_ON && is.state != ESC_OFF) {
    bridge_off();
    enter(ESC_OFF);
  } else if (is.state != ESC_OFF && is.state != ESC_FAULT && (amperes > TRIP || hal_adc(HAL_BUS) < LOWEST_BUS)) {
    bridge_off();
    enter(ESC_FAULT);
  }
  act(throttle, amperes);
  hal_duty(duty);
}

void esc_on_hall(void) {}

void esc_start(void) {
  bridge_off();
  enter(ESC_OFF);
}
