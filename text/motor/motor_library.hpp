// SPDX-License-Identifier: Apache-2.0
// Finds motors by name, through a Resolve or among the motors compiled in.
#pragma once
#include <string>
#include <vector>

#include "text/sources.hpp"
#include "text/toml/document.hpp"

namespace text {

/// Returns the motor's file, not yet read into a sheet. `name` is as written in `from`. With an empty
/// Resolve, only the motors compiled in are found. A Problem names the places of the search and a similar
/// name; the caller sets its `where`.
base::Result<Document> find_motor(const std::string& name, const std::string& from, const Resolve& resolve);

/// Names of the motors compiled in.
std::vector<std::string> built_in_motors();

}  // namespace text
