// SPDX-License-Identifier: Apache-2.0
// Writes the manual page from the declarations of the verbs and the descriptions of the keys.
#pragma once
#include <string>

namespace CLI {
class App;
}

namespace cli {

/// Returns the page as roff with man(7) macros, for section 1.
std::string man_page(const CLI::App& app);

}  // namespace cli
