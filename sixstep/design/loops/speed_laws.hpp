// SPDX-License-Identifier: Apache-2.0
// Speed controllers beside the PI, from the settling time that the PI is given, too. A full output accelerates by A rad/s2,
// friction takes B/J of the speed, the shaft held for a sample is a = exp(-B T/J), b = A T (1 - a)/(-ln a), and the error
// is to fade with p = exp(-4.6 T/T_reg). An observer, or what is fast beside the loop, is k times faster: p^k.
//
// State feedback (control/observed_speed.hpp). The torque comes M samples late in the mean, of which
// a lag is made, c = M/(1 + M). h = w + g t with g = b c/(a - c) knows no lag: h[n+1] = a h[n] + B u[n] - b l with
// B = (b + g)(1 - c). There the linear-quadratic regulator is a number: least sum of h^2 + r u^2 asks for
//
//   P = 1 + a^2 P r/(r + B^2 P),   K = a B P/(r + B^2 P),   a - B K = p,   r = B^2/(a ((1 - p)^2/p - (1 - a)^2/a))
//
// (Franklin, Powell and Workman, 9.3, solved for the weight r). The observer has both poles at z_o = p^k: L_w = 1 - z_o^2/a,
// L_l = (1 - z_o)^2/b. f = (1 - a)/b holds a speed against friction.
//
// Active disturbance rejection: the same block, told of the acceleration alone: a = 1, c = 0, b = b_0 T with b_0 = A,
// K = (1 - p)/b, z_o = exp(-w_o T) with w_o = k w_c and w_c = 4.6/T_reg.
//
// Sliding mode (control/sliding_speed.hpp): q = 1 - p, and in the layer the surface's pole is p^k: P = R b/(1 - p^k). R is
// all of the limit: what the drive can bear at all, it bears.
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/drive_extras.hpp"
#include "sixstep/design/loops/drive_loops.hpp"

namespace sixstep::design {

/// How many times faster than its loop an observer is where nothing is said.
inline constexpr double usual_observer_ratio = 5.0;

struct SpeedLawSpec {
  double full_rad_s2 = 0.0;  ///< A: acceleration by the full output
  double fades_1_s = 0.0;    ///< B/J: what friction takes of the speed
  double lag_periods = 0.0;  ///< M: by which the torque follows what is asked for
  double limit = 1.0;        ///< of the output
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

/// Problems: values not above 0, a settling time that friction alone is faster than, a torque that is slower than the speed.
base::Result<SpeedLawDesign> state_feedback(const SpeedLawSpec& spec);
base::Result<SpeedLawDesign> disturbance_rejection(const SpeedLawSpec& spec);
base::Result<SpeedLawDesign> sliding_mode(const SpeedLawSpec& spec);

/// Mean delay, in samples, of a current loop whose integral gain is K_i V/A a sample on a winding of R, beside a torque that is held from
/// the sample on: the samples of a step's error add up to R/K_i, whatever delay is in it, and the mean of two neighbours counts.
double current_lag_periods(double R_ohm, double K_i_V_A);

/// While no limit acts.
LinearLaw linear(const control::ObservedSpeedConfig<double>& c);
LinearLaw linear(const control::SlidingSpeedConfig<double>& c);  ///< within its layer
LinearLaw linear(const control::PiPositionalConfig<double>& pi, const control::DerivativeConfig<double>& d,
                 double weight_off);

}  // namespace sixstep::design
