// SPDX-License-Identifier: Apache-2.0
// Motors by name: beside the scenario, in a data folder, or among those compiled in.
#pragma once
#include <string>
#include <vector>

#include "text/rooms.hpp"
#include "text/toml/document.hpp"

namespace text {

struct MotorQuery {
  std::string name;      ///< as written: a path or a name
  std::string folder;    ///< the naming file's folder; empty: the current one
  std::string data_dir;  ///< holds motors/NAME.toml; empty: none
};

/// The motor's file, not yet read into a sheet. A Problem says where it was looked for and which name is
/// near; its `where` is left empty for the caller, who knows who asked.
base::Result<Document> find_motor(const MotorQuery& query);

/// Names of the motors compiled in.
std::vector<std::string> built_in_motors();

}  // namespace text
