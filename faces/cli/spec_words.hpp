// SPDX-License-Identifier: Apache-2.0
// In texts, replaces members of a specification by the options that set them. The library prints settle_s,
// but the user has typed --settle.
#pragma once
#include <string>
#include <string_view>

#include "faces/cli/rooms.hpp"
#include "sixstep/analysis/verify/design_study.hpp"
#include "sixstep/base/problem.hpp"

namespace cli {

/// Replaces each member with a unit ("settle_s") by its option ("--settle"), and each choice ("chopping =
/// complementary") by "--chopping complementary". Keys within tables, such as control.current.settle_s, are
/// unchanged.
std::string in_options(std::string_view text);
base::Problems in_options(base::Problems problems);
void put_in_options(analysis::DesignStudy& study);

}  // namespace cli
