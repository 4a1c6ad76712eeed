// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/finite_set.hpp"

#include <cmath>

#include "sixstep/base/elementary.hpp"

namespace sixstep::design {

namespace {

/// Radius of the triangles divided by b U.
const double triangles = 2 / (3 * std::sqrt(3.0));

}  // namespace

FiniteSet finite_set(const FieldMachine& machine, double period_s, double bus_V) {
  const double R = machine.R_ohm, p = machine.pole_pairs;
  FiniteSet out;
  control::FiniteSetConfig<double>& c = out.config;
  c.on = true;
  c.d_decay = base::exp(-R * period_s / machine.L_d_H);
  c.q_decay = base::exp(-R * period_s / machine.L_q_H);
  c.d_A_per_V = (1 - c.d_decay) / R;
  c.q_A_per_V = (1 - c.q_decay) / R;
  c.half_turn_s = p * period_s / 2;
  c.salient_V_s_A = p * (machine.L_d_H - machine.L_q_H);
  out.band_A = triangles * std::fmax(c.d_A_per_V, c.q_A_per_V) * bus_V;
  out.steps = {
      {"T_s", "control period", period_s, "s"},
      {"a", "exp(-R T_s/L_q), fraction of a current that remains after one period", c.q_decay, ""},
      {"b", "(1 - a)/R, current per volt after one period", c.q_A_per_V, "A/V"},
      {"r", "2/(3 sqrt 3) b U, largest distance from a reference that the bus can reach", out.band_A, "A"}};
  return out;
}

}  // namespace sixstep::design
