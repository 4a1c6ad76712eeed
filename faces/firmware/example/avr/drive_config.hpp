// SPDX-License-Identifier: Apache-2.0
// clang-format off
// Made by sixstep 0.1.0. Change the scenario, not this file:
//   sixstep export header data/scenarios/firmware/avr.toml --arithmetic q15 --out faces/firmware/example/avr/drive_config.hpp
//
// C++20, which avr-gcc 5 and 7 (Debian 12, the Arduino IDE) lack. For the AVR use clang 19 or later.
//
// scenario  Current loop in Q15 on an AVR: a transducer in each phase, a tick every 100 us
// notes     The drive that faces/firmware/example/avr flashes; sixstep run --on avr runs the same program. The period, a fifth of the motor's L/R, is long enough for 16 MHz, and the command takes effect one period late: gains by pole-zero cancellation (sixstep design maxon-251601 --mode current --period 100e-6 --method cancellation --settle 1e-3).
// motor     maxon EC 45 flat 251601: 8 pole pairs, terminal R = 1.03 ohm, L = 0.000572 H, K_t = 0.0335 N m/A; J = 0.0001135 kg m2
// current   d1 = 2.30464 V/A, d0 = -1.92486 V/A; K_p = d1 = 2.30464 V/A, K_i = (d1 + d0)/T_s = 3797.8 V/(A s); given as d1, d0; poles z = 0.83521 and 0.631286 on 0.159989/(z -0.835212); settle_s = 0.001, damping = 0.9 would give d1 = 3.77432, d0 = -2.72953
// Gains are per control period, pwm_period_ps. Speed is mechanical, current positive into the motor.
//
// Cleared by its run: 0.1 s simulated in q15, digest 03054ed6c0aa2944
//   mean of the samples at 3 A: 2.85 .. 3.15 A required, 2.99076 A measured
//   mean of the samples at 5 A: 4.75 .. 5.25 A required, 4.96589 A measured
//   greatest current: <= 9 A required, 6.83261 A measured
// Note: control.drive = "lean" has no protection: the bridge stays on at over-current, over-voltage and a stall; add a protection to your firmware, or export control.drive = "product" with [protection]
// Note: cleared for a supply that takes current back (supply.sinks = true). The voltage of this stiff bus cannot rise; if your supply takes no current back, set supply.resistance_ohm, supply.capacitance_F and supply.sinks = false
// Assumptions of that run:
//   supply    24 V, stiff, takes current back
//   bridge    switches of 0.01 ohm, diodes of 0.7 V and 0 ohm, dead time 1e-06 s
//   timing    sampled in the middle of a period, answered one period later; PWM edges not rounded to timer counts
//   currents  phases, 10 bits over +-10 A
//   bus       as it is
//   rotor     Hall probes 120 degrees apart, edges exactly at the sector edges (real probes are not; sheet_tolerances of a plan moves each edge by up to 3 deg), captured at 1e+06 Hz, speed over six edges if the loop tolerates their delay, else over one edge
//   wires     phases abc at legs a b c, Hall lines 123 at H1 H2 H3
//   load      0 N m, 0.0001 kg m2 beside the rotor's; viscous friction 0.0004 N m s
//   heat      winding and magnets constant at 25 degC
//
// Fixed point: largest value of each quantity, and largest value of the format, in SI
//   current                               10 of 19.9994
//   current reference with band            5 of 19.9994
//   current error                         15 of 19.9994
//   speed                            716.418 of 716.418
//   speed error                      716.418 of 716.418
//   voltage with feed-forward             24 of 24
//   bus                                   24 of 24
//   current.limit                         24 of 24
//   current integral increment        5.6967 of 336
//
// Worst costs on a core of a control tick and a Hall interrupt, without an interrupt's entry and exit. They were counted over
// 80 000 recorded periods of the current drive of tests/target/scenarios/ (docs/reference/core-costs.md):
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
// The counts cover the control code only; an image also contains the board's code.
#pragma once
#if __cplusplus < 201709L && !defined(_MSC_VER)
#error "C++20 is needed, which avr-gcc 5 and 7 (Debian 12, the Arduino IDE) lack; use clang 19 for the AVR"
#endif
#include <cstdint>

#include "sixstep/control/drive.hpp"
#include "sixstep/control/units.hpp"

namespace exported {

using Scalar = sixstep::control::Q15;

// Physical values of 1.0; its functions make constants of the board: units.amperes(15)
inline constexpr sixstep::control::Units<Scalar> units{
  .current_A = 0x1.4p+4,                                                  // 20 A
  .voltage_V = 0x1.80030006000cp+4,                                       // 24.0007 V
  .speed_rad_s = 0x1.66384a8781f44p+9,                                    // 716.44 rad/s
  .position_deg = 0x1p+0,                                                 // 1 deg
};

inline constexpr bool cleared = true;                                     // for a bridge that your firmware protects, and whose supply takes current back, by its run
inline constexpr std::uint8_t pole_pairs = 8;                             // electrical turns per mechanical turn
inline constexpr std::uint64_t pwm_period_ps = 100000000;                 // 100 us, and the period of the control tick
inline constexpr bool pwm_centre_aligned = true;                          // true: centred pulse; false: pulse at the period's start
inline constexpr std::uint64_t dead_time_ps = 1000000;                    // 1 us
inline constexpr bool commutate_at_sample = false;                        // true: at the sample; false: in the Hall interrupt
inline constexpr bool command_delayed = true;                             // true: a command takes effect in the next period; false: at once
inline constexpr bool sampled_in_middle = true;                           // true: sample in the middle of the period; false: at its start
inline constexpr int adc_bits = 10;                                       // bits of each current converter
inline constexpr double adc_amperes_per_count = 0x1.4p-6;                 // 0.0195312 A
inline constexpr double setpoint_range = 0x1.4666666666666p+2;            // 5.1: setpoint at each end of a potentiometer, in the mode's unit

constexpr sixstep::control::DriveConfig<Scalar> make_drive() {
  using namespace sixstep::control;
  DriveConfig<Scalar> c;
  c.mode = Mode::current;
  c.chopping = Chopping::soft;
  c.current_control = CurrentControl::pi;
  c.speed_control = SpeedControl::cascade;
  c.hysteresis.watch = Watch::motor;                                      // not used by this drive
  c.current.d1 = Gain<Scalar>::from_raw(31465, 14);                       // 2.30464 V/A
  c.current.K_i = Gain<Scalar>::from_raw(20740, 16);                      // 0.37978 V/A, held as 0.379772: d1 + d0, per sample
  c.current.limit = Scalar::from_raw(32767);                              // 24 V
  c.hysteresis.band_A = Scalar::from_raw(328);                            // 0.2 A, held as 0.200195; not used by this drive
  c.nominal_bus_V = Divisor<Scalar>::from_reciprocal(Gain<Scalar>::from_raw(16385, 14));  // 24 V, held as 23.9993: duty 1
  return c;
}
inline constexpr sixstep::control::DriveConfig<Scalar> drive = make_drive();

}  // namespace exported
