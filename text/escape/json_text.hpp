// SPDX-License-Identifier: Apache-2.0
// JSON on its way out. Names in it may hold any bytes: nothing throws over what is no UTF-8, and nothing acts.
#pragma once
#include <nlohmann/json.hpp>

#include <string>

#include "text/escape/escape.hpp"
#include "text/rooms.hpp"

namespace text {

/// Over lines, or with an indent of -1 in one.
inline std::string json_text(const nlohmann::ordered_json& json, int indent = 2) {
  using Json = nlohmann::ordered_json;
  return visible(json.dump(indent, ' ', false, Json::error_handler_t::replace), Lines::kept);
}

}  // namespace text
