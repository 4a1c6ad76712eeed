// SPDX-License-Identifier: Apache-2.0
#include "text/firmware_map/firmware_map.hpp"

#include <gmock/gmock.h>

#include "sixstep/base/problem.hpp"

namespace SIXSTEP_TEST_FILE {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string whole = "chip = \"atmega2560\"\nelf = \"a.elf\"\nsetpoint_range = 2\n";

TEST(FirmwareMap, PinsAreThoseOfTheLoopsOwnProgramUnlessItSaysOthers) {
  const auto map = text::read_firmware_map(
      "m.toml", whole + "upper = [\"PE3\", \"PE4\", \"PE5\"]\ncurrents = [6, 5, 4]\n");
  ASSERT_TRUE(map);
  EXPECT_EQ(map->elf, "a.elf");
  EXPECT_THAT(map->hall, ElementsAre("PK0", "PK1", "PK2"));
  EXPECT_THAT(map->upper, ElementsAre("PE3", "PE4", "PE5"));
  EXPECT_THAT(map->lower, ElementsAre("PA0", "PA1", "PA2"));
  EXPECT_THAT(map->currents, ElementsAre(6, 5, 4));
  EXPECT_EQ(map->potentiometer, 3);
  EXPECT_EQ(map->setpoint_range, 2.0);
}

TEST(FirmwareMap, EachSlipIsToldWithItsCure) {
  for (const auto& [text, said] : {
           std::pair{std::string("elf = \"a.elf\"\nsetpoint_range = 2\n"), "chip"},
           std::pair{std::string("chip = \"atmega328p\"\nelf = \"a.elf\"\nsetpoint_range = 2\n"),
                     "write chip = \"atmega2560\""},
           std::pair{whole + "hall = [\"PK0\", \"PK1\"]\n", "is not three pins"},
           std::pair{whole + "lower = [\"A0\", \"A1\", \"A2\"]\n", "name the pins as the data sheet does"},
           std::pair{whole + "lower = [\"PI0\", \"PA1\", \"PA2\"]\n", "is not three pins"},
           std::pair{whole + "lower = [\"PB5\", \"PA1\", \"PA2\"]\n", "names PB5 a second time"},
           std::pair{whole + "hall = [\"PD0\", \"PD1\", \"PD2\"]\n", "name three of the pins PK0 to PK7"},
           std::pair{whole + "currents = [0, 1, 3]\n", "name four different inputs, each 0 to 7"},
           std::pair{whole + "currents = [0, 1, 8]\n", "name four different inputs, each 0 to 7"},
           std::pair{whole + "gates = 3\n", "gates"},
           std::pair{std::string("chip = \"atmega2560\"\nelf = \"a.elf\"\nsetpoint_range = 0\n"),
                     "setpoint_range"},
       }) {
    const auto map = text::read_firmware_map("m.toml", text);
    ASSERT_FALSE(map) << text;
    EXPECT_THAT(sixstep::base::to_string(map.problems().front()), HasSubstr(said)) << text;
  }
}

}  // namespace SIXSTEP_TEST_FILE
