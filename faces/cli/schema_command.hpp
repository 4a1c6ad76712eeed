// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep schema [scenario|motor]`: the keys of a file as JSON Schema, for editors.
Verb declare_schema(CLI::App& app);

}  // namespace cli
