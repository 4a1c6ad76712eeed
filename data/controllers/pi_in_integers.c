/* SPDX-License-Identifier: Apache-2.0 */
/* A current controller for a small chip, in C. It calculates in integers of mA and mV, with gains in units of 1/1024. A table of the
 * Hall codes selects the driven legs. The integral is clamped. In current mode the controller controls the current. In speed mode an
 * outer loop controls the speed. The chopping is soft. The gains follow from the motor's data: the zero of the PI controller cancels
 * the pole of the winding, and the bandwidth of the current loop is a fixed part of the control frequency. */
#include "sixstep/control/own/own_controller.h"

#define MODE_CURRENT SIXSTEP_CURRENT
#define HALL_CODES 8
#define NO_LEG 3
#define Q10_MILLI 1024000

/* For each Hall code H1 H2 H3: the leg at the bus (source) and the leg at ground (sink). */
static const uint8_t table[HALL_CODES][2] = {{NO_LEG, NO_LEG}, {2, 0}, {1, 2}, {1, 0}, {0, 1}, {2, 1}, {0, 2}, {NO_LEG, NO_LEG}};

typedef struct {
  int32_t kp, ki;             /* mV per A, Q10 */
  int32_t speed_kp, speed_ki; /* mA per rad/s, Q10 */
  int32_t limit_mA, bus_mV;
  uint8_t mode;
} config_t;

typedef struct {
  int64_t integral;       /* mV, Q10 */
  int64_t speed_integral; /* mA, Q10 */
  int32_t volts_mV;       /* signed */
} state_t;

static int64_t clamp(int64_t x, int64_t limit) { return x > limit ? limit : x < -limit ? -limit : x; }
static int32_t milli(sixstep_real x) {
  const sixstep_real half = (sixstep_real)0.5;
  return (int32_t)(x * 1000 + (x < 0 ? -half : half));
}

static const sixstep_parameter numbers[] = {
    {"bandwidth", "", "current loop's bandwidth, as a part of the control frequency", (sixstep_real)0.05, (sixstep_real)0.001, (sixstep_real)0.15},
    {"limit_A", "A", "largest current that the speed loop may request", 10, (sixstep_real)0.1, 1000},
};

static const char* design(const sixstep_given* given, const sixstep_real* values, void* config) {
  config_t* const c = (config_t*)config;
  /* The open loop is kp/(2 L s), with the Laplace variable s. Its gain is 1 at the angular frequency 2 pi times the bandwidth in Hz. */
  const sixstep_real kp = (sixstep_real)6.283185307179586 * values[0] / given->period_s * 2 * given->L_H;
  if (given->mode != SIXSTEP_CURRENT && given->mode != SIXSTEP_SPEED) return "controls a current or a speed, and nothing else";
  if (kp * Q10_MILLI > 1000000000) return "has gains that are too large for its integers: lower the bandwidth";
  c->mode = given->mode;
  c->kp = (int32_t)(kp * Q10_MILLI);
  c->ki = (int32_t)(kp * given->R_ohm / given->L_H * given->period_s * Q10_MILLI);
  c->bus_mV = milli(given->bus_V);
  c->limit_mA = milli(values[1]);
  /* The gains of the library's speed loop, multiplied by the current of full torque: their output is a current. */
  c->speed_kp = (int32_t)(given->speed_d1 * given->full_current_A * Q10_MILLI);
  c->speed_ki = (int32_t)((given->speed_d1 + given->speed_d0) * given->full_current_A * Q10_MILLI);
  return 0;
}

/* Selects the driven pair from the Hall code and from the sign of the voltage. */
static void drive(int32_t volts_mV, int32_t bus_mV, uint8_t hall, sixstep_answer* answer) {
  const uint8_t* const legs = table[hall & 7u];
  answer->enabled = legs[0] != NO_LEG;
  answer->fault = !answer->enabled; /* the Hall code is invalid */
  if (!answer->enabled) return;
  answer->source = legs[volts_mV < 0];
  answer->sink = legs[volts_mV >= 0];
  answer->chopping = SIXSTEP_SOFT;
  answer->duty = (sixstep_real)(volts_mV < 0 ? -volts_mV : volts_mV) / (sixstep_real)bus_mV;
}

static void step(const void* config, void* state, const sixstep_measured* seen, sixstep_real setpoint, sixstep_answer* answer) {
  const config_t* const c = (const config_t*)config;
  state_t* const s = (state_t*)state;
  const uint8_t* const legs = table[seen->hall & 7u];
  int32_t want_mA, is_mA, error;
  if (c->mode == MODE_CURRENT) {
    want_mA = milli(setpoint);
  } else {
    const int32_t slow_mrad_s = milli(setpoint - seen->speed_rad_s);
    s->speed_integral = clamp(s->speed_integral + (int64_t)c->speed_ki * slow_mrad_s / 1000, (int64_t)c->limit_mA << 10);
    want_mA = (int32_t)clamp((s->speed_integral + (int64_t)c->speed_kp * slow_mrad_s / 1000) >> 10, c->limit_mA);
    answer->speed_reference_rad_s = setpoint;
  }
  answer->current_reference_A = (sixstep_real)want_mA * (sixstep_real)1e-3;
  is_mA = legs[0] == NO_LEG ? 0 : milli((seen->current_A[legs[0]] - seen->current_A[legs[1]]) / 2);
  error = want_mA - is_mA;
  s->integral = clamp(s->integral + (int64_t)c->ki * error / 1000, (int64_t)c->bus_mV << 10);
  s->volts_mV = (int32_t)clamp((s->integral + (int64_t)c->kp * error / 1000) >> 10, c->bus_mV);
  drive(s->volts_mV, c->bus_mV, seen->hall, answer);
}

static void hall(const void* config, void* state, uint8_t code, sixstep_answer* answer) {
  drive(((const state_t*)state)->volts_mV, ((const config_t*)config)->bus_mV, code, answer);
}

const sixstep_controller* sixstep_own_controller(void) {
  static const sixstep_controller own = {
      SIXSTEP_OWN_INTERFACE, SIXSTEP_ANSWERS_PAIR, "PI in integers",
      "calculates in integers of mA and mV, as on a small chip",
      sizeof(config_t), sizeof(state_t), sizeof numbers / sizeof numbers[0], numbers, design, 0, step, hall};
  return &own;
}
