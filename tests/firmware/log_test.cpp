// SPDX-License-Identifier: Apache-2.0
// What the examples write on a serial line, and what they take from it.
#include "faces/firmware/example/log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "faces/firmware/example/commands.hpp"

namespace {

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
  const auto found = understood("r 120\r\n-35\ns12c\nx9999999999\r");
  ASSERT_EQ(found.size(), 6u);
  EXPECT_EQ(found[0].kind, Kind::run);
  EXPECT_EQ(found[1].kind, Kind::setpoint);
  EXPECT_EQ(found[1].number, 120);
  EXPECT_EQ(found[2].number, -35);
  EXPECT_EQ(found[3].kind, Kind::stop);
  EXPECT_EQ(found[4].kind, Kind::clear) << "and what was typed before it is forgotten";
  EXPECT_EQ(found[5].number, 9'999'999) << "more than anything turns, and no overflow";
}

}  // namespace
