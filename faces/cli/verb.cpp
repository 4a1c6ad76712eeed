// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/verb.hpp"

#include <CLI/App.hpp>

#include "faces/cli/integer_in.hpp"

namespace cli {

void take_data(CLI::App& verb, std::string& folder) {
  verb.add_option("--data", folder, "folder that contains motors/");
}

void take_sets(CLI::App& verb, std::vector<std::string>& sets) {
  verb.add_option("--set", sets, "key=value that overrides the file's value, as --set supply.voltage_V=12")
      ->allow_extra_args(false);
}

void take_force(CLI::App& verb, bool& force) {
  verb.add_flag("--force", force, "replace also files that sixstep did not write");
}

void take_jobs(CLI::App& verb, unsigned& jobs, const std::string& what) {
  verb.add_option("--jobs", jobs, "number of " + what + " in parallel. Default: one per core")
      ->check(integer_in(1, 1024));
}

}  // namespace cli
