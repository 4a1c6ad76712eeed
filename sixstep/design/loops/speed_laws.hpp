// SPDX-License-Identifier: Apache-2.0
// Designs speed controllers other than the PI from the same settling time T_reg. Full output accelerates by A
// rad/s2, and friction reduces the speed by the fraction B/J per second. Over a sample of the time T the
// speed decays by a = exp(-B T/J), and full output adds b = A T (1 - a)/(-ln a). The error must decay with p
// = exp(-4.6 T/T_reg) per sample. An observer, or another part faster than the loop, is k times faster: p^k.
//
// State feedback (control/observed_speed.hpp). The torque is M samples late on average. The model of this
// delay is a lag, c = M/(1 + M). h = w + g t with g = b c/(a - c) does not contain the lag: h[n+1] = a h[n] +
// B u[n] - b l with B = (b + g)(1 - c). Here w is the speed, t the torque, u the output and l the load. The
// linear-quadratic regulator for h is one number K. The least sum of h^2 + r u^2 requires
//
//   P = 1 + a^2 P r/(r + B^2 P),   K = a B P/(r + B^2 P),   a - B K = p,   r = B^2/(a ((1 - p)^2/p - (1 - a)^2/a))
//
// (Franklin, Powell and Workman, 9.3, solved for the weight r). The observer has both poles at z_o = p^k:
// L_w = 1 - z_o^2/a, L_l = (1 - z_o)^2/b. f = (1 - a)/b compensates friction at a constant speed.
//
// Active disturbance rejection is the same block, with the acceleration as its only parameter: a = 1, c = 0,
// b = b_0 T with b_0 = A, K = (1 - p)/b, and z_o = exp(-w_o T) with w_o = k w_c, w_c = 4.6/T_reg.
//
// Sliding mode (control/sliding_speed.hpp): q = 1 - p. In the layer the surface's pole is p^k: P = R b/(1 -
// p^k). R is the whole limit: the controller then rejects every load that the drive can compensate.
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/drive_extras.hpp"
#include "sixstep/design/loops/drive_loops.hpp"

namespace sixstep::design {

/// Default ratio of an observer's speed to the speed of its loop.
inline constexpr double usual_observer_ratio = 5.0;

struct SpeedLawSpec {
  double full_rad_s2 = 0.0;  ///< A: acceleration by the full output
  double fades_1_s = 0.0;    ///< B/J: fraction of the speed per second that friction removes
  double lag_periods = 0.0;  ///< M: mean delay from an output to its torque, in samples
  double limit = 1.0;        ///< limit of the output
  double settle_s = 0.0;
  double ratio = usual_observer_ratio;  ///< k, speed of an observer relative to its loop
  double period_s = 0.0;
};

struct SpeedLawDesign {
  control::SpeedLaws<double> gains{};
  double pole = 0.0;       ///< p, pole of the loop in z
  double fast_pole = 0.0;  ///< p^k, pole of the observer or another faster part
  double K = 0.0;          ///< output per rad/s of error
  std::vector<DerivationStep> steps{};
};

/// Problems: values not above 0, a settling time that is longer than the shaft's decay by friction, a torque
/// slower than the speed.
base::Result<SpeedLawDesign> state_feedback(const SpeedLawSpec& spec);
base::Result<SpeedLawDesign> disturbance_rejection(const SpeedLawSpec& spec);
base::Result<SpeedLawDesign> sliding_mode(const SpeedLawSpec& spec);

/// Mean delay, in samples, of a current loop with the integral gain K_i, V/A per sample, on a winding of R.
/// It is relative to a torque that is held from the sample on. For any delay of the loop, the sum of a step's
/// error over all samples is R/K_i; half a sample is subtracted, because the mean of two consecutive samples
/// counts.
double current_lag_periods(double R_ohm, double K_i_V_A);

/// The law as a LinearLaw, valid while no limit acts.
LinearLaw linear(const control::ObservedSpeedConfig<double>& c);
LinearLaw linear(const control::SlidingSpeedConfig<double>& c);  ///< valid within the boundary layer
LinearLaw linear(const control::PiPositionalConfig<double>& pi, const control::DerivativeConfig<double>& d,
                 double weight_off);

}  // namespace sixstep::design
