// SPDX-License-Identifier: Apache-2.0
// What tools/own_cost.sh counted of a controller of one's own on a core, out of the file that it wrote.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/base/result.hpp"
#include "text/export/core_costs.hpp"
#include "text/rooms.hpp"

namespace text {

struct OwnCost {
  std::string controller;  ///< as it calls itself
  CoreCost cost;           ///< on the core of the comparison's table
};

/// The Problem's place is the file's to add.
base::Result<OwnCost> own_cost_of(std::string_view json);

}  // namespace text
