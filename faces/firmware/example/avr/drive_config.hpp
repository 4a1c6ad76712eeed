// SPDX-License-Identifier: Apache-2.0
// clang-format off
// Made by sixstep 0.1.0. Change the scenario, not this file:
//   sixstep export header data/scenarios/firmware/avr.toml --arithmetic q15 --range current_A=25 --range setpoint=20 --out faces/firmware/example/avr/drive_config.hpp
//
// scenario  Current loop in Q15 on an AVR: one shunt, a tick every 300 us
// motor     maxon EC 45 flat 251601: 8 pole pairs, terminal R = 1.03 ohm, L = 0.000572 H, K_t = 0.0335 N m/A; J = 0.0001135 kg m2
// current   d1 = 0.720057 V/A, d0 = -0.419524 V/A; given as d1, d0; poles z = 0.708221 and 0.582626 on 0.405217/(z -0.582626); settle_s = 0.001, damping = 0.9 would give d1 = 2.93109, d0 = -1.28162
// Gains are per control period, pwm_period_ps. Speed is mechanical, current positive into the motor.
//
// Cleared by its run: 0.2 s simulated in q15, digest 5d18b491352563c1
//   mean current at 3 A: 2.7 .. 3.3 A required, 2.88645 A measured
//   mean current at 5 A: 4.5 .. 5.5 A required, 4.6484 A measured
//   greatest current: <= 10 A required, 7.66496 A measured
// That run took for granted:
//   supply    24 V, stiff, takes current back
//   bridge    switches of 0.01 ohm, diodes of 0.7 V and 0 ohm, dead time 1e-06 s
//   timing    sampled in the middle of a period, answered one period later; edges on no counter's steps
//   currents  dc-link, 10 bits over +-25 A
//   bus       as it is
//   rotor     Hall edges exactly at the sectors' ends, captured at 1e+06 Hz, speed over six edges where the loop stands their delay, else one
//   load      0 N m, 0.0001 kg m2 beside the rotor's; viscous friction 0.0004 N m s
//   heat      winding and magnets at 25 degC all along
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
//   current integral increment        13.524 of 336
//
// On a core, the current drive of tests/target/scenarios/ takes, by count over 80 000 recorded periods, for a
// control tick and a Hall interrupt at worst, without an interrupt's entry and exit (docs/firmware.md):
//                               tick    Hall                   flash     RAM
//   Cortex-M0   q15              139      62 instructions       1162     124 bytes
//   Cortex-M3   q15              111      29 instructions        966     124 bytes
//   Cortex-M3   q31              172      29 instructions       1434     220 bytes
//   Cortex-M4F  float             87      29 instructions        858     204 bytes
//   Cortex-M4F  q15              111      29 instructions        970     124 bytes
//   Cortex-M4F  q31              170      29 instructions       1458     220 bytes
//   RV32IMC     q15              132      37 instructions       1360     124 bytes
//   ATmega2560  q15              996      42 cycles             2434     129 bytes
//   ATmega2560  q31             2606      42 cycles             4020     197 bytes
//   ATmega2560  float           2176      42 cycles             2046     193 bytes
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
inline constexpr bool pwm_centre_aligned = true;                          // else the on-time begins with the period
inline constexpr std::uint64_t dead_time_ps = 1000000;                    // 1 us
inline constexpr bool commutate_at_sample = false;                        // else in the Hall interrupt
inline constexpr bool command_delayed = true;                             // a command counts from the next period on

constexpr sixstep::control::DriveConfig<Scalar> make_drive() {
  using namespace sixstep::control;
  DriveConfig<Scalar> c;
  c.mode = Mode::current;
  c.chopping = Chopping::soft;
  c.current_control = CurrentControl::pi;
  c.speed_control = SpeedControl::cascade;
  c.hysteresis.watch = Watch::motor;
  c.current.d1 = Gain<Scalar>::from_raw(22120, 14);                       // 0.720057 V/A, held as 0.720052
  c.current.K_i = Gain<Scalar>::from_raw(18465, 15);                      // 0.300533 V/A, held as 0.300537: d1 + d0, per sample
  c.current.limit = Scalar::from_raw(32767);                              // 24 V
  c.hysteresis.band_A = Scalar::from_raw(146);                            // 0.2 A, held as 0.200507
  c.nominal_bus_V = Divisor<Scalar>::from_reciprocal(Gain<Scalar>::from_raw(16385, 14));  // 24 V, held as 23.9993: duty 1
  return c;
}
inline constexpr sixstep::control::DriveConfig<Scalar> drive = make_drive();

}  // namespace exported
