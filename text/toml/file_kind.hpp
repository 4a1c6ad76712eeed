// SPDX-License-Identifier: Apache-2.0
// A motor's file taken for a scenario, or a scenario for a motor: dozens of keys would be strange, and one
// sentence says why.
#pragma once
#include <optional>

#include "text/rooms.hpp"
#include "text/toml/document.hpp"

namespace text {

enum class FileKind { scenario, motor };

/// The Problem of a file that has keys of the other kind only; none where any of its own is there.
std::optional<base::Problem> taken_for(FileKind wanted, const Document& document);

}  // namespace text
