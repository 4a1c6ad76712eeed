// SPDX-License-Identifier: Apache-2.0
// A long run in open loop tests the exact time base. It simulates one second by default, or
// SIXSTEP_SIMULATED_S seconds (3600 in the long tests).
#include <gtest/gtest.h>

#include <cstdlib>

#include "sixstep/series/polynomial.hpp"
#include "tests/support/coinciding.hpp"
#include "tests/support/laws.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using rig::EventKind;

std::int64_t seconds() {
  const char* text = std::getenv("SIXSTEP_SIMULATED_S");
  return text && *text ? std::strtoll(text, nullptr, 10) : 1;
}
constexpr std::int64_t second_ticks = 1'000'000'000'000;

/// The angle of the shaft, computed as the integral of the speed.
class Way {
 public:
  template <class Rig>
  void segment(const Rig& rig, double s) {
    const auto& y = rig.plant().expansion();
    series::add_compensated(rad_, low_, y.h * series::integral(y.w, y.degree, s));
  }
  double rad() const { return rad_; }

 private:
  double rad_ = 0.0, low_ = 0.0;
};

struct WayAndEnergy {
  Way way;
  plant::Audit<double> audit;
  template <class Rig>
  void segment(const Rig& rig, double s) {
    way.segment(rig, s);
    audit.segment(rig.plant(), s);
  }
};

/// The angle from the count of sectors is equal to the integral of the speed. Each edge is located within 64
/// eps of a sector, the noise of the guard. If all errors have the same sign, their sum is 64 eps of the
/// angle.
template <class Rig>
void expect_angle(const Rig& rig, double way_rad) {
  const auto& s = rig.plant().state();
  const long double angle = (static_cast<long double>(s.sector) * base::sector_rad + s.x) / 8;
  EXPECT_NEAR(static_cast<double>(angle / way_rad), 1.0, 64 * eps);
  EXPECT_EQ(rig.event_count(EventKind::sector_edge), s.sector) << "every edge is one sector forward";
}

TEST(OneHour, AtFullVoltageKeepsTimeAngleAndEnergy) {
  const Board b = Board::duty(1.0);
  auto rig = b.rig();
  WayAndEnergy both;
  const sim::Instant end{seconds() * second_ticks, 0.0};
  ASSERT_EQ(sim::run(rig, end, both).stop, sim::Stop::end);
  EXPECT_EQ(rig.now(), end);
  EXPECT_EQ(rig.event_count(EventKind::tick), 1)
      << "a steady bridge in open loop asks nothing of later ticks";
  expect_angle(rig, both.way.rad());
  const plant::EnergyBook book = both.audit.energy();
  EXPECT_LE(std::fabs(book.electrical_residual), 1e-11);
  EXPECT_LE(std::fabs(book.mechanical_residual), 1e-11);
  EXPECT_GT(book.supplied, 2.0 * static_cast<double>(seconds())) << "friction alone takes 3.6 W";
}

TEST(OneHour, OfChoppingCountsEveryPeriod) {
  const Board b = Board::duty(0.5);
  auto rig = b.rig();
  Way way;
  const sim::Instant end{seconds() * second_ticks, 0.0};
  ASSERT_EQ(sim::run(rig, end, way).stop, sim::Stop::end);
  EXPECT_EQ(rig.now(), end);
  // The actions that are due at the end are executed: a tick at this instant, and the off edge if the run
  // ends in the second half of a period.
  const std::int64_t whole = end.ticks / period_ticks, rest = end.ticks % period_ticks;
  EXPECT_EQ(rig.event_count(EventKind::tick), whole + 1);
  EXPECT_EQ(rig.event_count(EventKind::pwm_edge), whole + (rest >= period_ticks / 2));
  EXPECT_EQ(rig.modulator().turn_ons(), whole + 1);
  expect_angle(rig, way.rad());
}

}  // namespace SIXSTEP_TEST_FILE
