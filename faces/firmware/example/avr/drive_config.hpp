// SPDX-License-Identifier: Apache-2.0
// clang-format off
// Made by sixstep 0.1.0. Change the scenario, not this file:
//   sixstep export header data/scenarios/thesis/7.3.1-turning-exact-design.toml --set pwm.period_s=300e-6 --arithmetic q15 --range current_A=25 --range setpoint=20 --despite 'an example, for no board' --out faces/firmware/example/avr/drive_config.hpp
//
// scenario  7.3.1 Current PI, rotor turning, the same rule evaluated exactly
// motor     maxon EC 45 flat 251601: 8 pole pairs, terminal R = 1.03 ohm, L = 0.000572 H, K_t = 0.0335 N m/A; J = 1.35e-05 kg m2
// current   d1 = 2.93109 V/A, d0 = -1.28162 V/A; pole placement from settle_s and damping; poles z = 0.197448 +- 0.155904j (settle_s = 0.001, damping = 0.9) on 0.405217/(z -0.582626)
// Gains are per control period, pwm_period_ps. Speed is mechanical, current positive into the motor.
//
// NOT CLEARED FOR A BRIDGE. Written all the same, for this reason:
//   an example, for no board
// What was overridden:
//   sensors.currents = "ideal" tells the drive currents that no amplifier and converter have been through; set currents = "phases" or "dc-link", and current_range_A
//   pwm.delay_periods = 0 answers a sample at the instant it is taken, and a chip has to convert and compute first; set delay_periods = 1, or sample = "middle"
// Its run: 0.02 s simulated in q15, digest 727c6363537f67e4
//   slowest reach of 98 %: <= 0.001 s required, 0.000438941 s measured
// That run took for granted:
//   supply    24 V, stiff, takes current back
//   bridge    switches of 0 ohm, diodes of 0 V and 0 ohm, dead time 0 s
//   timing    sampled at a period's start, answered at once; edges on no counter's steps
//   currents  as they are
//   bus       as it is
//   rotor     as it is
//   load      0 N m, 0 kg m2 beside the rotor's
//   scale     the scenario's own; that of --range below was proved, not run
//
// Fixed point: what each quantity may reach and where the format ends, in SI
//   current                               25 of 45
//   current reference with band           20 of 45
//   current error                         45 of 45
//   speed                            716.418 of 716.418
//   speed error                      716.418 of 716.418
//   voltage with feed-forward             24 of 24
//   bus                                   24 of 24
//   current.limit                         24 of 24
//   current integral increment       74.2263 of 336
#pragma once
#include <cstdint>

#include "sixstep/control/drive.hpp"
#include "sixstep/control/units.hpp"

namespace exported {

using Scalar = sixstep::control::Q15;

// What 1.0 means; constants of the board are made by its functions: units.amperes(15)
inline constexpr sixstep::control::Units<Scalar> units{
  .current_A = 0x1.6802d005a00b4p+5,                                      // 45.0014 A
  .voltage_V = 0x1.80030006000cp+4,                                       // 24.0007 V
  .speed_rad_s = 0x1.66384a8781f44p+9,                                    // 716.44 rad/s
  .position_deg = 0x1p+0,                                                 // 1 deg
};

inline constexpr std::uint8_t pole_pairs = 8;                             // electrical turns per mechanical one
inline constexpr std::uint64_t pwm_period_ps = 300000000;                 // 300 us, and the period of the control tick
inline constexpr bool pwm_centre_aligned = false;                         // else the on-time begins with the period
inline constexpr std::uint64_t dead_time_ps = 0;                          // 0 us
inline constexpr bool commutate_at_sample = false;                        // else in the Hall interrupt
inline constexpr bool command_delayed = false;                            // a command counts from the next period on

constexpr sixstep::control::DriveConfig<Scalar> make_drive() {
  using namespace sixstep::control;
  DriveConfig<Scalar> c;
  c.mode = Mode::current;
  c.chopping = Chopping::soft;
  c.current_control = CurrentControl::pi;
  c.speed_control = SpeedControl::cascade;
  c.hysteresis.watch = Watch::motor;
  c.current.d1 = Gain<Scalar>::from_raw(22511, 12);                       // 2.93109301 V/A, held as 2.93112
  c.current.K_i = Gain<Scalar>::from_raw(25336, 13);                      // 1.64947441 V/A, held as 1.64948: d1 + d0, per sample
  c.current.limit = Scalar::from_raw(32767);                              // 24 V
  c.hysteresis.band_A = Scalar::from_raw(146);                            // 0.2 A, held as 0.200507
  c.nominal_bus_V = Divisor<Scalar>::from_reciprocal(Gain<Scalar>::from_raw(16385, 14));  // 24 V, held as 23.9993: duty 1
  return c;
}
inline constexpr sixstep::control::DriveConfig<Scalar> drive = make_drive();

}  // namespace exported
