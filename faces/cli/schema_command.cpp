// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/schema_command.hpp"

#include <CLI/App.hpp>

#include "faces/cli/choose.hpp"
#include "faces/cli/terminal.hpp"

namespace cli {
namespace {

Exit print_schema(const std::string& kind) {
  Schema schema = nullptr;
  base::Problems found;
  choose("KIND", kind, schema_kinds, schema, found);
  if (!found.empty()) return refused(found);
  print(schema());
  return Exit::ok;
}

}  // namespace

Verb declare_schema(CLI::App& app) {
  CLI::App& schema = *app.add_subcommand("schema", "print the keys of a file as JSON Schema, for editors");
  const auto kind = std::make_shared<std::string>("scenario");
  schema.add_option("KIND", *kind, "scenario, motor or plan")->capture_default_str();
  return {&schema, [kind](const std::string&) { return print_schema(*kind); }};
}

}  // namespace cli
