// SPDX-License-Identifier: Apache-2.0
// Files are made before the work begins: one that cannot be written is told at once.
#pragma once
#include <optional>
#include <utility>

#include "faces/cli/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace cli {

/// The file, or what is wrong with it.
template <class File>
void open_or_report(std::optional<File>& into, base::Result<File> file, base::Problems& problems) {
  if (file)
    into.emplace(std::move(*file));
  else
    append(problems, file.problems());
}

}  // namespace cli
