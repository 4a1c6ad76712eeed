// SPDX-License-Identifier: Apache-2.0
// What a loop loses to the sensor of its speed. A speed from Hall edges (control/hall_speed.hpp) is the mean
// over the last k sectors, held until the next edge. Turning at w a sector takes T = (pi/3)/(p w), so the
// loop sees w through
//
//   H(jv) = sinc(v k T/2) exp(-j v k T/2) . sinc(v T/2) exp(-j v T/2),        sinc x = sin x / x,
//
// the mean over k T and the hold over T (its mean over where in the sector a control tick falls): a delay of
// (k + 1)/2 T and little else. It grows as the rotor slows down: what a loop can do is said for the lowest
// speed that is asked for. What the lines are late comes on top. Where k sectors together stray by s from k pi/3, their speed
// strays by w s/(k pi/3); a sector that lasts longer than the time-out ends the speed. Encoders and resolvers have
// shaft_sensing.hpp, whose angle may be late beside that.
#pragma once
#include <string>
#include <vector>

#include "sixstep/design/loops/pole_placement.hpp"
#include "sixstep/design/loops/shaft_sensing.hpp"
#include "sixstep/design/loops/transfer.hpp"

namespace sixstep::design {

/// How the drive knows speed and position of its rotor.
struct RotorSensing {
  bool hall = true;  ///< Hall probes; else ideal, as an encoder of very many lines
  int edges = 0;     ///< that a speed is taken over, 1..6; 0: six where they cost the loop little, else one
  ShaftSensing shaft{};  ///< an encoder or a resolver in the place of both
  double late_s = 0.0;   ///< from a probe's edge to the pin of the chip
  double stray_rad =
      0.0;  ///< electrical: the most by which k sectors together are longer or shorter than k pi/3
  double timeout_s = 0.0;   ///< a speed whose edge does not come for so long reads as 0; 0: nobody said
  double capture_Hz = 0.0;  ///< of the timer that the probes' edges are captured by; 0: nobody said

  /// Whether the speed is any older than the sample.
  bool lags() const { return hall || shaft.kind != ShaftSensorKind::none; }
};

/// "Hall, 1 edge", "Hall, 6 edges or 1"; sensor_words() of an encoder or a resolver
std::string edges_words(const RotorSensing& sensing);

/// Phase in rad that six edges may cost a speed loop at its crossover before one edge is taken instead:
/// an eighth of the half turn that makes feedback unstable.
inline constexpr double six_edges_phase_rad = 0.39269908169872415480783;

/// The time within which six edges must have come to be averaged, for a loop that crosses over at
/// `crossover_rad_s`: their delay is 7/12 of it. Without a loop on the speed (0) one edge is enough.
double hall_window_s(double crossover_rad_s);

/// Where a PI of gain d1 (rad/s -> part of the full output) crosses over, its integral not counted: the
/// acceleration of the full output times d1.
double speed_crossover_rad_s(double d1, double full_acceleration_rad_s2);

/// What a loop sees of its speed.
struct SpeedLag {
  double mean_s = 0.0;  ///< the speed is the mean over so long
  double hold_s = 0.0;  ///< and stands for so long
  double late_s = 0.0;  ///< and is told so late

  double delay_s() const { return (mean_s + hold_s) / 2 + late_s; }
  /// At angular frequency v.
  Complex at(double v_rad_s) const;
};

/// The longest delay at any speed from `speed_rad_s` up. `crossover_rad_s`: of the speed loop, for adaptive
/// edges.
SpeedLag speed_lag(const RotorSensing& sensing, double pole_pairs, double speed_rad_s,
                   double crossover_rad_s);

/// By how much the told speed may jump from one reading to the next while the speed stands: a tick of the timer, a count, probes beside
/// their places; of a resolver the root mean square of its noise. Mechanical, rad/s.
double speed_step_rad_s(const RotorSensing& sensing, double pole_pairs, double speed_rad_s,
                        double crossover_rad_s);

/// The same for a reader, with the phase it costs at the crossover.
std::vector<DerivationStep> lag_steps(const RotorSensing& sensing, double pole_pairs, double speed_rad_s,
                                      double crossover_rad_s);

}  // namespace sixstep::design
