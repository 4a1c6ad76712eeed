// SPDX-License-Identifier: Apache-2.0
// Passes the inputs of the tape (tape.hpp) to a user's controller, and prints these lines:
//
//   own CONFIG STATE NAME both sizes on this processor in bytes, and the name of the controller
//   answers CALLS         the number of calls, if all answers are equal to the host's answers
//   differs CALL          if an answer differs: the number of the first such call, counted from 1
//   room BYTES            if a configuration or a state is too large: its size
//   design WORDS          if the controller refuses the inputs on this processor only: its message
//
// Other programs count the cycles: avr_board.cpp, count_instructions.cpp.
#include "tests/target/own/entries.h"
#include "tests/target/own/tape.hpp"
#include "tests/target/platform/platform.hpp"
#include "tests/target/platform/print.hpp"

extern "C" {
void call_tick();  ///< in calls.S, or defined below
void call_hall();
// The sizes are small enough for the smallest board.
#ifdef __AVR__
std::uint64_t own_config[128], own_state[256];
#else
std::uint64_t own_config[256], own_state[512];
#endif
sixstep_measured own_measured;
sixstep_real own_setpoint;
sixstep_answer own_answer;
}
#if !defined TARGET_CALLS_ARE_MARKED
void call_tick() { target::call_entry(false, entry_tick); }
void call_hall() { target::call_entry(true, entry_hall); }
#endif

namespace target {
namespace {

class Tape {
 public:
  bool ended() {
    if (at_ == came_) {
      came_ = refill("own.tape", chunk_, sizeof chunk_);
      at_ = 0;
    }
    return came_ == 0;
  }
  std::uint8_t byte() { return ended() ? std::uint8_t{0} : chunk_[at_++]; }
  std::uint32_t word() {
    std::uint32_t x = 0;
    for (std::uint8_t n = 0; n < 4; ++n) x |= static_cast<std::uint32_t>(byte()) << (8 * n);
    return x;
  }
  float number() { return __builtin_bit_cast(float, word()); }

 private:
  std::uint8_t chunk_[512];
  std::uint16_t at_ = 0, came_ = 0;
} tape;

template <class Memory>
void clear(Memory& memory) {
  for (auto& word : memory) word = 0;
}

bool fits(const sixstep_controller& own) {
  print("own ");
  print_number(own.config_bytes);
  print(" ");
  print_number(own.state_bytes);
  print(" ");
  print(own.name);
  print("\n");
  const bool fit = own.config_bytes <= sizeof own_config && own.state_bytes <= sizeof own_state;
  if (!fit) {
    print("room ");
    print_number(own.config_bytes <= sizeof own_config ? sizeof own_state : sizeof own_config);
    print("\n");
  }
  return fit;
}

const char* design(const sixstep_controller& own) {
  static float values[64];
  sixstep_given given{};
  bytes_of_given(given, [](std::uint8_t& x) { x = tape.byte(); });
  numbers_of_given(given, [](float& x) { x = tape.number(); });
  const std::uint8_t count = tape.byte();
  for (std::uint8_t n = 0; n < count; ++n) values[n % 64] = tape.number();
  clear(own_config);
  return own.design(&given, values, own_config);
}

void start(const sixstep_controller& own) {
  clear(own_state);
  own_answer = sixstep_answer{};
  if (own.start != nullptr) own.start(own_config, own_state);
}

void call(Call which) {
  own_measured.hall = tape.byte();
  if (which == Call::hall) return call_hall();
  numbers_of_measured(own_measured, [](float& x) { x = tape.number(); });
  own_setpoint = tape.number();
  call_tick();
}

void tell(const char* what, std::uint32_t number) {
  print(what);
  print_number(number);
  print("\n");
}

}  // namespace

void run() {
  const sixstep_controller& own = *sixstep_own_controller();
  if (!fits(own)) return;
  Digest digest;
  std::uint32_t calls = 0;
  while (!tape.ended()) {
    const Call which = static_cast<Call>(tape.byte());
    if (which == Call::design) {
      if (const char* wrong = design(own)) return print("design "), print(wrong), print("\n");
    } else if (which == Call::start) {
      start(own);
    } else {
      call(which);
      mix_answer(digest, own_answer);
      ++calls;
      if (digest.value() != tape.word()) return tell("differs ", calls);
    }
  }
  tell("answers ", calls);
}

}  // namespace target
