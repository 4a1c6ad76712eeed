// SPDX-License-Identifier: Apache-2.0
// Draws a design: step, Bode, headroom over speed, ripple over duty.
#pragma once
#include <string>

#include "report/svg_chart.hpp"
#include "sixstep/analysis/verify/design_study.hpp"

namespace report {

/// The designed response over the simulated one, and the simulated current.
std::string step_charts(const sixstep::analysis::DesignStudy& study);
/// Empty charts of |L| and its phase over the frequency.
struct BodeCharts {
  SvgChart gain{
      .title = "Gain |L|", .x_label = "Hz", .y_label = "dB", .log_x = true, .y_tick = 20.0, .levels = {0.0}};
  SvgChart phase{.title = "Phase of L",
                 .x_label = "Hz",
                 .y_label = "degrees",
                 .log_x = true,
                 .y_tick = 45.0,
                 .levels = {-180.0}};
};
/// Gain and phase of the open loop L of each loop, with the specified delay.
std::string loop_charts(const sixstep::analysis::DesignStudy& study);
std::string limit_charts(const sixstep::analysis::DesignStudy& study);

}  // namespace report
