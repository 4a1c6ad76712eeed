// SPDX-License-Identifier: Apache-2.0
// Checks the nesting depth of a TOML text before it is parsed: parser and tree recurse once per level, so
// that a key of 100 000 parts would overflow the stack.
#pragma once
#include <optional>
#include <string_view>

#include "sixstep/base/problem.hpp"
#include "text/rooms.hpp"

namespace text {

/// Largest depth. Keys of scenarios and motor files have a depth of at most four.
inline constexpr std::size_t deepest = 32;

/// A problem at the first place where brackets or parts of a key nest deeper than `deepest`.
std::optional<base::Problem> nests_too_deep(std::string_view name, std::string_view text);

}  // namespace text
