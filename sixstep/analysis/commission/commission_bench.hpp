// SPDX-License-Identifier: Apache-2.0
// Creates the test bench for commissioning (control/commissioning/): a usual board, the motor with a free
// shaft, and the settings of the test for this motor (current, durations, speeds). The chip receives the
// board's data and these settings, but no data of the motor.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "sixstep/base/result.hpp"
#include "sixstep/control/commissioning/commissioning_result.hpp"
#include "sixstep/rig/wiring.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::analysis {

struct CommissionSubject {
  std::string motor{};                ///< name or path, for the scenario
  design::Sheet sheet{};              ///< sheet of the motor
  std::optional<double> voltage_V{};  ///< bus voltage; empty: the sheet's nominal voltage
  std::optional<double> current_A{};  ///< test current; empty: chosen by a rule of TestCurrent
  rig::Wiring wires{};                ///< connections of phases and Hall lines
  double hall_offset_deg = 0.0;       ///< offset common to all edges, electrical degrees
  int seed = 0;                       ///< seed of the converters' noise
};

/// Origin of the test current.
enum class TestCurrent : std::uint8_t {
  asked_for,
  twice_nominal,
  twice_tenth_of_stall,  ///< twice a tenth of the stall current: the sheet has no nominal current
  half_of_most           ///< half of the current that bus and rotor allow: the other rules exceed this value
};

/// The motor's true values at the board's terminals, with the winding at `degC`.
struct CommissionTruth {
  double degC = 25.0;
  double R_ohm = 0.0;            ///< resistance of a phase with its switch or diode, as the chip measures it
  double L_H = 0.0;              ///< inductance of a phase, along the magnet's axis
  double flux_linkage_Vs = 0.0;  ///< flux linkage of the fundamental, peak
  bool sine = true;  ///< true: the back-EMF has no harmonics; the rotor then aligns with a standing field
                     ///< exactly
  double cogging_Nm = 0.0;  ///< cogging torque: sum of the peaks of all harmonics
  double beyond_L_H = 0.0;  ///< L_q - L_d: inductance across the magnet's axis minus inductance along this
                            ///< axis
};

struct CommissionBench {
  study::Compiled compiled;  ///< plant, board and wires of the bench
  control::CommissioningBoard board;
  control::CommissioningWish wish;
  CommissionTruth truth;
  double voltage_V = 0.0;
  TestCurrent from = TestCurrent::asked_for;  ///< how wish.test_A was chosen
  bool nominal_printed = true;                ///< true: the sheet has a nominal current
  double noise_A = 0.0;                       ///< noise of each current's sample, rms
  double longest_s = 0.0;                     ///< time in s after which the chip must have ended
};

/// Problems name `voltage_V`, `current_A` or `hall_offset_deg`, or come from the sheet. A motor that cannot
/// be commissioned is a Problem with the reason.
base::Result<CommissionBench> commission_bench(const CommissionSubject& subject);

}  // namespace sixstep::analysis
