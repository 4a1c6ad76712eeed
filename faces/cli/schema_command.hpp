// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "faces/cli/verb.hpp"
#include "sixstep/base/describe.hpp"
#include "text/scenario/json_schema.hpp"

namespace cli {

using Schema = std::string (*)();
inline constexpr sixstep::base::Choice<Schema> schema_kinds[] = {
    {"scenario", text::scenario_schema, "of a scenario file"},
    {"motor", text::motor_schema, "of a motor file"},
    {"plan", text::plan_schema, "of a plan: many runs"}};

/// `sixstep schema [scenario|motor|plan]`: print the keys of a file as JSON Schema, for editors.
Verb declare_schema(CLI::App& app);

}  // namespace cli
