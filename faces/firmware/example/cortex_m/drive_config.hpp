// SPDX-License-Identifier: Apache-2.0
// clang-format off
// Made by sixstep 0.1.0. Change the scenario, not this file:
//   sixstep export header data/scenarios/thesis/7.4-speed-exact-design.toml --arithmetic float --despite 'an example, for no board' --out faces/firmware/example/cortex_m/drive_config.hpp
//
// scenario  7.4 Speed cascade, the same rule evaluated exactly
// motor     maxon EC 45 flat 251601: 8 pole pairs, terminal R = 1.03 ohm, L = 0.000572 H, K_t = 0.0335 N m/A; J = 1.35e-05 kg m2
// current   d1 = 4.09559 V/A, d0 = -3.69396 V/A; pole placement from settle_s and damping; poles z = 0.869154 +- 0.0581778j (settle_s = 0.001, damping = 0.9) on 0.0510561/(z -0.947412)
// speed     d1 = 0.0158299 per rad/s, d0 = -0.0156961 per rad/s; pole placement from settle_s and damping; poles z = 0.986273 +- 0.006592j (settle_s = 0.01, damping = 0.9) on 1.73332/(z -0.999984)
// Gains are per control period, pwm_period_ps. Speed is mechanical, current positive into the motor.
//
// NOT CLEARED FOR A BRIDGE. Written all the same, for this reason:
//   an example, for no board
// What was overridden:
//   sensors.rotor = "ideal" tells the drive speed and position at every instant, and a board has the Hall edges; set rotor = "hall"
//   sensors.currents = "ideal" tells the drive currents that no amplifier and converter have been through; set currents = "phases" or "dc-link", and current_range_A
//   pwm.delay_periods = 0 answers a sample at the instant it is taken, and a chip has to convert and compute first; set delay_periods = 1, or sample = "middle"
// Its run: 0.5 s simulated in float, digest 9ce8a6380453a6ee
//   mean speed at 100 rad/s, at 0.2 s: 99.9 .. 100.1 rad/s required, 99.9972 rad/s measured
//   mean speed at 102 rad/s, at 0.3 s: 101.898 .. 102.102 rad/s required, 102.01 rad/s measured
//   mean speed at 104 rad/s, at 0.4 s: 103.896 .. 104.104 rad/s required, 104.005 rad/s measured
//   mean speed at 102 rad/s, at 0.5 s: 101.898 .. 102.102 rad/s required, 102.007 rad/s measured
// That run took for granted:
//   supply    24 V, stiff, takes current back
//   bridge    switches of 0 ohm, diodes of 0 V and 0 ohm, dead time 0 s
//   timing    sampled at a period's start, answered at once; edges on no counter's steps
//   currents  as they are
//   bus       as it is
//   rotor     as it is
//   load      0 N m, 0 kg m2 beside the rotor's
#pragma once
#include <cstdint>

#include "sixstep/control/drive.hpp"
#include "sixstep/control/units.hpp"

namespace exported {

using Scalar = float;

// What 1.0 means; constants of the board are made by its functions: units.amperes(15)
inline constexpr sixstep::control::Units<Scalar> units{
  .current_A = 0x1p+0,                                                    // 1 A
  .voltage_V = 0x1p+0,                                                    // 1 V
  .speed_rad_s = 0x1p+0,                                                  // 1 rad/s
  .position_deg = 0x1p+0,                                                 // 1 deg
};

inline constexpr std::uint8_t pole_pairs = 8;                             // electrical turns per mechanical one
inline constexpr std::uint64_t pwm_period_ps = 30000000;                  // 30 us, and the period of the control tick
inline constexpr bool pwm_centre_aligned = false;                         // else the on-time begins with the period
inline constexpr std::uint64_t dead_time_ps = 0;                          // 0 us
inline constexpr bool commutate_at_sample = false;                        // else in the Hall interrupt
inline constexpr bool command_delayed = false;                            // a command counts from the next period on

constexpr sixstep::control::DriveConfig<Scalar> make_drive() {
  using namespace sixstep::control;
  DriveConfig<Scalar> c;
  c.mode = Mode::speed;
  c.chopping = Chopping::soft;
  c.current_control = CurrentControl::pi;
  c.speed_control = SpeedControl::cascade;
  c.hysteresis.watch = Watch::motor;
  c.current.d1 = 0x1.061e1cp+2f;                                          // 4.09558793 V/A
  c.current.d0 = -0x1.d8d3c8p+1f;                                         // -3.69396308 V/A
  c.current.limit = 0x1.8p+4f;                                            // 24 V
  c.hysteresis.band_A = 0x1.99999ap-3f;                                   // 0.2 A
  c.nominal_bus_V = 0x1.8p+4f;                                            // 24 V: duty 1
  c.speed.d1 = 0x1.035b68p-6f;                                            // 0.0158298993 per rad/s
  c.speed.d0 = -0x1.012a46p-6f;                                           // -0.0156961146 per rad/s
  c.speed.limit = 0x1p+0f;                                                // 1 of full torque
  c.current_at_full_torque_A = 0x1.74898ep+4f;                            // 23.2835821 A: torque limit over K_t
  c.current_limit_A = 0x1.74898ep+4f;                                     // 23.2835821 A
  return c;
}
inline constexpr sixstep::control::DriveConfig<Scalar> drive = make_drive();

}  // namespace exported
