// SPDX-License-Identifier: Apache-2.0
// Figures of merit of a scenario's run, in the order of the requests.
#pragma once
#include <gtest/gtest.h>

#include <optional>

#include "tests/support/scenarios.hpp"

namespace sixstep::testing {

inline study::Measure over(study::MetricKind metric, study::Signal signal, double from_s,
                           std::optional<double> to_s = {}) {
  study::Measure m = measure(metric, signal);
  m.from_s = from_s;
  m.to_s = to_s;
  return m;
}

/// Runs the scenario. If the run cannot start, the test fails and each figure is empty.
inline study::Outcome outcome_of(const study::Scenario& s) {
  const auto out = study::run(s);
  if (out) return *out;
  ADD_FAILURE() << base::to_string(out.problems().front());
  study::Outcome none;
  none.comparisons.resize(s.compare.size());
  return none;
}

/// Returns the figures of [[compare]] in their order.
inline std::vector<double> figures_of(const study::Scenario& s) {
  std::vector<double> figures;
  for (const study::ComparisonResult& c : outcome_of(s).comparisons) figures.push_back(c.measured);
  return figures;
}

}  // namespace sixstep::testing
