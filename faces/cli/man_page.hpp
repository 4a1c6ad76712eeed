// SPDX-License-Identifier: Apache-2.0
// The manual page, written from what the verbs declare and the keys describe.
#pragma once
#include <string>

namespace CLI {
class App;
}

namespace cli {

/// roff, man(7) macros, for section 1.
std::string man_page(const CLI::App& app);

}  // namespace cli
