// SPDX-License-Identifier: Apache-2.0
// clang-format off
// Made by sixstep 0.1.0. Change the scenario, not this file:
//   sixstep export header data/scenarios/firmware/cortex-m.toml --arithmetic float --out faces/firmware/example/cortex_m/drive_config.hpp
//
// C++20, which avr-gcc 5 and 7 (Debian 12, the Arduino IDE) lack. For the AVR use clang 19 or later.
//
// scenario  Speed cascade on a Cortex-M: 70 to 300 rad/s on Hall probes
// notes     The drive that faces/firmware/example/cortex_m flashes, from registers: three phase currents, the bus and Hall edges, a command that takes effect one period late. The settling time is the one that sixstep design --scenario on this file allows down to 70 rad/s.
// motor     maxon EC 45 flat 251601: 8 pole pairs, terminal R = 1.03 ohm, L = 0.000572 H, K_t = 0.0335 N m/A; J = 1.35e-05 kg m2
// current   d1 = 4.09559 V/A, d0 = -3.69396 V/A; K_p = d1 = 4.09559 V/A, K_i = (d1 + d0)/T_s = 13387.5 V/(A s); pole placement from settle_s and damping; poles z = 0.869154 +- 0.0581778j (settle_s = 0.001, damping = 0.9) on 0.0510561/(z -0.947412)
// speed     d1 = 0.0158648 per rad/s, d0 = -0.015831 per rad/s; K_p = d1 = 0.0158648 per rad/s, K_i = (d1 + d0)/T_s = 1.12646 per rad; pole placement from settle_s and damping; poles z = 0.996555 +- 0.00166516j (settle_s = 0.04, damping = 0.9) on 0.43333/(z -0.999984)
// Gains are per control period, pwm_period_ps. Speed is mechanical, current positive into the motor.
//
// Cleared by its run: 1.2 s simulated in float, digest b7379fd78e27e564
//   mean speed at 100 rad/s: 99 .. 101 rad/s required, 99.9999 rad/s measured
//   swing at 100 rad/s: <= 10 rad/s required, 0.110335 rad/s measured
//   mean speed at 300 rad/s: 297 .. 303 rad/s required, 300.001 rad/s measured
//   swing at 300 rad/s: <= 15 rad/s required, 0.161188 rad/s measured
//   mean speed at 70 rad/s: 69.3 .. 70.7 rad/s required, 69.9996 rad/s measured
//   swing at 70 rad/s: <= 7 rad/s required, 0.105367 rad/s measured
//   greatest current: <= 10 A required, 9.13387 A measured
// Warnings of that run:
//   control.speed.torque_limit_Nm divided by K_t lets 5.82 A flow, 2.5 times the nominal current of 2.33 A: by the sheet's thermal values the winding withstands this current for 12.8 s from 25 degC, and by the worse ends of the thermal ranges for 6.83 s; no protection of the drive ends this current while the rotor turns: lower the current limit, or apply the load for less than this time
// Note: setpoint_limit = 300 rad/s is the largest reference of this scenario, and the drive limits its setpoint to this value; set [reference] to the largest setpoint of your firmware
// Assumptions of that run:
//   supply    24 V behind 0.05 ohm, 0.002 F at the bridge, takes no current back
//   bridge    switches of 0.01 ohm, diodes of 0.7 V and 0 ohm, dead time 5e-07 s
//   timing    sampled at a period's start, answered one period later; PWM edges not rounded to timer counts
//   currents  phases, 12 bits over +-33 A
//   bus       12 bits over 52.8 V
//   rotor     Hall probes 120 degrees apart, edges exactly at the sector edges (real probes are not; sheet_tolerances of a plan moves each edge by up to 3 deg), captured at 7.2e+07 Hz, speed over six edges if the loop tolerates their delay, else over one edge
//   wires     phases abc at legs a b c, Hall lines 123 at H1 H2 H3
//   load      0.02 N m, 0 kg m2 beside the rotor's
//   heat      winding and magnets constant at 25 degC
//
// Worst costs on a core of a control tick and a Hall interrupt, without an interrupt's entry and exit. They were counted over
// 80 000 recorded periods of the product drive of tests/target/scenarios/ (docs/reference/core-costs.md):
//                               tick    Hall                   flash     RAM
//   Cortex-M0   q15             1971     312 instructions      25748     276 bytes
//   Cortex-M3   q15             1135     172 instructions      22842     276 bytes
//   Cortex-M3   q31             1634     173 instructions      35836     376 bytes
//   Cortex-M4F  float            767     173 instructions      12056     360 bytes
//   Cortex-M4F  q15             1132     172 instructions      22810     276 bytes
//   Cortex-M4F  q31             1635     173 instructions      35844     376 bytes
//   RV32IMC     q15             1117     172 instructions      22400     276 bytes
//   ATmega2560  q15             5365     976 cycles            14594     229 bytes
//   ATmega2560  q31            11568     975 cycles            20552     289 bytes
//   ATmega2560  float           9508     976 cycles            11872     285 bytes
// The counts cover the control code only; an image also contains the board's code.
// Note: a control period of 30 us is shorter than the shortest period of the ATmega2560's image (100 us). Below 69.6 us the STM32F303's image may apply a command one period late: look for `missed` above 0 in its log.
#pragma once
#if __cplusplus < 201709L && !defined(_MSC_VER)
#error "C++20 is needed, which avr-gcc 5 and 7 (Debian 12, the Arduino IDE) lack; use clang 19 for the AVR"
#endif
#include <cstdint>

#include "sixstep/control/protected_drive.hpp"
#include "sixstep/control/units.hpp"

