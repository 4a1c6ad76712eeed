// SPDX-License-Identifier: Apache-2.0
// The unit in which a figure of merit is shown.
#pragma once
#include <string_view>

#include "sixstep/study/scenario/signal_choices.hpp"

namespace sixstep::study {

/// Unit of a figure: its own, or that of the signal it is taken of.
constexpr std::string_view figure_unit(const Measure& m) {
  const std::string_view own = fact_of(m.metric).unit;
  return own.empty() ? unit_of(m.signal) : own;
}

}  // namespace sixstep::study
