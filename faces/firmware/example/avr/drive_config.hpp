// SPDX-License-Identifier: Apache-2.0
// clang-format off
// Made by sixstep 0.1.0. Change the scenario, not this file:
//   sixstep export header data/scenarios/thesis/7.4-speed-exact-design.toml --set pwm.period_s=100e-6 --arithmetic q15 --range current_A=25 --range bus_V=55 --range setpoint=600 --out faces/firmware/example/avr/drive_config.hpp
//
// scenario  7.4 Speed cascade, the same rule evaluated exactly
// motor     maxon EC 45 flat 251601: 8 pole pairs, terminal R = 1.03 ohm, L = 0.000572 H, K_t = 0.0335 N m/A; J = 1.35e-05 kg m2
// current   d1 = 3.77432 V/A, d0 = -2.72953 V/A; pole placement from settle_s and damping; poles z = 0.615682 +- 0.139482j (settle_s = 0.001, damping = 0.9) on 0.159989/(z -0.835212)
// speed     d1 = 0.0156355 per rad/s, d0 = -0.0152036 per rad/s; pole placement from settle_s and damping; poles z = 0.954805 +- 0.0212754j (settle_s = 0.01, damping = 0.9) on 5.77762/(z -0.999946)
// Gains are per control period, pwm_period_ps. Speed is mechanical, current positive into the motor.
//
// Fixed point: what each quantity may reach and where the format ends, in SI
//   current                               25 of 48.2836
//   current reference with band      23.2836 of 48.2836
//   current error                    48.2836 of 48.2836
//   speed                            716.418 of 1316.42
//   speed error                      1316.42 of 1316.42
//   voltage with feed-forward             24 of 55
//   bus                                   55 of 55
//   current.limit                         24 of 55
//   current integral increment       50.4466 of 770
//   speed.limit                            1 of 0.999969
//   speed integral increment        0.568534 of 13.9996
#pragma once
#include <cstdint>

#include "sixstep/control/drive.hpp"
#include "sixstep/control/units.hpp"

namespace exported {

using Scalar = sixstep::control::Q15;

// What 1.0 means; constants of the board are made by its functions: units.amperes(15)
inline constexpr sixstep::control::Units<Scalar> units{
  .current_A = 0x1.8247cb3f595c5p+5,                                      // 48.2851 A
  .voltage_V = 0x1.b8037006e00dcp+5,                                      // 55.0017 V
  .speed_rad_s = 0x1.491d514618fedp+10,                                   // 1316.46 rad/s
  .position_deg = 0x1p+0,                                                 // 1 deg
};

inline constexpr std::uint8_t pole_pairs = 8;                             // electrical turns per mechanical one
inline constexpr std::uint64_t pwm_period_ps = 100000000;                 // 100 us, and the period of the control tick
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
  c.current.d1 = Gain<Scalar>::from_raw(27144, 13);                       // 3.77432416 V/A, held as 3.77439
  c.current.K_i = Gain<Scalar>::from_raw(30055, 15);                      // 1.04479891 V/A, held as 1.04479: d1 + d0, per sample
  c.current.limit = Scalar::from_raw(14298);                              // 24 V, held as 23.9995
  c.hysteresis.band_A = Scalar::from_raw(136);                            // 0.2 A, held as 0.200402
  c.nominal_bus_V = Divisor<Scalar>::from_reciprocal(Gain<Scalar>::from_raw(18774, 13));  // 24 V, held as 23.9999: duty 1
  c.speed.d1 = Gain<Scalar>::from_raw(21077, 10);                         // 0.0156355021 per rad/s, held as 0.0156351
  c.speed.K_i = Gain<Scalar>::from_raw(18630, 15);                        // 0.000431879534 per rad/s, held as 0.000431873: d1 + d0, per sample
  c.speed.limit = Scalar::from_raw(32767);                                // 1 of full torque, held as 0.999969
  c.current_at_full_torque_A = Gain<Scalar>::from_raw(31602, 16);         // 23.2835821 A, held as 23.2835: torque limit over K_t
  c.current_limit_A = Scalar::from_raw(15801);                            // 23.2835821 A, held as 23.2835
  return c;
}
inline constexpr sixstep::control::DriveConfig<Scalar> drive = make_drive();

}  // namespace exported
