// SPDX-License-Identifier: Apache-2.0
// The keys of a file as a JSON Schema (draft 2020-12): editors complete and check TOML with it while it is
// typed.
#pragma once
#include <string>

#include "text/rooms.hpp"

namespace text {

/// A scenario file names its schema in its first line: `#:schema sixstep-scenario.schema.json`.
inline constexpr char scenario_schema_file[] = "sixstep-scenario.schema.json";
inline constexpr char motor_schema_file[] = "sixstep-motor.schema.json";

/// Types, ranges, words with their meanings, what is required, and no key besides: all that can be said of
/// one value. What one key says about another is left to reading the file. Ends in a newline.
std::string scenario_schema();
std::string motor_schema();
std::string plan_schema();

}  // namespace text
