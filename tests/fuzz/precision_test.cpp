// SPDX-License-Identifier: Apache-2.0
// On random drives, the results in double are compared with the results in long double. The growth of
// rounding errors depends on the drive: for example, a comparator may just miss its level, or a rotor may
// just break away. To measure this growth, a third run in long double has parameters that are changed by
// 1e-13. The tolerance of double is 1e-11 of the machine's scales plus four times the difference of the third
// run. The factor four is needed because the third run tries only one of many directions.
#include <gtest/gtest.h>

#include <array>

#include "tests/fuzz/drawn_drive.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

constexpr double parameter_part = 1e-13, scale_part = 1e-11, angle_part = 4e-15, parted = 1e-7;

DrawnDrive nearly(DrawnDrive d) {
  d.machine.R_ohm *= 1 + parameter_part;
  d.machine.K_e_V_s *= 1 - parameter_part;
  d.machine.L_H *= 1 - parameter_part;
  d.shaft.J_kg_m2 *= 1 + parameter_part;
  d.start.angle_rad += angle_part * std::max(std::fabs(d.start.angle_rad), 1.0 / d.machine.pole_pairs);
  return d;
}

/// Currents and speed, relative to the machine's scales.
using Point = std::array<double, 4>;

template <class Rig>
Point point(const Rig& rig, const DrawnDrive& d) {
  const auto& s = rig.plant().state();
  return {static_cast<double>(s.i[0]) / d.stall_A(), static_cast<double>(s.i[1]) / d.stall_A(),
          static_cast<double>(s.i[2]) / d.stall_A(), static_cast<double>(s.w) / d.top_speed()};
}

double distance(const Point& a, const Point& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::fabs(a[k] - b[k]));
  return most;
}

struct Outcome {
  bool tame = true;  ///< the change of 1e-13 in the parameters had an effect below 1e-11
  double worst = 0;  ///< error of double while `tame` is true
};

/// Returns whether a setpoint of the current is zero. The sign of the last bit then decides whether soft
/// chopping coasts or brakes (model.md 4b), so a comparison is not possible.
bool asks_for_nothing(const DrawnDrive& d) {
  return std::any_of(d.timeline.begin(), d.timeline.end(), [](const rig::Action& a) {
    return a.kind == rig::ActionKind::setpoint && a.value == 0.0;
  });
}

/// The comparison ends when the changed run has diverged from the exact run, because the run in double may
/// then differ too.
Outcome compare(std::uint64_t seed) {
  const DrawnDrive drive(seed), other = nearly(drive);
  if (drive.drive.mode != control::Mode::duty && asks_for_nothing(drive)) return {.tame = false};
  SCOPED_TRACE(reproduce(seed, drive));
  auto twice = drive.rig<double>();
  auto wide = drive.rig<long double>(), moved = other.rig<long double>();
  Outcome outcome;
  double grown = 0;
  for (int n = 1; n <= 40; ++n) {
    const double t = drive.length_s * n / 40;
    EXPECT_EQ(run_to(twice, t), sim::Stop::end);
    EXPECT_EQ(run_to(wide, t), sim::Stop::end);
    EXPECT_EQ(run_to(moved, t), sim::Stop::end);
    const Point exact = point(wide, drive);
    grown = std::max(grown, distance(point(moved, drive), exact));
    if (grown > parted) return {.tame = false, .worst = outcome.worst};
    const double error = distance(point(twice, drive), exact);
    EXPECT_LE(error, scale_part + 4 * grown) << "at " << t;
    if (error > scale_part + 4 * grown) break;
    if (grown > scale_part) outcome.tame = false;
    if (outcome.tame) outcome.worst = std::max(outcome.worst, error);
  }
  return outcome;
}

TEST(Fuzz, DoubleFollowsLongDoubleAsFarAsTheDriveAllows) {
  const Seeds range = seeds(1000);
  std::uint64_t tame = 0;
  double worst = 0;
  for (std::uint64_t n = 0; n < range.count; ++n) {
    const Outcome outcome = compare(range.first + n);
    tame += outcome.tame;
    worst = std::max(worst, outcome.worst);
  }
  std::printf("%llu of %llu drives tame; double at most %.1e of scale off there\n",
              static_cast<unsigned long long>(tame), static_cast<unsigned long long>(range.count), worst);
  if (range.count >= 100) {
    EXPECT_GT(tame, range.count * 3 / 4) << "the sample says too little";
  }
}

}  // namespace SIXSTEP_TEST_FILE
