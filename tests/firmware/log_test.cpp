// SPDX-License-Identifier: Apache-2.0
// Tests the output of the examples on a serial line, and the commands that they accept.
#include "faces/firmware/example/log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "faces/firmware/example/commands.hpp"
#include "faces/firmware/example/fault_reason.hpp"

namespace SIXSTEP_TEST_FILE {

std::string written(std::int32_t value, unsigned decimals = 0) {
  std::string out;
  firmware::put_number([&out](char c) { out += c; }, value, decimals);
  return out;
}

TEST(Log, NumbersAsPeopleWriteThem) {
  EXPECT_EQ(written(0), "0");
  EXPECT_EQ(written(-7), "-7");
  EXPECT_EQ(written(1'000'000'000), "1000000000");
  EXPECT_EQ(written(std::numeric_limits<std::int32_t>::min()), "-2147483648");
  EXPECT_EQ(written(std::numeric_limits<std::int32_t>::max()), "2147483647");
  EXPECT_EQ(written(0, 3), "0.000");
  EXPECT_EQ(written(-5, 3), "-0.005");
  EXPECT_EQ(written(12'345, 3), "12.345");
  EXPECT_EQ(written(-1'000, 3), "-1.000");
}

TEST(Log, AnyNumberReadsBack) {
  std::mt19937 random(20'261'127);
  std::uniform_int_distribution<int> bits(0, 31);
  for (int n = 0; n < 20'000; ++n) {
    const auto value = static_cast<std::int32_t>(random() >> bits(random)) * (n % 2 == 0 ? 1 : -1);
    EXPECT_EQ(written(value), std::to_string(value));
    EXPECT_EQ(std::llround(std::strtod(written(value, 3).c_str(), nullptr) * 1000), value);
  }
}

std::string written(const firmware::Instant& t) {
  std::string out;
  firmware::put_instant([&out](char c) { out += c; }, t);
  return out;
}

/// The time does not wrap at 2^31 us (36 minutes), and not at 2^32 counts of 72 MHz (one minute).
TEST(Log, AnInstantIsItsMicrosecondsHoweverLate) {
  EXPECT_EQ(written(firmware::Instant{}), "0");
  EXPECT_EQ(written({.seconds = 0, .microseconds = 999'999}), "999999");
  EXPECT_EQ(written({.seconds = 1, .microseconds = 20}), "1000020");
  EXPECT_EQ(written({.seconds = 100'000, .microseconds = 7}), "100000000007");
  firmware::Instant t;
  std::uint64_t passed = 0;
  std::mt19937 random(27);
  for (int n = 0; n < 10'000; ++n) {
    const auto more = static_cast<std::uint32_t>(random() % 3'000'000);
    t.pass(more);
    passed += more;
    ASSERT_LT(t.microseconds, 1'000'000u);
    ASSERT_EQ(written(t), std::to_string(passed));
  }
}

TEST(Log, ARowStaysUntilItIsSent) {
  firmware::LogSlot<int> slot;
  EXPECT_EQ(slot.waiting(), nullptr);
  slot.take(1);
  slot.take(2);
  ASSERT_NE(slot.waiting(), nullptr);
  EXPECT_EQ(*slot.waiting(), 1);
  slot.next();
  EXPECT_EQ(slot.waiting(), nullptr);
  slot.take(3);
  EXPECT_EQ(*slot.waiting(), 3);
}

std::vector<firmware::Command> understood(const std::string& typed) {
  firmware::Commands commands;
  std::vector<firmware::Command> out;
  for (const char c : typed)
    if (const firmware::Command found = commands.take(c); found.kind != firmware::Command::Kind::none)
      out.push_back(found);
  return out;
}

TEST(Commands, WhatIsTyped) {
  using Kind = firmware::Command::Kind;
  const auto found = understood("r 120\r\n-35\ns12\nc9999999999\r\n");
  ASSERT_EQ(found.size(), 7u);
  EXPECT_EQ(found[0].kind, Kind::run);
  EXPECT_EQ(found[1].kind, Kind::setpoint);
  EXPECT_EQ(found[1].thousandths, 120'000);
  EXPECT_EQ(found[2].thousandths, -35'000);
  EXPECT_EQ(found[3].kind, Kind::stop);
  EXPECT_EQ(found[4].thousandths, 12'000);
  EXPECT_EQ(found[5].kind, Kind::clear);
  EXPECT_EQ(found[6].thousandths, 999'999'000) << "more than anything turns, and no overflow";
}

TEST(Commands, ASetpointInThousandths) {
  const std::vector<std::pair<std::string, std::int32_t>> all = {
      {"1.5", 1500}, {"-1.5", -1500},   {"70.5", 70'500}, {"0.125", 125},
      {".5", 500},   {"-.05", -50},     {"7.", 7000},     {"0", 0},
      {"-0.0", 0},   {"007.100", 7100}, {" 3.25", 3250},  {"1999999.999", 1'999'999'999}};
  for (const auto& [typed, thousandths] : all) {
    const auto found = understood(typed + "\n");
    ASSERT_EQ(found.size(), 1u) << typed;
    EXPECT_EQ(found[0].kind, firmware::Command::Kind::setpoint) << typed;
    EXPECT_EQ(found[0].thousandths, thousandths) << typed;
  }
}

/// The message is printed at the invalid character and at Enter. The next line is read as usual.
TEST(Commands, WhatIsNoNumberIsDroppedAsAWhole) {
  using Kind = firmware::Command::Kind;
  for (const std::string typed : {"1,5",
                                  "-1,5",
                                  "70\b5",
                                  "70\x7f"
                                  "5",
                                  "7e1",
                                  "x5",
                                  "7x5",
                                  "5-",
                                  "--5",
                                  "5-3",
                                  "1.5.2",
                                  "1.2345",
                                  "7 5",
                                  "7r5",
                                  "7c",
                                  "+5",
                                  "0x10",
                                  "7\t0",
                                  "7\xff",
                                  "-r5",
                                  "70\0335",
                                  "R5"}) {
    const auto found = understood(typed + "\n42\n");
    ASSERT_EQ(found.size(), 3u) << typed;
    EXPECT_EQ(found[0].kind, Kind::spoiled) << typed;
    EXPECT_EQ(found[1].kind, Kind::dropped) << typed;
    EXPECT_EQ(found[2].thousandths, 42'000) << typed;
  }
  for (const std::string typed : {"-", ".", "-."}) {
    const auto found = understood(typed + "\n");
    ASSERT_EQ(found.size(), 1u) << typed;
    EXPECT_EQ(found[0].kind, Kind::dropped) << typed;
  }
}

TEST(Commands, AStopCountsAnywhereAndNothingElseInASpoiledLine) {
  using Kind = firmware::Command::Kind;
  for (const std::string typed : {"7s", "x s", "start", "s", "1.s5", "\bs"}) {
    int stops = 0;
    for (const auto& found : understood(typed + "\n")) {
      stops += found.kind == Kind::stop;
      EXPECT_NE(found.kind, Kind::run) << typed;
      EXPECT_NE(found.kind, Kind::setpoint) << typed;
    }
    EXPECT_EQ(stops, 1) << typed;
  }
}

/// Returns the commands that the main loop reads. Before that, the interrupt has stored all characters of
/// `typed` in the ring, except the characters of `missing`, which the serial line has lost.
std::vector<firmware::Command> obeyed(const std::string& typed, const std::string& missing = "") {
  firmware::Ring<16> ring;
  firmware::Commands commands;
  std::vector<firmware::Command> out;
  for (const char c : typed) {
    if (missing.find(c) != std::string::npos)
      ring.lose();
    else
      ring.put(c);
  }
  for (;;) {
    const auto item = ring.take();
    if (item.kind == decltype(ring)::Kind::none) return out;
    if (item.kind == decltype(ring)::Kind::gap) commands.lost();
    if (item.kind != decltype(ring)::Kind::character) continue;
    if (const firmware::Command found = commands.take(item.character);
        found.kind != firmware::Command::Kind::none)
      out.push_back(found);
  }
}

TEST(Commands, WhatComesAtOnceIsObeyedAsItWasTyped) {
  using Kind = firmware::Command::Kind;
  const auto found = obeyed("300\n70\ns");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].thousandths, 300'000);
  EXPECT_EQ(found[1].thousandths, 70'000);
  EXPECT_EQ(found[2].kind, Kind::stop);
}

TEST(Commands, ANumberThatLostACharacterIsDroppedAndAStopBehindItCounts) {
  using Kind = firmware::Command::Kind;
  const auto found = obeyed("3x00\n-7y0\ns42\n", "xy");
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].kind, Kind::dropped);
  EXPECT_EQ(found[1].kind, Kind::dropped);
  EXPECT_EQ(found[2].kind, Kind::stop);
  EXPECT_EQ(found[3].thousandths, 42'000) << "the next one is whole";
}

TEST(Commands, NoLostEndOfALineJoinsTwoNumbers) {
  const auto found = obeyed("7x30\n", "x");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, firmware::Command::Kind::dropped);
}

TEST(Commands, ARingThatIsFullLosesTheRestAndSaysSo) {
  firmware::Ring<4> ring;
  for (const char c : std::string("12345")) ring.put(c);
  for (const char c : std::string("1234")) EXPECT_EQ(ring.take().character, c);
  EXPECT_EQ(ring.take().kind, firmware::Ring<4>::Kind::gap) << "though nothing came behind it";
  EXPECT_EQ(ring.take().kind, firmware::Ring<4>::Kind::none);
  ring.put('\n');
  EXPECT_EQ(ring.take().character, '\n') << "a loss is told once";
  ring.lose();
  ring.put('a');
  EXPECT_EQ(ring.take().kind, firmware::Ring<4>::Kind::gap);
  EXPECT_EQ(ring.take().character, 'a');
  for (int n = 0; n < 1000; ++n) {  // its indices wrap around
    ring.put(static_cast<char>('a' + n % 26));
    ASSERT_EQ(ring.take().character, static_cast<char>('a' + n % 26));
  }
}

TEST(Commands, AnEchoSaysWhatIsObeyed) {
  const auto echo = [](std::int32_t thousandths) {
    std::string out;
    firmware::put_setpoint([&out](char c) { out += c; }, thousandths, "A");
    return out;
  };
  EXPECT_EQ(echo(70'000), "# setpoint 70 A\n");
  EXPECT_EQ(echo(-1500), "# setpoint -1.500 A\n");
  EXPECT_EQ(echo(-50), "# setpoint -0.050 A\n");
  EXPECT_EQ(echo(0), "# setpoint 0 A\n");
}

TEST(Reasons, EachHasAWordAndALine) {
  std::set<std::string> words;
  for (int n = 0; n <= static_cast<int>(firmware::Reason::program); ++n) {
    std::string line;
    firmware::put_fault([&line](char c) { line += c; }, static_cast<firmware::Reason>(n));
    EXPECT_TRUE(line.starts_with("# fault: ") && line.ends_with("\n")) << line;
    EXPECT_EQ(line.find("unknown"), std::string::npos);
    words.insert(line);
  }
  EXPECT_EQ(words.size(), static_cast<std::size_t>(firmware::Reason::program) + 1);
}

TEST(Reasons, WhatPowerUpLeavesInMemoryIsNotBelieved) {
  firmware::KeptReason kept{};
  EXPECT_EQ(kept.kept(), firmware::Reason::none);
  kept.keep(firmware::Reason::hall);
  EXPECT_EQ(kept.kept(), firmware::Reason::hall);
  for (unsigned bit = 0; bit < 32; ++bit) {
    kept.keep(firmware::Reason::comparator);
    kept.key = kept.key ^ 1u << bit;
    EXPECT_EQ(kept.kept(), firmware::Reason::none);
  }
  kept.keep(firmware::Reason::comparator);
  kept.reason = firmware::Reason::stall;
  EXPECT_EQ(kept.kept(), firmware::Reason::none);
  kept.keep(firmware::Reason::watchdog);
  kept.forget();
  EXPECT_EQ(kept.kept(), firmware::Reason::none);
}

}  // namespace SIXSTEP_TEST_FILE
