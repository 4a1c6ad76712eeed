// SPDX-License-Identifier: Apache-2.0
// Finds the texts that other texts name: on a disk, or in a browser's list.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/own/own_controller.h"
#include "text/rooms.hpp"

namespace text {

struct NamedText {
  std::string name;  ///< name for messages; names inside the text are relative to it
  std::string text;
  const sixstep_controller* controller = nullptr;  ///< the loaded controller, if the name refers to a
                                                   ///< controller
};

struct Naming {
  enum class Kind { scenario, motor, rows, controller };
  Kind kind;
  std::string name;  ///< name as written
  std::string from;  ///< name of the text that contains the name; empty: none
};

/// Returns the named text. A Problem's `where` is the place of the search. Its `limit` is the reason why the
/// text cannot be read, and empty if the text does not exist. An empty Resolve finds nothing.
using Resolve = std::function<base::Result<NamedText>(const Naming&)>;

/// The text, or a Problem to be reported at the name.
base::Result<NamedText> find_text(const Resolve& resolve, const Naming& naming);

/// A Resolve that finds texts in this list by their names; a motor's name may lack .toml.
Resolve among(std::vector<NamedText> texts);

/// `name` relative to the folder of `from`, without "..": "a/b.toml" for "../b.toml" in "a/c/d.toml".
std::string beside(std::string_view from, std::string_view name);

/// A file's name without folder and suffix: "b" for "a/b.toml".
std::string stem_of(std::string_view name);

}  // namespace text
