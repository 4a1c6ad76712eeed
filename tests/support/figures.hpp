// SPDX-License-Identifier: Apache-2.0
// Figures of a scenario's run, as the tests ask for them.
#pragma once
#include <gtest/gtest.h>

#include "tests/support/scenarios.hpp"

namespace sixstep::testing {

inline study::Measure over(study::MetricKind metric, study::Signal signal, double from_s, double to_s) {
  study::Measure m = measure(metric, signal);
  m.from_s = from_s;
  m.to_s = to_s;
  return m;
}

/// What was asked, in that order; nothing, and a failure, where the run could not start.
inline std::vector<double> figures_of(const study::Scenario& s) {
  const auto out = study::run(s);
  EXPECT_TRUE(out) << (out ? "" : base::to_string(out.problems().front()));
  std::vector<double> figures;
  if (out)
    for (const study::ComparisonResult& c : out->comparisons) figures.push_back(c.measured);
  return figures;
}

}  // namespace sixstep::testing
