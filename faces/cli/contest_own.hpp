// SPDX-License-Identifier: Apache-2.0
// Adds a user's own controllers to the comparison of the library's controllers.
#pragma once
#include <CLI/App.hpp>

#include <deque>
#include <string>
#include <vector>

#include "faces/cli/rooms.hpp"
#include "sixstep/analysis/contest/contestants.hpp"
#include "sixstep/base/result.hpp"

namespace cli {

struct OwnArguments {
  std::vector<std::string> files;   ///< shared objects
  std::vector<std::string> counts;  ///< files of tools/own_cost.sh, for some of the controllers
};

void declare_own(CLI::App& verb, OwnArguments& own);

/// The library's controllers and the user's controllers, a row for each.
struct Contestants {
  std::vector<analysis::Contestant> all;
  std::deque<std::string> texts;  ///< texts of the user's controllers; the rows refer to them
};

base::Result<Contestants> contestants_of(const OwnArguments& own);

}  // namespace cli
