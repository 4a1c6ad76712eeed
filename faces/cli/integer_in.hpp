// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/App.hpp>

#include <cstdint>

namespace cli {

/// Lets an option take whole numbers of a range; what it says of any other is the limit of a Problem.
CLI::Validator integer_in(std::int64_t least, std::int64_t most);

}  // namespace cli
