// SPDX-License-Identifier: Apache-2.0
// fake_core HOW IMAGE replaces an emulator. It sends the greeting of faces/loop/core/main.cpp and answers
// three calls of a lean drive with the bridge off. Then it behaves as HOW states. If HOW begins with "chip",
// fake_core replaces faces/loop/avr/board.cpp, and its gates never switch.
#include <unistd.h>

#include <cstring>

#include "sixstep/rig/chip_port.hpp"
#include "sixstep/rig/core_call.hpp"

namespace rig = sixstep::rig;

namespace {

using Call = rig::LeanCall<double>;
using Answer = rig::CoreAnswer<double>;
constexpr int calls = 3, answers = 4;

/// An answer with the bridge off. It is equal to the host's answer in the test.
Answer off() { return rig::answer_of(sixstep::control::BridgeCommand<double>{}); }

template <class T>
void say(const T& words) {
  if (::write(answers, &words, sizeof words) != sizeof words) ::_exit(1);
}

bool heard() {
  Call call;
  return ::read(calls, &call, sizeof call) == sizeof call;
}

/// Answers three runs, each to its end. Then it hangs or returns.
int play_chip(bool means_other, bool hangs) {
  say(rig::ChipGreeting{.answer_bytes = means_other ? 8u : std::uint32_t{sizeof(rig::ChipAnswer)},
                        .clock_Hz = 16'000'000});
  rig::ChipRun run;
  for (int n = 0; n < 3 && ::read(calls, &run, sizeof run) == sizeof run; ++n) {
    if (run.asks_for_times != 0)
      say(rig::ChipTimes{.periods = 7});
    else
      say(rig::ChipAnswer{.cycle = run.until});
  }
  while (hangs) ::pause();
  return 0;
}

}  // namespace

int main(int, char** arguments) {
  const char* const how = arguments[1];
  const auto is = [how](const char* what) { return std::strcmp(how, what) == 0; };
  if (is("never starts")) return 1;
  if (is("chip") || is("chip hangs") || is("chip means other structs"))
    return play_chip(is("chip means other structs"), is("chip hangs"));
  if (is("says something else")) {
    say(rig::CoreGreeting{.word = 7});
    return 0;
  }
  const std::uint32_t more = is("means other structs") ? 4 : 0;
  say(rig::CoreGreeting{.call_bytes = std::uint32_t{sizeof(Call)} + more, .answer_bytes = sizeof(Answer)});
  for (int n = 0; n < 3 && heard(); ++n) say(off());
  if (!heard()) return 0;
  if (is("hangs"))
    for (;;) ::pause();
  if (is("differs")) say(Answer{.enabled = 1});
  if (is("sends half")) {
    const Answer answer = off();
    return ::write(answers, &answer, sizeof answer / 2) > 0 ? 0 : 1;
  }
  while (is("goes on")) {
    say(off());
    if (!heard()) return 0;
  }
  return 0;
}
