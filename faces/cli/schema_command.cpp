// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/schema_command.hpp"

#include <CLI/App.hpp>

#include "faces/cli/choose.hpp"
#include "faces/cli/terminal.hpp"
#include "text/scenario/json_schema.hpp"

namespace cli {
namespace {

Exit print_schema(const std::string& kind) {
  using Schema = std::string (*)();
  constexpr base::Choice<Schema> kinds[] = {{"scenario", text::scenario_schema, "of a scenario file"},
                                            {"motor", text::motor_schema, "of a motor file"},
                                            {"plan", text::plan_schema, "of a plan: many runs"}};
  Schema schema = nullptr;
  base::Problems found;
  choose("KIND", kind, kinds, schema, found);
  if (!found.empty()) return refused(found);
  print(schema());
  return Exit::ok;
}

}  // namespace

Verb declare_schema(CLI::App& app) {
  CLI::App& schema = *app.add_subcommand("schema", "the keys of a file as JSON Schema, for editors");
  const auto kind = std::make_shared<std::string>("scenario");
  schema.add_option("KIND", *kind, "scenario, motor or plan")->capture_default_str();
  return {&schema, [kind](const std::string&) { return print_schema(*kind); }};
}

}  // namespace cli
