// SPDX-License-Identifier: Apache-2.0
// Suggests a correction for a reference that does not suit its mode.
#pragma once
#include <cmath>
#include <string>
#include <string_view>

#include "sixstep/base/linear.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

/// If the given unit belongs to another mode, the user probably meant that mode.
inline std::string cure_of_unit(std::string_view unit, control::Mode mode, const base::Motion& motion) {
  const auto own = [&](control::Mode of) { return std::string(motion.unit(reference_unit(of)).linear); };
  const std::string in_mode = "give the reference in \"" + own(mode) + "\"";
  for (const auto& choice : mode_choices)
    if (!unit.empty() && own(choice.value) == unit)
      return "set control.mode = \"" + std::string(choice.word) + "\", or " + in_mode;
  return in_mode + ", or the number with its unit, as \"100 " + std::string(unit) +
         "\", or change control.mode";
}

/// A duty is a share of the period; a user who writes 50 means percent.
inline std::string cure_of_duty(double value) {
  std::string what = "a duty is the fraction of the period in which the switch is on, with a sign";
  if (!(std::fabs(value) <= 100.0)) return what;
  return "write " + base::written(value / 100.0) + " for " + base::written(value) + " %: " + what;
}

}  // namespace sixstep::study
