// SPDX-License-Identifier: Apache-2.0
// Writes numbers as JSON, which has no infinities and no NaN.
#pragma once
#include <nlohmann/json.hpp>

#include <optional>

#include "text/rooms.hpp"

namespace text {

/// The number; null if it is infinite or NaN.
inline nlohmann::ordered_json finite(double x) {
  return x - x == 0.0 ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}
inline nlohmann::ordered_json or_null(const std::optional<double>& x) {
  return x ? finite(*x) : nlohmann::ordered_json(nullptr);
}

/// The value of a figure of merit: null for NaN, "never" or "-never" for an infinite value.
inline nlohmann::ordered_json figure_json(double x) {
  if (x != x) return nullptr;
  if (x - x != 0.0) return x > 0 ? "never" : "-never";
  return x;
}

}  // namespace text
