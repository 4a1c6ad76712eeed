// SPDX-License-Identifier: Apache-2.0
// Computes the lag of a speed loop's sensor. A speed from Hall edges (control/hall_speed.hpp) is the mean
// over the last k sectors, held until the next edge. At the mechanical speed w a sector takes T = (pi/3)/(p
// w). The loop therefore measures w through
//
//   H(jv) = sinc(v k T/2) exp(-j v k T/2) . sinc(v T/2) exp(-j v T/2),        sinc x = sin x / x,
//
// the product of the mean over k T and the hold over T (averaged over the position of a control tick in the
// sector). H is nearly a pure delay of (k + 1)/2 T. The delay grows with falling speed; a loop is therefore
// judged at the lowest required speed. The delay of the Hall lines is added.
//
// If the total length of k sectors deviates by s from k pi/3, the measured speed deviates by w s/(k pi/3). If
// a sector lasts longer than the time-out, the speed reads 0. shaft_sensing.hpp is for encoders and
// resolvers, whose angle may be late too.
#pragma once
#include <string>
#include <vector>

#include "sixstep/design/loops/pole_placement.hpp"
#include "sixstep/design/loops/shaft_sensing.hpp"
#include "sixstep/design/loops/transfer.hpp"

namespace sixstep::design {

/// Sensors of speed and position.
struct RotorSensing {
  bool hall = true;  ///< true: Hall probes; false: an ideal sensor, like an encoder with very many lines
  int edges = 0;     ///< edges over which the speed is measured, 1..6; 0: six if their delay is small for the
                     ///< loop, else one
  ShaftSensing shaft{};     ///< an encoder or a resolver, which replaces Hall probes and the ideal sensor
  double late_s = 0.0;      ///< delay from a probe's edge to the pin of the chip
  double stray_rad = 0.0;   ///< largest deviation of the total length of k sectors from k pi/3, electrical
  double timeout_s = 0.0;   ///< time without an edge after which the speed reads 0; 0: not given
  double capture_Hz = 0.0;  ///< clock of the timer that captures the probes' edges; 0: not given

  /// True if the measured speed is older than the sample at which it is read.
  bool lags() const { return hall || shaft.kind != ShaftSensorKind::none; }
};

/// The speed's sensor as text: "Hall, 1 edge", "Hall, 6 edges or 1"; sensor_words() for an encoder or a
/// resolver.
std::string edges_words(const RotorSensing& sensing);

/// Phase, rad, by which six edges may delay a speed loop at its crossover; with a larger delay, one edge is
/// used instead. The value is an eighth of the half turn that makes feedback unstable.
inline constexpr double six_edges_phase_rad = 0.39269908169872415480783;

/// Time within which six edges must occur to be averaged, s, for a loop with crossover at `crossover_rad_s`.
/// The delay of six edges is 7/12 of this time. 0 without a speed loop: one edge then suffices.
double hall_window_s(double crossover_rad_s);

/// Crossover of a PI of gain d1 (rad/s -> fraction of full output) without its integral, rad/s: d1 times the
/// acceleration at full output.
double speed_crossover_rad_s(double d1, double full_acceleration_rad_s2);

/// Lag of the measured speed.
struct SpeedLag {
  double mean_s = 0.0;  ///< the speed is the mean over this time
  double hold_s = 0.0;  ///< each value is held for this time
  double late_s = 0.0;  ///< additional delay

  double delay_s() const { return (mean_s + hold_s) / 2 + late_s; }
  /// Transfer function at angular frequency v.
  Complex at(double v_rad_s) const;
};

/// The lag with the longest delay at any speed from `speed_rad_s` upwards. `crossover_rad_s`: crossover of
/// the speed loop; it selects six edges or one.
SpeedLag speed_lag(const RotorSensing& sensing, double pole_pairs, double speed_rad_s,
                   double crossover_rad_s);

/// Largest step of the measured speed between two readings at constant speed, mechanical, rad/s. Its cause is
/// a tick of the timer, a count, or wrong positions of probes. For a resolver the result is the rms value of
/// the noise.
double speed_step_rad_s(const RotorSensing& sensing, double pole_pairs, double speed_rad_s,
                        double crossover_rad_s);

/// Derivation of the lag for a reader, with the loss of phase at the crossover.
std::vector<DerivationStep> lag_steps(const RotorSensing& sensing, double pole_pairs, double speed_rad_s,
                                      double crossover_rad_s);

}  // namespace sixstep::design