namespace exported {

using Scalar = float;

// Physical values of 1.0; its functions make constants of the board: units.amperes(15)
inline constexpr sixstep::control::Units<Scalar> units{
  .current_A = 0x1p+0,                                                    // 1 A
  .voltage_V = 0x1p+0,                                                    // 1 V
  .speed_rad_s = 0x1p+0,                                                  // 1 rad/s
  .position_deg = 0x1p+0,                                                 // 1 deg
};

inline constexpr bool cleared = true;                                     // for a bridge, by its run
inline constexpr std::uint8_t pole_pairs = 8;                             // electrical turns per mechanical turn
inline constexpr std::uint64_t pwm_period_ps = 30000000;                  // 30 us, and the period of the control tick
inline constexpr bool pwm_centre_aligned = false;                         // true: centred pulse; false: pulse at the period's start
inline constexpr std::uint64_t dead_time_ps = 500000;                     // 0.5 us
inline constexpr bool commutate_at_sample = false;                        // true: at the sample; false: in the Hall interrupt
inline constexpr bool command_delayed = true;                             // true: a command takes effect in the next period; false: at once
inline constexpr bool sampled_in_middle = false;                          // true: sample in the middle of the period; false: at its start
inline constexpr double timer_Hz = 0x1.12a88p+26;                         // 7.2e+07 Hz, counts up and wraps at 2^32

constexpr sixstep::control::DriveConfig<Scalar> make_drive() {
  using namespace sixstep::control;
  DriveConfig<Scalar> c;
  c.mode = Mode::speed;
  c.chopping = Chopping::soft;
  c.current_control = CurrentControl::pi;
  c.speed_control = SpeedControl::cascade;
  c.hysteresis.watch = Watch::motor;                                      // not used by this drive
  c.current.d1 = 0x1.061e1cp+2f;                                          // 4.09558793 V/A
  c.current.d0 = -0x1.d8d3c8p+1f;                                         // -3.69396308 V/A
  c.current.limit = 0x1.8p+4f;                                            // 24 V
  c.hysteresis.band_A = 0x1.99999ap-3f;                                   // 0.2 A; not used by this drive
  c.nominal_bus_V = 0x1.8p+4f;                                            // 24 V: duty 1
  c.speed.d1 = 0x1.03ed9ap-6f;                                            // 0.015864755 per rad/s
  c.speed.d0 = -0x1.035fdep-6f;                                           // -0.0158309613 per rad/s
  c.speed.limit = 0x1p+0f;                                                // 1 of full torque
  c.current_at_full_torque_A = 0x1.74898ep+2f;                            // 5.82089552 A: torque limit divided by the motor's torque per ampere
  c.current_limit_A = 0x1.74898ep+2f;                                     // 5.82089552 A
  return c;
}
inline constexpr sixstep::control::DriveConfig<Scalar> drive = make_drive();

constexpr sixstep::control::ProtectedConfig<Scalar> make_product() {
  using namespace sixstep::control;
  ProtectedConfig<Scalar> c;
  c.drive = drive;
  c.setpoint_limit = 0x1.2cp+8f;                                          // 300 rad/s
  c.sensing = CurrentSensing::phases;
  c.current_adc[0].per_eighth = 0x1.08p-9f;                               // 0.00201416016 A: per eighth of a count
  c.current_adc[0].offset_counts = 2048;                                  // reading without a current
  c.current_adc[0].offset_tolerance = 41;                                 // counts
  c.current_adc[1].per_eighth = 0x1.08p-9f;                               // 0.00201416016 A: per eighth of a count
  c.current_adc[1].offset_counts = 2048;                                  // reading without a current
  c.current_adc[1].offset_tolerance = 41;                                 // counts
  c.current_adc[2].per_eighth = 0x1.08p-9f;                               // 0.00201416016 A: per eighth of a count
  c.current_adc[2].offset_counts = 2048;                                  // reading without a current
  c.current_adc[2].offset_tolerance = 41;                                 // counts
  c.bus_adc.per_eighth = 0x1.a66666p-10f;                                 // 0.00161132812 V: per eighth of a count
  c.shunt.least_duty = 0x1.111112p-1f;                                    // 0.533333333: smallest duty at which a sample shows the current; not used by this drive
  c.shunt.commutation_samples = 4;                                        // samples after a Hall edge that count as the incoming phase's current; not used by this drive
  c.shunt.fade = 0x1.e51338p-1f;                                          // 0.947412231: factor per tick on a current that no sample shows; not used by this drive
  c.speed.sector_rad_s_ticks = 0x1.1f9f14p+23f;                           // 9424777.96 rad/s: this value divided by the timer ticks of a sector is the speed
  c.speed.timeout_ticks = 7200000;                                        // timer ticks without an edge that count as standstill
  c.speed.edges = 6;                                                      // Hall edges over which a speed is averaged
  c.speed.window_ticks = 211515;                                          // timer ticks; if the edges take longer, the speed is measured over one edge
  c.position.per_sector = 0x1.ep+2f;                                      // 7.5 deg: per sector
  c.position.per_fraction = 0x1.ep+2f;                                    // 7.5 deg: per part of a sector
  c.faults.over_current_A = 0x1.ep+3f;                                    // 15 A
  c.faults.over_voltage_V = 0x1.ep+4f;                                    // 30 V
  c.faults.under_voltage_V = 0x1.4p+3f;                                   // 10 V
  c.faults.over_speed_rad_s = 0x1.9p+9f;                                  // 800 rad/s
  c.faults.stall_current_A = 0x1.2p+2f;                                   // 4.5 A
  c.faults.stall_ticks = 10000;                                           // control periods
  c.faults.voltage_ticks = 3;                                             // control periods
  return c;
}
inline constexpr sixstep::control::ProtectedConfig<Scalar> product = make_product();

}  // namespace exported
