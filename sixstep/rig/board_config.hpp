// SPDX-License-Identifier: Apache-2.0
// BoardConfig configures the virtual board; PowerUp is what a firmware may know before its first sample.
#pragma once
#include "sixstep/control/hall.hpp"
#include "sixstep/rig/bases.hpp"
#include "sixstep/rig/chip_port.hpp"
#include "sixstep/rig/front_end_config.hpp"
#include "sixstep/rig/lockstep_core.hpp"
#include "sixstep/rig/pulse.hpp"
#include "sixstep/rig/registers.hpp"

namespace sixstep::rig {

struct BoardConfig {
  ModulatorConfig modulator;
  bool commutate_at_sample = false;  ///< else at the Hall edge itself
  bool delayed = false;              ///< a command takes effect one period after its sample
  bool sampled_in_middle = false;    ///< of the period; the answer takes effect at the next one's start
  Bases bases{};                     ///< of the controller's number
  SensorsConfig sensors{};
  FrontEndConfig front_end{};
  /// Of the probes: what the board makes of their codes for drives that know one arrangement alone.
  control::HallArrangement hall_arrangement = control::HallArrangement::degrees_120;
  CorePort core{};  ///< that runs the drive beside the host
  ChipPort chip{};  ///< that runs a firmware of its own in the drive's place
};

/// What a firmware may know before its first sample.
struct PowerUp {
  double pole_pairs = 1.0;
  std::int64_t sector = 0;  ///< counted from angle 0
  std::uint8_t pins = 0;
  plant::ShaftAngle<double> shaft{};
};

}  // namespace sixstep::rig
