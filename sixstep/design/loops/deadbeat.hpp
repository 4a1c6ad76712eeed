// SPDX-License-Identifier: Apache-2.0
// Designs a deadbeat current loop (control/deadbeat.hpp) from R and L of the driven pair, K_t, the control
// period and the delay from a sample to its output. Both poles are fixed at 0. The only free parameter is the
// speed at which the loop corrects voltages that are missing in the model.
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/deadbeat.hpp"
#include "sixstep/design/loops/pole_placement.hpp"
#include "sixstep/design/loops/transfer.hpp"

namespace sixstep::design {

/// Fraction of the prediction error that each sample corrects; after 16 samples 1 % of the error remains.
inline constexpr double usual_correction = 0.25;

struct DeadbeatSpec {
  double R_ohm = 0.0, L_H = 0.0;  ///< terminal values
  double K_t_Nm_A = 0.0;
  double period_s = 0.0;
  double wait_periods = 0.0;  ///< periods from a sample until its voltage begins, 0..1
  double correction = usual_correction;
  double limit_V = 0.0;
};

struct Deadbeat {
  control::DeadbeatConfig<double> config;
  std::vector<DerivationStep> steps;
};

/// The design. Problem: wait_periods above 1, which would require a second stored voltage.
base::Result<Deadbeat> deadbeat(const DeadbeatSpec& spec);

/// The equivalent open loop, L = T/(1 - T) with T = z^-(1 + wait), for a wait of whole periods.
Transfer open_deadbeat_loop(int wait_periods);

}  // namespace sixstep::design
