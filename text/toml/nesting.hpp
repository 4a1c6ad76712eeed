// SPDX-License-Identifier: Apache-2.0
// How deep a TOML text nests, seen before it is parsed: parser and tree go one call deeper per level, and a
// key of 100 000 parts would take the stack with it.
#pragma once
#include <optional>
#include <string_view>

#include "sixstep/base/problem.hpp"
#include "text/rooms.hpp"

namespace text {

/// No key of a scenario or a motor file lies deeper than four.
inline constexpr std::size_t deepest = 32;

/// The first place where brackets lie in each other, or parts of a key follow each other, deeper than that.
std::optional<base::Problem> nests_too_deep(std::string_view name, std::string_view text);

}  // namespace text
