// SPDX-License-Identifier: Apache-2.0
// Decides which columns share a chart, their order and their names.
#pragma once
#include <deque>
#include <string>
#include <vector>

#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

struct Curve {
  std::string label;    ///< "i_a"; an underscore starts a subscript
  std::string style;    ///< a colour of the style sheet
  std::string meaning;  ///< shown when the pointer is over the label
  const std::vector<double>* values = nullptr;
};

struct Group {
  std::string id, title, unit;
  int height_px = 180;
  bool logic = false;      ///< one strip of zeros and ones per signal, below each other
  bool lanes = false;      ///< curves above each other, each with its own zero, because they would hide each
                           ///< other
  std::string quantity{};  ///< "speed", "angle", "torque", "current": the reader may choose its unit
  std::vector<Curve> curves{};
};

struct Groups {
  std::vector<Group> charts;
  std::vector<double> angle_deg;            ///< angle of the shaft, counted over turns; empty if not recorded
  std::deque<std::vector<double>> derived;  ///< computed columns (Hall bits); a deque keeps their addresses
};

/// The controlled quantity comes first. Charts without any curve with a number are omitted.
Groups chart_groups(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario);

}  // namespace report
