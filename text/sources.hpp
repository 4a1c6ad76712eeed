// SPDX-License-Identifier: Apache-2.0
// What one text names in others, found by whoever knows where these lie: a disk, a list in a browser.
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
  std::string name;  ///< what messages call it; what it names in turn lies beside that
  std::string text;
  const sixstep_controller* controller = nullptr;  ///< what was loaded of it, where a controller is meant
};

struct Naming {
  enum class Kind { scenario, motor, rows, controller };
  Kind kind;
  std::string name;  ///< as written
  std::string from;  ///< of the text that names it; empty: nobody's
};

/// The text that is meant. A Problem's `where` is where it was looked for; its `limit` says what keeps it
/// from being read, and is empty where nothing is there. An empty Resolve finds nothing.
using Resolve = std::function<base::Result<NamedText>(const Naming&)>;

/// The text, or a Problem to be told at the name that leads nowhere.
base::Result<NamedText> find_text(const Resolve& resolve, const Naming& naming);

/// Texts at hand, each under its name; a motor's may be left without its .toml.
Resolve among(std::vector<NamedText> texts);

/// `name` as it is meant beside `from`, in one spelling: "a/b.toml" for "../b.toml" beside "a/c/d.toml".
std::string beside(std::string_view from, std::string_view name);

/// "b" of "a/b.toml".
std::string stem_of(std::string_view name);

}  // namespace text
