// SPDX-License-Identifier: Apache-2.0
// Tests time and angle over many PWM periods: 10^5 by default, or SIXSTEP_PWM_PERIODS. The long tests have
// 10^7 periods, which are five minutes of simulated time.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/coinciding.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using rig::EventKind;

std::int64_t periods() {
  const char* text = std::getenv("SIXSTEP_PWM_PERIODS");
  return text && *text ? std::strtoll(text, nullptr, 10) : 100'000;
}

template <class Rig>
void run_periods(Rig& rig, std::int64_t count) {
  sim::NoObserver none;
  ASSERT_EQ(sim::run(rig, sim::Instant{count * period_ticks, 0.0}, none).stop, sim::Stop::end);
  EXPECT_EQ(rig.now(), (sim::Instant{count * period_ticks, 0.0}));
  EXPECT_EQ(rig.event_count(EventKind::tick), count + 1);  // the tick at the end is due
}

TEST(Pitfall02_TimeAndAngleAreCounted, TimeDoesNotDriftWhileTheRotorIsLocked) {
  // The off edge of the duty is between two whole picoseconds. A periodic run must repeat exactly.
  Board b = locked(Board::duty(1.0 / 3.0));
  auto rig = b.rig();
  run_periods(rig, periods());
  EXPECT_EQ(rig.event_count(EventKind::pwm_edge), periods());
  EXPECT_EQ(rig.modulator().turn_ons(), periods() + 1);
  // The minimum of the ripple, i(0) = i(T), has a closed form. For T/3 the current rises towards U/R_tt (bus
  // voltage U, resistance R_tt). Then it decays through the diode towards 0.
  const double T = 30e-6, on = std::exp(-T / 3 / b.tau()), off = std::exp(-2 * T / 3 / b.tau());
  const double foot = 24.0 / b.R_tt() * (1 - on) * off / (1 - on * off);
  // A rounding error in the compensated sums decays with tau, some twenty periods. Rounding errors therefore
  // do not add up.
  EXPECT_NEAR(rig.plant().state().i[0], foot, 64 * eps * 24.0 / b.R_tt());
}

TEST(Pitfall02_TimeAndAngleAreCounted, AngleDoesNotDriftAtASpeedThatNoTorqueChanges) {
  Board b = Board::duty(0.5);
  b.shaft.J_kg_m2 = 1e18;  // a torque of 1 N m for five minutes changes the speed by 3e-16 rad/s
  b.shaft.B_Nm_s = 0.0;
  b.start.speed_rad_s = 300.0;
  b.start.angle_rad = 0.0;
  auto rig = b.rig();
  run_periods(rig, periods());
  const auto& s = rig.plant().state();
  EXPECT_EQ(s.w, 300.0);
  const long double turned = (static_cast<long double>(s.sector) * base::sector_rad + s.x) / 8;
  const long double exact = 300.0L * 30e-6L * static_cast<long double>(periods());
  // Each edge sets the angle exactly and is located within 64 eps of a sector. An error in one sector
  // therefore changes the time of the next sector, not its angle. At worst, the errors add up at random. 4e5
  // errors of the same sign would be needed for 1e-12.
  EXPECT_NEAR(static_cast<double>(turned / exact), 1.0, 1e-12);
  const auto edges = static_cast<std::int64_t>(exact * 8 / base::sector_rad);
  EXPECT_NEAR(static_cast<double>(rig.event_count(EventKind::sector_edge)), static_cast<double>(edges), 1.0);
}

}  // namespace SIXSTEP_TEST_FILE
