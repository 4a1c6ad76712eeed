// SPDX-License-Identifier: Apache-2.0
// Writes verdicts in JUnit's XML, which build servers read: one suite per experiment, one case per
// requirement.
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
  std::string failure;  ///< why the case does not hold; empty: it holds
  bool broken = false;  ///< true: a fault, or a run that could not start, prevents a verdict
};

struct JunitSuite {
  std::string name;
  std::vector<JunitCase> cases;
};

/// The suite of one run: a case per requirement, and a case for the run itself, which fails after a fault.
JunitSuite junit_suite(const std::string& name, const study::Outcome& outcome);
/// The suite of many runs. A requirement passes if it holds in all runs. A further case counts the runs that
/// a fault stopped or that could not run.
JunitSuite junit_suite(const std::string& name, const analysis::Series& series);
/// The suite of an experiment that could not run.
JunitSuite junit_suite(const std::string& name, const base::Problems& problems);

std::string junit_xml(std::span<const JunitSuite> suites);

}  // namespace text
