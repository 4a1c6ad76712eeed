// SPDX-License-Identifier: Apache-2.0
// Writes verdicts in JUnit's XML, which build servers read: one suite per experiment, one case per requirement.
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
  std::string failure;  ///< why it does not hold; empty: it holds
  bool broken = false;  ///< it could not be judged: a fault, or no run
};

struct JunitSuite {
  std::string name;
  std::vector<JunitCase> cases;
};

/// One run: a case per requirement, and one for the run itself, which a fault fails.
JunitSuite junit_suite(const std::string& name, const study::Outcome& outcome);
/// Many runs: a requirement passes if it holds in all of them; a further case counts runs that stopped by a
/// fault or could not run.
JunitSuite junit_suite(const std::string& name, const analysis::Series& series);
/// An experiment that could not run.
JunitSuite junit_suite(const std::string& name, const base::Problems& problems);

std::string junit_xml(std::span<const JunitSuite> suites);

}  // namespace text
