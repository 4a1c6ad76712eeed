// SPDX-License-Identifier: Apache-2.0
// A specification's members as the options that set them: the library says settle_s, who typed --settle reads
// that.
#pragma once
#include <string>
#include <string_view>

#include "faces/cli/rooms.hpp"
#include "sixstep/analysis/verify/design_study.hpp"
#include "sixstep/base/problem.hpp"

namespace cli {

/// Each member's name with a unit ("settle_s"), and each choice ("chopping = complementary"), as one would
/// type it
/// ("--settle", "--chopping complementary"). Keys within tables, as control.current.settle_s, stay.
std::string in_options(std::string_view text);
base::Problems in_options(base::Problems problems);
void put_in_options(analysis::DesignStudy& study);

}  // namespace cli
