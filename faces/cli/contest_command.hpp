// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// sixstep compare MOTOR: compares controllers, designed by their rules, on one course.
Verb declare_contest(CLI::App& app);

}  // namespace cli
