// SPDX-License-Identifier: Apache-2.0
// Opens output files before the run, so that an unwritable path fails at once.
#pragma once
#include <optional>
#include <utility>

#include "faces/cli/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace cli {

/// Stores the file in `into`, or adds its problems.
template <class File>
void open_or_report(std::optional<File>& into, base::Result<File> file, base::Problems& problems) {
  if (file)
    into.emplace(std::move(*file));
  else
    append(problems, file.problems());
}

}  // namespace cli
