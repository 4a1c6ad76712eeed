// SPDX-License-Identifier: Apache-2.0
// The caller of the C library takes the controller's place. The engine calls a controller or a chip. Both
// read what the caller has set, and store what the engine gives them.
#pragma once
#include <cstdint>
#include <string>

#include "faces/c/rooms.hpp"
#include "faces/c/sixstep.h"
#include "sixstep/rig/chip_port.hpp"

namespace c_face {

/// What the caller has set, and what the controller was last given.
struct Exchange {
  sixstep_answer answer{};
  sixstep_measured measured{};
  double setpoint = 0.0;
  std::uint32_t gates = 0;
  std::int64_t stop_ps = never_ps;  ///< next instant at which a run with SIXSTEP_CHIP_GATES stops

  static constexpr std::int64_t never_ps = std::int64_t{1} << 62;
};

/// While this object lives, runs that its thread advances use `exchange`. A run has no pointer to it, so that
/// a copy of the run is independent.
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

/// The controller that answers with Exchange::answer: a pair, or three legs.
const sixstep_controller* caller_controller(bool legs);

/// The chip that sets Exchange::gates. Its clock counts picoseconds.
rig::ChipPort caller_chip();

}  // namespace c_face
