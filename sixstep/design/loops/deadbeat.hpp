// SPDX-License-Identifier: Apache-2.0
// Designs a deadbeat current loop (control/deadbeat.hpp) from R and L of the driven pair, K_t, the control period and
// the delay from a sample to its answer. Both poles are at 0, so there is nothing to place. The only choice is how
// fast the loop corrects for voltages that the model does not contain.
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/deadbeat.hpp"
#include "sixstep/design/loops/pole_placement.hpp"
#include "sixstep/design/loops/transfer.hpp"

namespace sixstep::design {

/// Part of the prediction error that each sample corrects: after 16 samples 1 % is left.
inline constexpr double usual_correction = 0.25;

struct DeadbeatSpec {
  double R_ohm = 0.0, L_H = 0.0;  ///< terminal
  double K_t_Nm_A = 0.0;
  double period_s = 0.0;
  double wait_periods = 0.0;  ///< 0..1
  double correction = usual_correction;
  double limit_V = 0.0;
};

struct Deadbeat {
  control::DeadbeatConfig<double> config;
  std::vector<DerivationStep> steps;
};

/// Problem: a delay of more than a period, for which two voltages would have to be stored.
base::Result<Deadbeat> deadbeat(const DeadbeatSpec& spec);

/// Its equivalent open loop, L = T/(1 - T) with T = z^-(1 + wait), for whole periods.
Transfer open_deadbeat_loop(int wait_periods);

}  // namespace sixstep::design
