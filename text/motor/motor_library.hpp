// SPDX-License-Identifier: Apache-2.0
// Motors by name: where a Resolve finds them, or among those compiled in.
#pragma once
#include <string>
#include <vector>

#include "text/sources.hpp"
#include "text/toml/document.hpp"

namespace text {

/// The motor's file, not yet read into a sheet. A Problem says where it was looked for and which name is
/// near; its `where` is left empty for the caller, who knows who asked. `name` as written in `from`; without
/// a Resolve only those compiled in are there.
base::Result<Document> find_motor(const std::string& name, const std::string& from, const Resolve& resolve);

/// Names of the motors compiled in.
std::vector<std::string> built_in_motors();

}  // namespace text
