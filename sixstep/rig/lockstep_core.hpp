// SPDX-License-Identifier: Apache-2.0
// A core in parallel to the board's own drive: each call of an entry also goes to the core. The plant does
// not advance until the core has answered, and the core's answer must equal the host's bit by bit. The
// transport of calls and answers is outside the library (faces/loop/).
#pragma once
#include <cstddef>
#include <cstdint>

#include "sixstep/rig/core_call.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

/// Trouble with a core or chip.
enum class CoreTrouble : std::uint8_t {
  none,
  silent,   ///< the core did not answer in time
  gone,     ///< the core's program ended
  differs,  ///< the core's answer differs from the host's answer
  stalled   ///< a chip with its own clock no longer samples
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
  /// Returns the host's command if the core agrees. If the core is in trouble, now or before, returns a
  /// command with a fault, which turns the bridge off.
  template <class Call, class Command>
  Command held(const Call& call, const Command& host, const sim::Instant& at) {
    if (agrees(call, answer_of(host), at)) return host;
    Command off{};
    off.fault = true;
    return off;
  }
  /// True if there is no trouble so far and the core's answer equals `wanted`.
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
