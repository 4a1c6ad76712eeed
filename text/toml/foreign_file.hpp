// SPDX-License-Identifier: Apache-2.0
// Recognises another program's parameter file.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sixstep/base/problem.hpp"
#include "text/rooms.hpp"

namespace text {

enum class ForeignKind : std::uint8_t { none, vesc, odrive, moteus, simple_foc, matlab };

/// The program that wrote the text, found by words that occur only in this program's files.
ForeignKind foreign_kind(std::string_view text);

/// The kind in words: "a VESC motor configuration".
std::string_view foreign_name(ForeignKind kind);

/// A Problem for such a file in the place of a TOML file; else empty.
std::optional<base::Problem> foreign_file(const std::string& name, std::string_view text);

}  // namespace text
