// SPDX-License-Identifier: Apache-2.0
// Writes the keys of a file as a JSON Schema (draft 2020-12), with which editors complete and check TOML.
#pragma once
#include <string>

#include "text/rooms.hpp"

namespace text {

/// A scenario file names its schema in its first line: `#:schema sixstep-scenario.schema.json`.
inline constexpr char scenario_schema_file[] = "sixstep-scenario.schema.json";
inline constexpr char motor_schema_file[] = "sixstep-motor.schema.json";

/// The schema checks every rule on a single value: types, ranges, words with their meanings, required keys,
/// and no unknown key. Rules between keys are checked when the file is read. Ends in a newline.
std::string scenario_schema();
std::string motor_schema();
std::string plan_schema();

}  // namespace text
