// SPDX-License-Identifier: Apache-2.0
// Recognises a motor's file in the place of a scenario, and a scenario in the place of a motor's file, so
// that one message replaces dozens of unknown keys.
#pragma once
#include <optional>

#include "text/rooms.hpp"
#include "text/toml/document.hpp"

namespace text {

enum class FileKind { scenario, motor };

/// A Problem if the file has keys of the other kind and no key of the wanted kind; else empty.
std::optional<base::Problem> taken_for(FileKind wanted, const Document& document);

}  // namespace text
