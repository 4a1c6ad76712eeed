// SPDX-License-Identifier: Apache-2.0
// Configuration of the virtual board, and the data that a firmware has before its first sample.
#pragma once
#include "sixstep/control/hall.hpp"
#include "sixstep/rig/bases.hpp"
#include "sixstep/rig/chip_port.hpp"
#include "sixstep/rig/front_end_config.hpp"
#include "sixstep/rig/lockstep_core.hpp"
#include "sixstep/rig/pulse.hpp"
#include "sixstep/rig/registers.hpp"
#include "sixstep/rig/wiring.hpp"

namespace sixstep::rig {

struct BoardConfig {
  ModulatorConfig modulator;
  bool commutate_at_sample = false;  ///< true: the drive commutates at a sample; false: at the Hall edge
  bool delayed = false;              ///< true: a command takes effect one period after its sample
  bool sampled_in_middle = false;    ///< true: samples are in the middle of a period; the resulting command
                                     ///< acts from the next period's start
  Bases bases{};                     ///< bases of the controller's numbers
  SensorsConfig sensors{};
  FrontEndConfig front_end{};
  /// Arrangement of the Hall probes. For a drive that can decode only probes 120 degrees apart, the board
  /// converts the codes.
  control::HallArrangement hall_arrangement = control::HallArrangement::degrees_120;
  WireOrder believed_lines = WireOrder::abc;  ///< probes that the drive assumes at pins H1, H2, H3
  double believed_pole_pairs = 0.0;           ///< the motor's pole pairs that the drive assumes; 0: the true
                                              ///< number
  CorePort core{};                            ///< optional core that executes the drive in parallel to the
                                              ///< host
  ChipPort chip{};  ///< optional chip that executes another firmware instead of the drive
};

/// Data that a firmware has before its first sample.
struct PowerUp {
  double pole_pairs = 1.0;
  std::int64_t sector = 0;  ///< electrical sectors since angle 0
  std::uint8_t pins = 0;
  plant::ShaftAngle<double> shaft{};
};

}  // namespace sixstep::rig
