// SPDX-License-Identifier: Apache-2.0
// Verdicts in the format that build servers read: JUnit's XML, a suite per experiment, a case per requirement.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "sixstep/analysis/statistics/series.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "text/rooms.hpp"

namespace text {

struct JunitCase {
  std::string name;
  std::string failure;  ///< why it does not hold; empty: it does
  bool broken = false;  ///< it could not be judged: a fault, or no run at all
};

struct JunitSuite {
  std::string name;
  std::vector<JunitCase> cases;
};

/// Of one run: each requirement, and the run itself, which a fault fails.
JunitSuite junit_suite(const std::string& name, const study::Outcome& outcome);
/// Of many: each requirement holds in all of them; so many were stopped by faults or could not run.
JunitSuite junit_suite(const std::string& name, const analysis::Series& series);
/// Of an experiment that could not be run.
JunitSuite junit_suite(const std::string& name, const base::Problems& problems);

std::string junit_xml(std::span<const JunitSuite> suites);

}  // namespace text
