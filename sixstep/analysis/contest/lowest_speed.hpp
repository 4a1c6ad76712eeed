// SPDX-License-Identifier: Apache-2.0
// Finds the lowest speed at which a controller still turns the motor against the full load. The reference
// halves repeatedly from the course's low speed; each step is long enough to settle and to measure. A speed
// counts as held under two conditions: its mean is within a twentieth of the reference, and every speed is
// between half and one and a half times the reference.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "sixstep/analysis/contest/contest_bench.hpp"
#include "sixstep/study/measure/outcome.hpp"

namespace sixstep::analysis {

/// Six speeds in rad/s, from the course's low speed down to 1/32 of it.
std::vector<double> slow_speeds(const Course& course);

/// The scenario of a contestant with these speeds one after the other, and three requirements for each speed.
study::Scenario slow_scenario(const study::Scenario& contestant, const ContestBench& bench);

/// The slowest speed in rad/s that counts as held, together with all faster speeds. Empty if the first speed
/// does not.
std::optional<double> lowest_speed_rad_s(const Course& course, std::span<const study::Verdict> verdicts);

}  // namespace sixstep::analysis
