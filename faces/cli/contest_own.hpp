// SPDX-License-Identifier: Apache-2.0
// Controllers of one's own that stand in the comparison beside the library's.
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
  std::vector<std::string> counts;  ///< what tools/own_cost.sh wrote of some of them
};

void declare_own(CLI::App& verb, OwnArguments& own);

/// The library's rows, and one for each controller of one's own.
struct Contestants {
  std::vector<analysis::Contestant> all;
  std::deque<std::string> texts;  ///< of the own ones, which the rows look at
};

base::Result<Contestants> contestants_of(const OwnArguments& own);

}  // namespace cli
