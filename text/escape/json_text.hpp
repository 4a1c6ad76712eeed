// SPDX-License-Identifier: Apache-2.0
// Prints JSON whose strings may contain any bytes: invalid UTF-8 is replaced and raises no exception, and
// control characters are escaped.
#pragma once
#include <nlohmann/json.hpp>

#include <string>

#include "text/escape/escape.hpp"
#include "text/rooms.hpp"

namespace text {

/// Writes JSON on several lines; with an indent of -1 on one line.
inline std::string json_text(const nlohmann::ordered_json& json, int indent = 2) {
  using Json = nlohmann::ordered_json;
  return visible(json.dump(indent, ' ', false, Json::error_handler_t::replace), Lines::kept);
}

}  // namespace text
