// SPDX-License-Identifier: Apache-2.0
// A core beside the board's own drive: each call of an entry also goes to it, the plant stands still until it has answered, and
// its answer must be the host's, to the bit. What carries calls and answers stands outside the library (faces/loop/).
#pragma once
#include <cstddef>
#include <cstdint>

#include "sixstep/rig/core_call.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

/// What is wrong with a core.
enum class CoreTrouble : std::uint8_t {
  none,
  silent,   ///< it did not answer in time
  gone,     ///< it ended
  differs,  ///< its answer is not the host's
  stalled   ///< of a chip that keeps its own time: it samples no longer
};

/// Whoever carries calls to a core and answers back; none: `ask` is null.
struct CorePort {
  void* core = nullptr;
  /// Sends `call`, waits, fills `answer`.
  CoreTrouble (*ask)(void* core, const void* call, std::size_t call_bytes, void* answer,
                     std::size_t answer_bytes) = nullptr;

  explicit operator bool() const { return ask != nullptr; }
};

class LockstepCore {
 public:
  explicit LockstepCore(const CorePort& port) : port_(port) {}

  bool there() const { return static_cast<bool>(port_); }
  /// Where the core is in trouble, or gets into it now, an answer that turns the bridge off and is a fault.
  template <class Call, class Command>
  Command held(const Call& call, const Command& host, const sim::Instant& at) {
    if (agrees(call, answer_of(host), at)) return host;
    Command off{};
    off.fault = true;
    return off;
  }
  /// Whether the core is in order, and answers that.
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
