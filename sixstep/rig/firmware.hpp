// SPDX-License-Identifier: Apache-2.0
// Inputs and results of all firmwares for the virtual board. The rig uses a firmware through the interface of
// any_drive.hpp; a test may also use a firmware directly. The library's six-step drives:
//
//                 input of a tick                    a Hall edge           a fault              reports
//   LeanDrive     ideal values in controller units   on_hall               ends the run         -
//   SensedDrive   the same through [sensors]         captured, on_hall     ends the run         broken line,
//                                                                                               lost sensor
//   ProductDrive  registers: counts, pins, counter   protected_on_hall     off, run continues   reason, line,
//                                                                                               when
//
// LeanDrive and SensedDrive (lean_drive.hpp) execute control/drive.hpp. ProductDrive (product_drive.hpp)
// executes control/protected_drive.hpp, with offset calibration, Hall decoding, fault monitor and state
// machine.
//
// The type of a firmware's command determines the modulator (modulator.hpp). hall_interrupt() and reversed()
// are for six-step only. A firmware that commands three legs does not need these functions.
#pragma once
#include "sixstep/base/angle.hpp"
#include "sixstep/control/sensorless/lock.hpp"
#include "sixstep/plant/plant.hpp"
#include "sixstep/rig/board_config.hpp"
#include "sixstep/rig/own_answer.hpp"
#include "sixstep/rig/sensors.hpp"

namespace sixstep::rig {

/// State of plant and board at a firmware's sample.
template <class Real>
struct SampleInstant {
  const plant::State<Real>& state;
  const plant::Legs& legs;
  Real pole_pairs{};
  sim::Instant at{};
  std::uint64_t number = 0;  ///< index of the sample
  std::uint8_t pins = 0;
  bool reversed = false;    ///< sign of the six-step command in effect
  double duty = 0.0;        ///< duty of the command in effect; the DC link's shunt is evaluated by it
  std::uint8_t shunts = 0;  ///< legs with a low-side shunt, as bits; 0: the currents are not measured so
  LowSideSample low_side{};
  const FrontEndReading* seen =
      nullptr;  ///< values at the converters' inputs; null if the board's front end has no lag
};

/// Findings of a firmware about a fault, and how often its low-side shunts showed too little.
struct Diagnosis {
  std::uint16_t faults = 0;    ///< bits of control::Fault that turned the drive off
  std::uint8_t hall_line = 0;  ///< 1..3: the line that caused an invalid code; 0: no line, or unknown
  sim::Instant at{};           ///< tick at which the faults were latched, or at which the rotor was last lost
  int losses = 0;              ///< number of times that a sensorless drive lost the rotor or failed to start
                               ///< it
  control::LockLoss lost = control::LockLoss::none;    ///< reason of the last loss
  bool gave_up = false;                                ///< true: the drive does not start again
  int unseen = 0;                                      ///< number of times that pulses did not determine the
                                                       ///< rotor's angle
  double north = 0.0;                                  ///< last result of the pulses: signal divided by noise
  double certain = 0.0;                                ///< least sufficient value of `north`
  ShaftFinding shaft{};                                ///< reason why an encoder or resolver counts as lost
  OwnFinding own{};                                    ///< error in the answer of a user's controller
  CoreTrouble core = CoreTrouble::none;                ///< trouble of a core in parallel to the host
  std::uint32_t shunt_samples = 0, blind_samples = 0;  ///< samples of low-side shunts; those without a result
};

/// New configuration of a running chip (control/retune.hpp).
template <class Config>
struct Tuning {
  Config config;
  double setpoint_unit = 1.0;  ///< base of the mode's setpoint
};

/// The plant's values as measurements without error, in the controller's numbers.
template <class Scalar, class Real>
control::Measurement<Scalar> ideal_measurement(const SampleInstant<Real>& instant, const Bases& u) {
  const plant::State<Real>& s = instant.state;
  // mutant: s.x * Real(180) / Real(base::pi) => s.x
  const Real sector_deg = static_cast<Real>(s.sector) * 60 + s.x * Real(180) / Real(base::pi);
  return {.i_a_A = from_si<Scalar>(s.i[0], u.current_A),
          .i_b_A = from_si<Scalar>(s.i[1], u.current_A),
          .i_c_A = from_si<Scalar>(s.i[2], u.current_A),
          .speed_rad_s = from_si<Scalar>(s.w, u.speed_rad_s),
          .position_deg = from_si<Scalar>(sector_deg / instant.pole_pairs, u.position_deg),
          .bus_V = from_si<Scalar>(s.bus, u.voltage_V),
          .hall = instant.pins};
}

/// True if the firmware's configuration contains the arrangement of the Hall probes. Otherwise the board
/// converts the codes to those of probes 120 degrees apart.
template <class Firmware>
bool reads_arrangement([[maybe_unused]] const typename Firmware::Config& config) {
  if constexpr (requires { Firmware::reads_arrangement(config); })
    return Firmware::reads_arrangement(config);
  else
    return requires { requires Firmware::decodes_arrangement; };
}

/// Values at the inputs of converters and shunt, in SI units.
template <class Real>
Sample sample_of(const SampleInstant<Real>& instant) {
  const plant::State<Real>& s = instant.state;
  Sample sample{.bus_V = static_cast<double>(s.bus),
                .at = instant.at,
                .number = instant.number,
                .duty = instant.duty,
                .reversed = instant.reversed,
                .low_side = instant.low_side,
                .shaft = {s.sector, static_cast<double>(s.x), static_cast<std::int64_t>(instant.pole_pairs)}};
  for (std::size_t k = 0; k < 3; ++k) {
    sample.i_A[k] = static_cast<double>(s.i[k]);
    if (plant::is_high(instant.legs[k])) sample.dc_link_A += sample.i_A[k];
  }
  if (instant.shunts != 0)
    for (std::size_t k = 0; k < 3; ++k)
      if ((instant.shunts >> k & 1) == 0 || !plant::is_low(instant.legs[k])) sample.i_A[k] = 0.0;
  if (instant.seen == nullptr) return sample;
  if (instant.seen->currents) {
    for (std::size_t k = 0; k < 3; ++k) sample.i_A[k] = instant.seen->i_A[k];
    sample.dc_link_A = instant.seen->dc_link_A;
  }
  if (instant.seen->voltages) sample.bus_V = instant.seen->bus_V;
  return sample;
}

}  // namespace sixstep::rig
