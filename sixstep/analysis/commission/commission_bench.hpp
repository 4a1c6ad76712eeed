// SPDX-License-Identifier: Apache-2.0
// The bench on which a drive finds out what hangs at it (control/commissioning/): a board as one is built, the motor on it
// with a free shaft, and what an engineer who has the motor in the hand would ask of the test: how much current, for how
// long, how slowly. The chip is told the board and that wish, and nothing of the motor.
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
  std::string motor{};                ///< name or path, as a scenario is to have it
  design::Sheet sheet{};              ///< of that motor
  std::optional<double> voltage_V{};  ///< of the bus; else the sheet's nominal voltage
  std::optional<double>
      current_A{};      ///< of the test; else twice nominal, or twice a tenth of what full duty drives
  rig::Wiring wires{};  ///< how phases and Hall lines are plugged in
  double hall_offset_deg = 0.0;  ///< electrical, of all edges
  int seed = 0;                  ///< of the converters' noise
};

/// Where the test's current comes from.
enum class TestCurrent : std::uint8_t {
  asked_for,
  twice_nominal,
  twice_tenth_of_stall,  ///< the sheet names no nominal current (design/loops/operating_limits.hpp)
  half_of_most           ///< either of them is more than half of what the bus drives along a phase
};

/// What the motor is, as the board's terminals have it, with the winding at `degC`.
struct CommissionTruth {
  double degC = 25.0;
  double R_ohm = 0.0;            ///< of a phase and of a switch, as the chip is to find it
  double L_H = 0.0;              ///< of a phase, along the magnet's axis
  double flux_linkage_Vs = 0.0;  ///< of the fundamental, peak
  bool sine = true;  ///< the back-EMF has no harmonics: a standing field holds the rotor where it points
  double cogging_Nm = 0.0;  ///< sum of the orders' peaks
  double beyond_L_H = 0.0;  ///< by which the inductance across the magnet's axis is larger
};

struct CommissionBench {
  study::Compiled compiled;  ///< plant, board and wires of the bench
  control::CommissioningBoard board;
  control::CommissioningWish wish;
  CommissionTruth truth;
  double voltage_V = 0.0;
  TestCurrent from = TestCurrent::asked_for;  ///< wish.test_A
  bool nominal_printed = true;                ///< the sheet names a nominal current
  double noise_A = 0.0;                       ///< of each current's sample, rms
  double longest_s = 0.0;                     ///< until when the chip should have ended
};

/// Problems name `voltage_V`, `current_A` or `hall_offset_deg`, or are the sheet's; a motor that this test cannot be made
/// with is one, too, and says why.
base::Result<CommissionBench> commission_bench(const CommissionSubject& subject);

}  // namespace sixstep::analysis
