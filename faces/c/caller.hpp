// SPDX-License-Identifier: Apache-2.0
// The caller of the C library acts as the controller. The engine calls an adapter: a controller or a chip.
// The adapter answers with the caller's last command. The controller also stores its measurement for the
// caller.
#pragma once
#include <cstdint>
#include <string>

#include "faces/c/rooms.hpp"
#include "faces/c/sixstep.h"
#include "sixstep/rig/chip_port.hpp"

namespace c_face {

/// The caller's last command, and the last measurement and setpoint of the controller.
struct Exchange {
  sixstep_answer answer{};
  sixstep_measured measured{};
  double setpoint = 0.0;
  std::uint32_t gates = 0;
  std::int64_t stop_ps = never_ps;  ///< next instant at which a run with SIXSTEP_CHIP_GATES stops

  static constexpr std::int64_t never_ps = std::int64_t{1} << 62;
};

/// While this object exists, each run that its thread advances uses `exchange`. A run contains no pointer to
/// `exchange`, so a copy of the run is independent.
class Exchanging {
 public:
  explicit Exchanging(Exchange& exchange);
  ~Exchanging();
  Exchanging(const Exchanging&) = delete;
  Exchanging& operator=(const Exchanging&) = delete;

 private:
  Exchange* before_;
};

/// Name of the caller's controller in a scenario.
inline const std::string caller_name = "caller";

/// The controller that answers with Exchange::answer: three legs if `legs`, else a driven pair.
const sixstep_controller* caller_controller(bool legs);

/// The chip that applies Exchange::gates. Its clock counts picoseconds.
rig::ChipPort caller_chip();

}  // namespace c_face
