// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/App.hpp>

#include <cstdint>

namespace cli {

/// Checks that an option is a whole number in a range. The validator's message becomes the limit of a
/// Problem.
CLI::Validator integer_in(std::int64_t least, std::int64_t most);

}  // namespace cli
