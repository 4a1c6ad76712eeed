// SPDX-License-Identifier: Apache-2.0
// Reads the file that tools/own_cost.sh writes: the cost of a user's own controller on a core.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/base/result.hpp"
#include "text/export/core_costs.hpp"
#include "text/rooms.hpp"

namespace text {

struct OwnCost {
  std::string controller;  ///< the name that the controller gives itself
  CoreCost cost;           ///< cost on the core of the comparison's table
};

/// Problems: `json` is not the text of a file from tools/own_cost.sh, or does not contain the comparison's
/// core. The caller sets the Problem's `where`.
base::Result<OwnCost> own_cost_of(std::string_view json);

}  // namespace text
