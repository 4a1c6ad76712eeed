// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/setpoint_range.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/decimal.hpp"

namespace sixstep::study {

namespace {

/// Margin above the largest setpoint, because the converter's counts end at the potentiometer's ends.
constexpr double room = 1.02;
/// Number of points at which a moving setpoint is evaluated.
constexpr int looks = 256;

double largest(const rig::Action& action, double until_s) {
  double most = std::fabs(action.value);
  if (!action.waveform.moves()) return most;
  for (int n = 1; n <= looks; ++n)
    most = std::max(most, std::fabs(action.waveform.after(action.value, until_s * n / looks)));
  return most + std::fabs(action.waveform.amplitude);
}

}  // namespace

double setpoint_range(const Scenario& scenario, const rig::Timeline& timeline) {
  if (scenario.control.mode == control::Mode::duty) return 1.0;
  double most = 0.0;
  for (const rig::Action& action : timeline)
    if (action.kind == rig::ActionKind::setpoint)
      most = std::max(most, largest(action, scenario.duration_s - action.at.seconds()));
  return most > 0.0 ? base::shortened(room * most, 2, base::Towards::up) : 1.0;
}

}  // namespace sixstep::study
