// SPDX-License-Identifier: Apache-2.0
// How slowly a controller still turns the motor against the rated torque: from the low speed of the course down by halves, one after
// the other, each long enough to settle and to look at. A speed is held where its mean is within a twentieth of it, and nowhere is the
// motor below half of it or above one and a half.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "sixstep/analysis/contest/contest_bench.hpp"
#include "sixstep/study/measure/outcome.hpp"

namespace sixstep::analysis {

/// From the fastest on, rad/s: six of them, down to 1/32.
std::vector<double> slow_speeds(const Course& course);

/// The scenario of a contestant, on the way down through these speeds; three requirements for each.
study::Scenario slow_scenario(const study::Scenario& contestant, const ContestBench& bench);

/// The slowest one held, all before it held too; none where not even the first is.
std::optional<double> lowest_speed_rad_s(const Course& course, std::span<const study::Verdict> verdicts);

}  // namespace sixstep::analysis
