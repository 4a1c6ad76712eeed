// SPDX-License-Identifier: Apache-2.0
// A deadbeat current loop (control/deadbeat.hpp) from R and L of the driven pair, K_t, the control period and the wait between
// a sample and its answer. Nothing is placed: both poles lie at 0. What is chosen is how fast the voltage that the model lacks
// is taken over.
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/deadbeat.hpp"
#include "sixstep/design/loops/pole_placement.hpp"
#include "sixstep/design/loops/transfer.hpp"

namespace sixstep::design {

/// Part of a prediction's miss that each sample takes over: after 16 samples 1 % is left.
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

/// Problem: a wait of more than a period, over which two voltages would have to be remembered.
base::Result<Deadbeat> deadbeat(const DeadbeatSpec& spec);

/// Its open loop as others see it, L = T/(1 - T) with T = z^-(1 + wait): for whole periods.
Transfer open_deadbeat_loop(int wait_periods);

}  // namespace sixstep::design
