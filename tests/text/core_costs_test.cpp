// SPDX-License-Identifier: Apache-2.0
// A header states cycles and memory of the counted rows for its kind of drive. If the drive has additional
// parts, the text names them.
#include "text/export/core_costs.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

using namespace sixstep;

namespace SIXSTEP_TEST_FILE {

study::Compiled drive_of(control::Mode mode) {
  study::Compiled c;
  c.drive.mode = mode;
  return c;
}

/// The largest counts of a drive's tick and of its Hall interrupt, read from the table.
std::pair<std::string, std::string> counted(const std::string& begin) {
  std::ifstream table(SIXSTEP_SOURCE_DIR "/data/cores/drives.txt");
  std::pair<std::string, std::string> worst;
  for (std::string line; std::getline(table, line);) {
    const std::string last = line.substr(line.rfind(' ') + 1);
    if (line.starts_with(begin + " tick ")) worst.first = last;
    if (line.starts_with(begin + " hall ")) worst.second = last;
  }
  return worst;
}

std::vector<std::string> words_of_row(const std::string& text, const std::string& core,
                                      const std::string& scalar) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    std::vector<std::string> words(std::istream_iterator<std::string>(in), {});
    if (words.size() > 3 && words[1] == core && words[2] == scalar) return words;
  }
  return {};
}

TEST(CoreCosts, AreThoseCountedOfTheDriveOfItsKind) {
  auto product = drive_of(control::Mode::speed);
  product.product.emplace();
  auto hysteresis = drive_of(control::Mode::current);
  hysteresis.drive.current_control = control::CurrentControl::hysteresis;
  const std::pair<const char*, study::Compiled> drives[] = {
      {"duty", drive_of(control::Mode::duty)},         {"current", drive_of(control::Mode::current)},
      {"speed", drive_of(control::Mode::speed)},       {"hysteresis", hysteresis},
      {"position", drive_of(control::Mode::position)}, {"product", product},
  };
  for (const auto& [name, compiled] : drives) {
    const std::string text = text::core_cost_lines(compiled);
    for (const auto& [core, scalar] :
         {std::pair{"Cortex-M0", "q15"}, {"Cortex-M4F", "float"}, {"ATmega2560", "q31"}}) {
      const auto [tick, hall] = counted(std::string(core) + " " + name + " " + scalar);
      ASSERT_FALSE(tick.empty()) << name;
      const auto row = words_of_row(text, core, scalar);
      ASSERT_EQ(row.size(), 9u) << text;
      EXPECT_EQ(row[3], tick) << name;
      EXPECT_EQ(row[4], hall) << name;
      EXPECT_EQ(row[5], std::string(core) == "ATmega2560" ? "cycles" : "instructions");
    }
  }
}

/// The field-oriented drive has no Hall entry and no fixed point.
TEST(CoreCosts, AFieldOrientedDriveHasATickAlone) {
  auto field = drive_of(control::Mode::speed);
  field.field.emplace();
  const std::string text = text::core_cost_lines(field);
  const auto row = words_of_row(text, "Cortex-M4F", "float");
  ASSERT_EQ(row.size(), 9u) << text;
  EXPECT_EQ(row[3], counted("Cortex-M4F field float").first);
  EXPECT_EQ(row[4], "-");
  EXPECT_TRUE(words_of_row(text, "Cortex-M4F", "q15").empty());
  EXPECT_EQ(text.find("do not include"), std::string::npos);
  field.field->weakening.most_A = 5.0;
  EXPECT_NE(text::core_cost_lines(field).find("These counts do not include: field_weakening.\n"),
            std::string::npos);
}

/// The compiler of the image must refuse each period that the note calls too short. The period of the
/// ATmega2560 is for 16 MHz.
TEST(CoreCosts, APeriodTooShortForAnImageIsToldAsTheImageHasIt) {
  std::ifstream board(SIXSTEP_SOURCE_DIR "/faces/firmware/example/cortex_m/board.hpp");
  const std::string source{std::istreambuf_iterator<char>(board), {}};
  const std::string name = "least_period_counts = ";
  const std::size_t at = source.find(name);
  ASSERT_NE(at, std::string::npos);
  EXPECT_DOUBLE_EQ(text::stm32_least_period_s, std::stod(source.substr(at + name.size())) / 72e6);
  const double tick_s = std::stod(counted("ATmega2560 speed q15").first) / 16e6;
  EXPECT_NEAR(text::atmega_least_period_s, tick_s, 0.05 * tick_s);
  EXPECT_EQ(text::too_short_for_images(100e-6), "");
  EXPECT_EQ(
      text::too_short_for_images(30e-6),
      "a control period of 30 us is shorter than the shortest period of the ATmega2560's image (100 us). Below 69.6 us the "
      "STM32F303's image may apply a command one period late: look for `missed` above 0 in its log");
  EXPECT_EQ(
      text::too_short_for_images(69.6e-6),
      "a control period of 69.6 us is shorter than the shortest period of the ATmega2560's image, 100 us");
  EXPECT_EQ(
      text::too_short_for_images(4.2e-6),
      "a control period of 4.2 us is shorter than the shortest period of both images: 22.3 us on the STM32F303, 100 us on the ATmega2560");
}

/// The note prints a least period. With this period, the timer must have at least the counts that the image
/// needs.
TEST(CoreCosts, ALeastPeriodIsRoundedUp) {
  for (const auto& [period_s, words, counts] :
       {std::tuple{4e-6, "images: ", 1600.0}, {30e-6, "Below ", 5006.0}}) {
    const std::string told = text::too_short_for_images(period_s);
    const double us = std::stod(told.substr(told.find(words) + std::string(words).size()));
    EXPECT_GE(us * 72, counts);
    EXPECT_LT(us * 72, counts + 0.1 * 72);
  }
}

TEST(CoreCosts, EveryLineIsAComment) {
  std::istringstream lines(text::core_cost_lines(drive_of(control::Mode::speed)));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_TRUE(line.starts_with("//")) << line;
  EXPECT_EQ(count, 15);
}

TEST(CoreCosts, WhatComesToItIsNamed) {
  auto c = drive_of(control::Mode::speed);
  EXPECT_EQ(text::core_cost_lines(c).find("do not include"), std::string::npos);
  c.drive.extras.slews_setpoint = true;
  EXPECT_EQ(text::core_cost_lines(c).find("do not include"), std::string::npos) << "the extras are off";
  c.drive.extras.on = true;
  c.product.emplace();
  c.product->advance.fixed = 0.1;
  EXPECT_NE(text::core_cost_lines(c).find("These counts do not include: slew, advance.\n"),
            std::string::npos);
}

}  // namespace SIXSTEP_TEST_FILE
