// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep man`: the manual page as roff.
Verb declare_man(CLI::App& app);

}  // namespace cli
