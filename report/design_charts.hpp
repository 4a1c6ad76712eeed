// SPDX-License-Identifier: Apache-2.0
// A design's drawings: step, Bode, headroom over speed, ripple over duty.
#pragma once
#include <string>

#include "report/svg_chart.hpp"
#include "sixstep/analysis/verify/design_study.hpp"

namespace report {

/// What was designed over what the simulation recorded, and the current of it.
std::string step_charts(const sixstep::analysis::DesignStudy& study);
/// Where |L| and its phase are drawn over the frequency, without curves yet.
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
/// |L| and its phase of each loop, with the delay that was asked for.
std::string loop_charts(const sixstep::analysis::DesignStudy& study);
std::string limit_charts(const sixstep::analysis::DesignStudy& study);

}  // namespace report
