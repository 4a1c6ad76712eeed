// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/deadbeat.hpp"

#include "sixstep/base/written.hpp"

namespace sixstep::design {

namespace {

control::HeldWinding<double> held(const DeadbeatSpec& spec, double time_s) {
  const ZohPlant plant = current_plant(spec.R_ohm, spec.L_H, time_s);
  return {.decay = -plant.a0, .A_per_V = plant.b0};
}

}  // namespace

base::Result<Deadbeat> deadbeat(const DeadbeatSpec& spec) {
  if (spec.wait_periods > 1)
    return base::Problem{"wait_periods", base::written(spec.wait_periods),
                         "exceeds one period, the horizon of the prediction",
                         "answer within a period of the sample"};
  const double T = spec.period_s, wait_s = spec.wait_periods * T;
  const control::HeldWinding<double> wait = held(spec, wait_s), rest = held(spec, T - wait_s),
                                     whole = held(spec, T);
  const double V_per_A = 1 / whole.A_per_V;
  return Deadbeat{
      {.wait = wait,
       .rest = rest,
       .decay = whole.decay,
       .V_per_A = V_per_A,
       .correction_V_per_A = spec.correction * V_per_A,
       .K_t_V_s = spec.K_t_Nm_A,
       .limit = spec.limit_V},
      {{"T_s", "control period", T, "s"},
       {"t_w", "from a sample to its answer", wait_s, "s"},
       {"a", "exp(-R T_s / L)", whole.decay, ""},
       {"b", "(1 - a) / R", whole.A_per_V, "A/V"},
       {"1/b", "voltage that changes the current by 1 A in a period", V_per_A, "V/A"},
       {"a_w", "exp(-R t_w / L)", wait.decay, ""},
       {"b_w", "(1 - a_w) / R", wait.A_per_V, "A/V"},
       {"g/b", "correction voltage per ampere of prediction error", spec.correction * V_per_A, "V/A"}}};
}

Transfer open_deadbeat_loop(int wait_periods) {
  Transfer loop = delay(1 + wait_periods);
  loop.den[0] -= 1.0;  // z^n - 1 in powers of z - 1
  return loop;
}

}  // namespace sixstep::design
