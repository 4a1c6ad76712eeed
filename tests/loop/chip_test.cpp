// SPDX-License-Identifier: Apache-2.0
// fake_core.cpp simulates a chip's emulator with a fault. ./test --target runs the real emulator
// (tests/target/avr.py).
#include "faces/loop/chip.hpp"

#include <gmock/gmock.h>

#include <csignal>

namespace loop {
namespace SIXSTEP_TEST_FILE {

using rig::CoreTrouble;
using ::testing::HasSubstr;

Core playing(const char* how) {
  return {.name = "fake",
          .title = "Fake",
          .compiler = {},
          .emulator = {FAKE_CORE, how},
          .start_up = {},
          .linker_script = {},
          .libraries = {},
          .by_registers = true};
}

TEST(Chip, RunsOnAndTellsItsTimes) {
  const Core core = playing("chip");
  const auto chip = Chip::start(core, "image");
  ASSERT_TRUE(chip);
  const rig::ChipPort port = (*chip)->port();
  EXPECT_EQ(port.clock_Hz, 16'000'000u);
  rig::ChipAnswer answer;
  ASSERT_EQ(port.run(port.chip, {.until = 123}, answer), CoreTrouble::none);
  EXPECT_EQ(answer.cycle, 123u);
  EXPECT_EQ((*chip)->times().periods, 7u);
}

TEST(Chip, OneThatEndsIsGoneAndOneThatHangsIsSilent) {
  std::signal(SIGPIPE, SIG_IGN);  // as the program does
  for (const auto& [how, trouble] :
       {std::pair{"chip", CoreTrouble::gone}, std::pair{"chip hangs", CoreTrouble::silent}}) {
    const Core core = playing(how);
    const auto chip = Chip::start(core, "image");
    ASSERT_TRUE(chip) << how;
    const rig::ChipPort port = (*chip)->port();
    rig::ChipAnswer answer;
    for (int n = 0; n < 3; ++n) ASSERT_EQ(port.run(port.chip, {}, answer), CoreTrouble::none) << how;
    EXPECT_EQ(port.run(port.chip, {}, answer), trouble) << how;
    const bool waits = trouble == CoreTrouble::silent;
    EXPECT_EQ(waits ? 0u : (*chip)->times().periods, 0u) << "of one that is gone nothing is told";
  }
}

TEST(Chip, WhatDoesNotGreetAsOneIsTold) {
  for (const auto& [how, said] :
       {std::pair{"never starts", "ended before the program ran"},
        std::pair{"chip means other structs", "build both programs from the same sources"}}) {
    const Core core = playing(how);
    const auto chip = Chip::start(core, "image");
    ASSERT_FALSE(chip) << how;
    EXPECT_THAT(base::to_string(chip.problems().front()), HasSubstr(said));
  }
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace loop
