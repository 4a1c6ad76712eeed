// SPDX-License-Identifier: Apache-2.0
// A core that executes the same drive as the board, in parallel. Each call of the drive is also sent to the
// core. The plant waits for the core's answer, which must equal the host's answer bit by bit. faces/loop/
// transports calls and answers.
#pragma once
#include <cstddef>
#include <cstdint>

#include "sixstep/rig/core_call.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

/// Failure of a core or chip.
enum class CoreTrouble : std::uint8_t {
  none,
  silent,   ///< the core did not answer in time
  gone,     ///< the core's program ended
  differs,  ///< the core's answer differs from the host's answer
  stalled   ///< a chip no longer samples
};

/// Transport of calls to a core and of its answers; `ask` is null if there is no core.
struct CorePort {
  void* core = nullptr;
  /// Sends `call`, waits for the answer and writes it to `answer`. Returns CoreTrouble::none on success.
  CoreTrouble (*ask)(void* core, const void* call, std::size_t call_bytes, void* answer,
                     std::size_t answer_bytes) = nullptr;

  explicit operator bool() const { return ask != nullptr; }
};

class LockstepCore {
 public:
  explicit LockstepCore(const CorePort& port) : port_(port) {}

  bool there() const { return static_cast<bool>(port_); }
  /// Returns the host's command if the core's answer is equal. After any failure of the core, returns a
  /// command with a fault, which turns the bridge off.
  template <class Call, class Command>
  Command held(const Call& call, const Command& host, const sim::Instant& at) {
    if (agrees(call, answer_of(host), at)) return host;
    Command off{};
    off.fault = true;
    return off;
  }
  /// True if the core has had no failure and its answer equals `wanted`.
  template <class Call, class Answer>
  bool agrees(const Call& call, const Answer& wanted, const sim::Instant& at) {
    if (trouble_ != CoreTrouble::none) return false;
    Answer answer{};
    trouble_ = port_.ask(port_.core, &call, sizeof call, &answer, sizeof answer);
    if (trouble_ == CoreTrouble::none && !(answer == wanted)) trouble_ = CoreTrouble::differs;
    if (trouble_ == CoreTrouble::none) return true;
    at_ = at;
    return false;
  }
  CoreTrouble trouble() const { return trouble_; }
  const sim::Instant& at() const { return at_; }

 private:
  CorePort port_;
  CoreTrouble trouble_ = CoreTrouble::none;
  sim::Instant at_{};
};

}  // namespace sixstep::rig
