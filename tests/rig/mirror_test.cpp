// SPDX-License-Identifier: Apache-2.0
// Tests the symmetries of motor, bridge and commutation: mirrored runs give mirrored results.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/board.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;

/// The initial states of the two runs differ by rounding. The bound on their later difference is the accuracy
/// of the solver (model.md 12: 6.5e-12 of full scale for currents).
constexpr double current_part = 1e-11, speed_part = 1e-12;

/// The mirrored run replaces theta by 300 degrees - theta, w by -w, d by -d and T_load by -T_load, and
/// exchanges phases b and c. Its currents are the same.
Board mirrored(Board b) {
  b.start.angle_rad = at_electrical_deg(300.0) - b.start.angle_rad;
  b.start.speed_rad_s = -b.start.speed_rad_s;
  for (rig::Action& a : b.timeline) a.value = -a.value;
  return b;
}

/// The rotor starts a third of an electrical turn further. The phases therefore exchange their roles: a to b,
/// b to c, c to a.
Board rotated(Board b) {
  b.start.angle_rad += at_electrical_deg(120.0);
  return b;
}

void expect_same(const Board& one, const Board& two, std::array<int, 3> phase, double sign, double t_s) {
  auto a = one.rig(), b = two.rig();
  for (int n = 1; n <= 20; ++n) {
    ASSERT_EQ(run_to(a, t_s * n / 20), sim::Stop::end);
    ASSERT_EQ(run_to(b, t_s * n / 20), sim::Stop::end);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(a.plant().state().i[k], b.plant().state().i[phase[k]], current_part * 23.3) << n;
    EXPECT_NEAR(a.plant().state().w, sign * b.plant().state().w, speed_part * 700.0) << n;
  }
  for (const auto what : {rig::EventKind::sector_edge, rig::EventKind::diode_off, rig::EventKind::pwm_edge})
    EXPECT_EQ(a.event_count(what), b.event_count(what));
}

Board drive(Chopping chopping, bool real_devices) {
  Board b = Board::duty(0.6, chopping);
  b.setpoint(7'000'000'000, -0.3);
  b.start.angle_rad = at_electrical_deg(23.0);
  b.load(4'000'000'000, 0.02);
  if (real_devices) {
    b.devices = {.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.02};
    b.board.modulator.dead_ticks = 1e6;
  }
  return b;
}

TEST(Mirror, BackwardsIsForwardsMirrored) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const bool real : {false, true}) {
      SCOPED_TRACE(::testing::Message() << "chopping " << int(chopping) << " real devices " << real);
      const Board b = drive(chopping, real);
      expect_same(b, mirrored(b), {0, 2, 1}, -1.0, 15e-3);
    }
}

TEST(Mirror, EveryPhaseIsLikeTheOthers) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary}) {
    SCOPED_TRACE(::testing::Message() << "chopping " << int(chopping));
    const Board b = drive(chopping, true);
    expect_same(b, rotated(b), {1, 2, 0}, 1.0, 15e-3);
  }
}

TEST(Mirror, HardChoppingDoesNotKnowTheRails) {
  // An angle that is larger by 180 degrees reverses every current and back-EMF. With hard chopping, both
  // switches of the pair switch together.
  const Board b = drive(Chopping::hard, false);
  Board half = b;
  half.start.angle_rad += at_electrical_deg(180.0);
  auto x = b.rig(), y = half.rig();
  for (int n = 1; n <= 20; ++n) {
    ASSERT_EQ(run_to(x, 15e-3 * n / 20), sim::Stop::end);
    ASSERT_EQ(run_to(y, 15e-3 * n / 20), sim::Stop::end);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(x.plant().state().i[k], -y.plant().state().i[k], current_part * 23.3) << n;
    EXPECT_NEAR(x.plant().state().w, y.plant().state().w, speed_part * 700.0) << n;
  }
}

}  // namespace SIXSTEP_TEST_FILE
