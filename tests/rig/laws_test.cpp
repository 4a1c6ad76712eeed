// SPDX-License-Identifier: Apache-2.0
// Random drives with any back-EMF shape, devices, bus, friction, chopping and steps obey the laws of model.md
// 5.
#include "tests/support/laws.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/board.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;

constexpr std::uint32_t seed = 160;

class Draw {
 public:
  explicit Draw(std::uint32_t n) : random_(seed + 1000 * n) {}
  double between(double low, double high) { return low + (high - low) * unit_(random_); }
  bool chance(double p) { return unit_(random_) < p; }
  int one_of(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

void draw_plant(Draw& draw, Board& b) {
  if (draw.chance(0.3)) b.machine.back_emf = plant::BackEmf::sine;
  if (draw.chance(0.5)) b.machine.flat_deg = draw.between(10.0, 175.0);
  if (draw.chance(0.5))
    b.devices = {draw.between(0, 0.05), draw.chance(0.7) ? draw.between(0.3, 1.0) : 0.0,
                 draw.between(0, 0.05)};
  if (draw.chance(0.3)) {
    b.supply = {.V_0_V = 24.0,
                .R_b_ohm = draw.between(0.02, 0.5),
                .C_F = draw.between(1e-4, 3e-3),
                .sinks = draw.chance(0.5)};
    b.start.bus_V = draw.between(18.0, 30.0);
  }
  if (draw.chance(0.4)) b.shaft.coulomb_Nm = draw.between(0.001, 0.05);
  if (draw.chance(0.3)) b.shaft.static_Nm = draw.between(0.001, 0.08);
  if (draw.chance(0.1)) b.shaft.locked = true;
  if (!b.shaft.locked && draw.chance(0.6)) b.start.speed_rad_s = draw.between(-900.0, 900.0);
  b.start.angle_rad =
      draw.chance(0.3) ? at_electrical_deg(60.0 * draw.one_of(12) - 180.0) : draw.between(-1, 1);
}

void draw_board(Draw& draw, Board& b) {
  b.drive.chopping = static_cast<Chopping>(draw.one_of(3));
  b.board.modulator.centre_aligned = draw.chance(0.3);
  if (draw.chance(0.4)) b.board.modulator.dead_ticks = draw.between(1e5, 3e6);
  b.board.modulator.dead_time_at_commutation = draw.chance(0.3);
  if (draw.chance(0.3)) b.board.modulator.timer_ticks = 1e12 / 72e6;
  b.board.commutate_at_sample = draw.chance(0.3);
  b.board.delayed = draw.chance(0.3);
}

void draw_control(Draw& draw, Board& b, double length_s) {
  const int kind = draw.one_of(4);
  const double top = kind == 0 ? 1.0 : 15.0;
  if (kind > 0) b.drive.mode = control::Mode::current;
  if (kind == 1) b.drive.current = {4.5, -4.04, 24.0};
  if (kind > 1) {
    b.drive.current_control = control::CurrentControl::hysteresis;
    b.drive.hysteresis = {draw.between(0.1, 1.0), static_cast<control::Watch>(draw.one_of(3))};
    b.board.delayed = false;
  }
  b.setpoint(0, draw.between(-top, top));
  for (int n = 1; n < 4; ++n) {
    const auto at = static_cast<std::int64_t>(draw.between(0, 1) * length_s * 1e12);
    (draw.chance(0.5) ? b.setpoint(at, draw.between(-top, top)) : b.load(at, draw.between(-0.1, 0.1)));
  }
  std::stable_sort(b.timeline.begin(), b.timeline.end(),
                   [](const rig::Action& x, const rig::Action& y) { return x.at < y.at; });
}

TEST(Laws, HoldOnEveryDrawnDrive) {
  constexpr double length_s = 6e-3;
  for (std::uint32_t n = 0; n < 600; ++n) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed << " drive " << n);
    Draw draw(n);
    Board b;
    draw_plant(draw, b);
    draw_board(draw, b);
    draw_control(draw, b, length_s);
    auto rig = b.rig();
    LawChecker<> laws;
    ASSERT_EQ(run_to(rig, length_s, laws), sim::Stop::end)
        << "at " << rig.now().seconds() << " fault " << int(rig.fault());
    laws.expect_all(1e-11);
  }
}

}  // namespace SIXSTEP_TEST_FILE
