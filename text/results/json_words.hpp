// SPDX-License-Identifier: Apache-2.0
// Renames the members of a JSON object for a linear motor.
#pragma once
#include <nlohmann/json.hpp>

#include "sixstep/base/linear.hpp"
#include "text/rooms.hpp"

namespace text {

/// Returns the JSON with the names that belong to `motion`: "stall_force_N" for a linear motor. Numbers stay
/// the same. Therefore the JSON must not have names in degrees or in thousandths, because such numbers would
/// have to change.
inline nlohmann::ordered_json under_names_of(const sixstep::base::Motion& motion,
                                             const nlohmann::ordered_json& json) {
  if (!motion.linear || !json.is_structured()) return json;
  nlohmann::ordered_json out =
      json.is_array() ? nlohmann::ordered_json::array() : nlohmann::ordered_json::object();
  for (const auto& [name, value] : json.items()) {
    if (json.is_array())
      out.push_back(under_names_of(motion, value));
    else
      out[motion.words(name)] = under_names_of(motion, value);
  }
  return out;
}

}  // namespace text
