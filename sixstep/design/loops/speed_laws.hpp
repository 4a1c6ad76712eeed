// SPDX-License-Identifier: Apache-2.0
// Designs speed controllers other than the PI from the same settling time. Full output accelerates by A rad/s2,
// friction takes B/J of the speed, the decay over a sample is a = exp(-B T/J), b = A T (1 - a)/(-ln a), and the error
// is to decay with p = exp(-4.6 T/T_reg). An observer, or another part faster than the loop, is k times faster: p^k.
//
// State feedback (control/observed_speed.hpp). The torque comes M samples late on average; the model is a lag,
// c = M/(1 + M). h = w + g t with g = b c/(a - c) is free of that lag: h[n+1] = a h[n] + B u[n] - b l with
// B = (b + g)(1 - c). For it the linear-quadratic regulator is one number: the least sum of h^2 + r u^2 requires
//
//   P = 1 + a^2 P r/(r + B^2 P),   K = a B P/(r + B^2 P),   a - B K = p,   r = B^2/(a ((1 - p)^2/p - (1 - a)^2/a))
//
// (Franklin, Powell and Workman, 9.3, solved for the weight r). The observer has both poles at z_o = p^k: L_w = 1 - z_o^2/a,
// L_l = (1 - z_o)^2/b. f = (1 - a)/b holds a speed against friction.
//
// Active disturbance rejection: the same block with the acceleration as its only parameter: a = 1, c = 0, b = b_0 T
// with b_0 = A, K = (1 - p)/b, z_o = exp(-w_o T) with w_o = k w_c and w_c = 4.6/T_reg.
//
// Sliding mode (control/sliding_speed.hpp): q = 1 - p, and in the layer the surface's pole is p^k: P = R b/(1 - p^k). R is
// the whole limit: the controller then rejects any load that the drive can carry at all.
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/drive_extras.hpp"
#include "sixstep/design/loops/drive_loops.hpp"

namespace sixstep::design {

/// Default ratio of an observer's speed to its loop's.
inline constexpr double usual_observer_ratio = 5.0;

struct SpeedLawSpec {
  double full_rad_s2 = 0.0;  ///< A: acceleration by the full output
  double fades_1_s = 0.0;    ///< B/J: relative loss of speed by friction
  double lag_periods = 0.0;  ///< M: delay of the torque after its command
  double limit = 1.0;        ///< limit of the output
  double settle_s = 0.0;
  double ratio = usual_observer_ratio;  ///< k
  double period_s = 0.0;
};

struct SpeedLawDesign {
  control::SpeedLaws<double> gains{};
  double pole = 0.0;       ///< p
  double fast_pole = 0.0;  ///< p^k
  double K = 0.0;          ///< output per rad/s of error
  std::vector<DerivationStep> steps{};
};

/// Problems: values not above 0, a settling time that friction alone undercuts, a torque slower than the speed.
base::Result<SpeedLawDesign> state_feedback(const SpeedLawSpec& spec);
base::Result<SpeedLawDesign> disturbance_rejection(const SpeedLawSpec& spec);
base::Result<SpeedLawDesign> sliding_mode(const SpeedLawSpec& spec);

/// Mean delay, in samples, of a current loop whose integral gain is K_i V/A per sample on a winding of R, against a
/// torque that is held from the sample on: the samples of a step's error add up to R/K_i for any delay of the loop,
/// and the mean of two neighbours counts.
double current_lag_periods(double R_ohm, double K_i_V_A);

/// Linear form, valid while no limit acts.
LinearLaw linear(const control::ObservedSpeedConfig<double>& c);
LinearLaw linear(const control::SlidingSpeedConfig<double>& c);  ///< within its layer
LinearLaw linear(const control::PiPositionalConfig<double>& pi, const control::DerivativeConfig<double>& d,
                 double weight_off);

}  // namespace sixstep::design
