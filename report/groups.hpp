// SPDX-License-Identifier: Apache-2.0
// Which columns share a chart, in which order, under which name.
#pragma once
#include <deque>
#include <string>
#include <vector>

#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

struct Curve {
  std::string label;    ///< "i_a"; an underscore starts a subscript
  std::string style;    ///< a name the style sheet has a colour for
  std::string meaning;  ///< for the reader who hovers over the label
  const std::vector<double>* values = nullptr;
};

struct Group {
  std::string id, title, unit;
  int height_px = 180;
  bool logic = false;  ///< strips of zeros and ones, one below the other
  bool lanes = false;  ///< one curve above the other, each around its own zero: what would hide each other
  std::string quantity{};  ///< "speed", "angle", "torque", "current": what the reader may choose the unit of
  std::vector<Curve> curves{};
};

struct Groups {
  std::vector<Group> charts;
  std::vector<double> angle_deg;            ///< of the shaft, counted over turns; empty where not recorded
  std::deque<std::vector<double>> derived;  ///< columns made here (Hall bits); a deque keeps their addresses
};

/// The controlled quantity comes first. Charts without a curve that holds a number are left out.
Groups chart_groups(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario);

}  // namespace report
