// SPDX-License-Identifier: Apache-2.0
// fake_core.cpp simulates an emulated core with a fault. ./test --target runs the real cores
// (tests/target/loop.py).
#include "faces/loop/emulator.hpp"

#include <gmock/gmock.h>

#include <chrono>

namespace loop {
namespace SIXSTEP_TEST_FILE {

using rig::CoreTrouble;
using ::testing::HasSubstr;
using Command = sixstep::control::BridgeCommand<double>;

Core playing(const char* how) { return {"fake", "Fake", {}, {FAKE_CORE, how}, "", "", {}}; }

/// A drive that turns the bridge off, so that the host's answers are equal to the answers of fake_core.
struct Asked {
  Core core;
  std::unique_ptr<Emulator> emulator;
  rig::LockstepCore beside;

  explicit Asked(const char* how)
      : core(playing(how)), emulator(std::move(*Emulator::start(core, "image"))), beside(emulator->port()) {}
  Command answer(std::int64_t tick) { return beside.held(rig::LeanCall<double>{}, Command{}, {tick, 0.0}); }
  /// The number of calls without a fault before the first call with a fault, at most `most`.
  int well_answered(int most) {
    for (int n = 0; n < most; ++n)
      if (answer(n).fault) return n;
    return most;
  }
};

TEST(Emulator, CallsAreAnsweredAndCounted) {
  Asked asked("goes on");
  EXPECT_EQ(asked.well_answered(1000), 1000);
  EXPECT_EQ(asked.emulator->calls(), 1000u);
  EXPECT_EQ(asked.beside.trouble(), CoreTrouble::none);
}

TEST(Emulator, AnAnswerThatIsNotTheHostsIsTroubleFromThere) {
  Asked asked("differs");
  EXPECT_EQ(asked.well_answered(10), 3);
  EXPECT_EQ(asked.beside.trouble(), CoreTrouble::differs);
  EXPECT_EQ(asked.beside.at().ticks, 3);
  EXPECT_TRUE(asked.answer(4).fault);
  EXPECT_EQ(asked.emulator->calls(), 4u) << "a core in trouble is asked no more";
}

TEST(Emulator, OneThatMeansOtherStructsIsAskedNothing) {
  Asked asked("means other structs");
  EXPECT_EQ(asked.well_answered(10), 0);
  EXPECT_EQ(asked.beside.trouble(), CoreTrouble::differs);
  EXPECT_EQ(asked.emulator->calls(), 0u);
}

TEST(Emulator, OneThatEndsIsGoneAtOnce) {
  for (const char* how : {"ends", "sends half"}) {
    Asked asked(how);
    EXPECT_EQ(asked.well_answered(10), 3) << how;
    EXPECT_EQ(asked.beside.trouble(), CoreTrouble::gone) << how;
  }
}

TEST(Emulator, OneThatHangsIsSilentAfterFiveSeconds) {
  Asked asked("hangs");
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(asked.well_answered(10), 3);
  EXPECT_EQ(asked.beside.trouble(), CoreTrouble::silent);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(4900));
}

TEST(Emulator, WhatDoesNotStartIsTold) {
  for (const char* how : {"never starts", "says something else"}) {
    const Core core = playing(how);
    const auto emulator = Emulator::start(core, "image");
    ASSERT_FALSE(emulator) << how;
    EXPECT_THAT(base::to_string(emulator.problems().front()), HasSubstr("ended before the program ran"))
        << how;
  }
  Core missing = playing("ends");
  missing.emulator.front() = "no-such-emulator";
  const auto emulator = Emulator::start(missing, "image");
  ASSERT_FALSE(emulator);
  EXPECT_THAT(base::to_string(emulator.problems().front()), HasSubstr("is not installed on this machine"));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace loop
