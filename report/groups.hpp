// SPDX-License-Identifier: Apache-2.0
// Decides which columns share a chart, in which order and under which names.
#pragma once
#include <deque>
#include <string>
#include <vector>

#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

struct Curve {
  std::string label;    ///< "i_a"; the text after an underscore is a subscript
  std::string style;    ///< name of a colour in the style sheet
  std::string meaning;  ///< shown when the pointer is over the label
  const std::vector<double>* values = nullptr;
};

struct Group {
  std::string id, title, unit;
  int height_px = 180;
  bool logic = false;  ///< true: each signal is a strip of zeros and ones, one below the other
  bool lanes =
      false;  ///< true: the curves are drawn one above the other with their own zero lines, because they would hide each other
  std::string quantity{};  ///< "speed", "angle", "torque" or "current" if the reader may choose the unit;
                           ///< else empty
  std::vector<Curve> curves{};
};

struct Groups {
  std::vector<Group> charts;
  std::vector<double> angle_deg;            ///< angle of the shaft, counted over turns; empty if not recorded
  std::deque<std::vector<double>> derived;  ///< computed columns (Hall bits); a deque keeps their addresses
};

/// The groups, with the controlled quantity first. A chart without numbers is omitted.
Groups chart_groups(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario);

}  // namespace report
