// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>

#include "sixstep/analysis/identification/interval.hpp"
#include "text/rooms.hpp"

namespace text {

/// {"value", "low", "high"}; low and high are the 95 % interval.
inline nlohmann::ordered_json interval_json(const analysis::Interval& x) {
  return {{"value", x.value}, {"low", x.low}, {"high", x.high}};
}

}  // namespace text
