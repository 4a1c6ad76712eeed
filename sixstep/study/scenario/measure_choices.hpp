// SPDX-License-Identifier: Apache-2.0
// The unit in which a figure of merit is shown.
#pragma once
#include <string_view>

#include "sixstep/study/scenario/signal_choices.hpp"

namespace sixstep::study {

/// Unit of a figure: the metric's unit; if the metric has none, the signal's unit.
constexpr std::string_view figure_unit(const Measure& m) {
  const std::string_view own = fact_of(m.metric).unit;
  return own.empty() ? unit_of(m.signal) : own;
}

}  // namespace sixstep::study
