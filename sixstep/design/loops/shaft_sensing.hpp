// SPDX-License-Identifier: Apache-2.0
// Computes the lag of an encoder or a resolver in a speed loop, the jitter of its speed, and the lowest speed
// that it can measure.
//
//   encoder    M/T (control/sensing/pulse_speed.hpp): the mean over the time T between two edges used at
//              control ticks, T = max(T_s, c), held for c = (2 pi/4N)/w until the next edge. A timer tick in
//              T is the fraction 1/(f T) of the speed. The lowest speed is one count per time-out.
//   absolute   the mean over k samples, late by the code's latency. One count in k T_s is (2 pi/2^n)/(k T_s);
//              a lower speed reads as zero or as this speed.
//   resolver   the integrator of a loop of type 2, w_n^2/(s^2 + 2 D w_n s + w_n^2). It is 2 D/w_n late at
//              frequencies far below w_n, where a speed loop should be. The delay of the angle is added.
//              Noise of s rad in each step of T_l causes a jitter of s sqrt(T_l w_n^3/(4 D)). Every speed is
//              measured.
//
// All speeds are mechanical. On the load's side of a gear, n turns of the motor are one turn of the sensor.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "sixstep/design/loops/pole_placement.hpp"

namespace sixstep::design {

enum class ShaftSensorKind : std::uint8_t { none, encoder, absolute, resolver };

struct ShaftSensing {
  ShaftSensorKind kind = ShaftSensorKind::none;
  double gear = 1.0;      ///< n, turns of the motor per turn of the sensor
  bool linear = false;    ///< true: a linear scale; n is the magnets' period divided by 2 pi, in m, and N the
                          ///< number of lines in a period
  double period_s = 0.0;  ///< T_s, the control period
  // incremental encoder
  int lines = 0;            ///< N, lines per turn
  double capture_Hz = 0.0;  ///< f, clock of the timer that captures edges
  double timeout_s = 0.0;
  // absolute encoder
  int bits = 0;            ///< n, bits of the code
  int samples = 1;         ///< k, samples over which the speed is measured
  double latency_s = 0.0;  ///< latency of the code, or of a resolver's angle
  // resolver
  int pole_pairs = 1;          ///< pole pairs of the resolver
  double natural_rad_s = 0.0;  ///< w_n, natural frequency of the tracking loop
  double damping = 1.0;        ///< D, damping of the tracking loop
  double step_s = 0.0;         ///< T_l, step of the tracking loop
  double noise_rad = 0.0;      ///< s, rms noise as an angle of the resolver's turn
};

/// The sensor as text: "encoder, 1024 lines", "absolute encoder, 14 bits", "resolver, followed within 1 kHz".
std::string sensor_words(const ShaftSensing& sensing);

/// Age of a measured speed: it is the mean over `mean_s`, held for `hold_s`, and additionally `late_s` late.
struct ShaftSpeedAge {
  double mean_s = 0.0, hold_s = 0.0, late_s = 0.0;
};
ShaftSpeedAge speed_age(const ShaftSensing& sensing, double speed_rad_s);

/// Jitter of the measured speed, rad/s: one step for an encoder, the rms value for a resolver.
double speed_jitter_rad_s(const ShaftSensing& sensing, double speed_rad_s);

/// Speed below which the measured speed sometimes reads 0, rad/s; 0: every speed is measured.
double lowest_told_rad_s(const ShaftSensing& sensing);

/// Derivation of these values, for a reader.
std::vector<DerivationStep> shaft_sensing_steps(const ShaftSensing& sensing, double speed_rad_s);

}  // namespace sixstep::design
