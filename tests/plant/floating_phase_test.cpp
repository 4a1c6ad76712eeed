// SPDX-License-Identifier: Apache-2.0
// Simulators often omit this effect (model.md 12): with soft chopping, the free phase starts to conduct.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/board.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/naive.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

constexpr double length_s = 0.1, grid_s = 0.25e-3;

struct Differences {
  double current = 0, speed = 0, peak_current = 0, top_speed = 0;
};

/// Runs at half duty from rest. The engine's values on a grid are compared with the textbook simulator, which
/// omits the effect.
Differences against_naive(double step_s) {
  const Board board = Board::duty(0.5);
  auto engine = board.rig();
  NaiveSoftChopper naive(board, step_s);
  Differences d;
  const int steps = static_cast<int>(std::lround(grid_s / step_s)),
            period = static_cast<int>(std::lround(30e-6 / step_s));
  std::int64_t n = 0;
  for (int row = 1; row <= std::lround(length_s / grid_s); ++row) {
    EXPECT_EQ(run_to(engine, row * grid_s), sim::Stop::end);
    for (int k = 0; k < steps; ++k, ++n) naive.step(n % period < period / 2);
    for (int k = 0; k < 3; ++k) {
      d.current = std::max(d.current, std::fabs(naive.i(k) - engine.plant().state().i[k]));
      d.peak_current = std::max(d.peak_current, std::fabs(engine.plant().state().i[k]));
    }
    d.speed = std::max(d.speed, std::fabs(naive.speed() - engine.plant().state().w));
    d.top_speed = std::max(d.top_speed, engine.plant().state().w);
  }
  return d;
}

TEST(SoftChopping, FloatingPhaseStartsToConductAndLeavingItOutCostsTenPercentOfPeakCurrent) {
  const Differences d = against_naive(1e-6);
  // model.md 12 states 10.6 % and 0.4 %; the tolerance is half of the last printed digit.
  EXPECT_NEAR(d.current / d.peak_current, 0.106, 0.0005);
  EXPECT_NEAR(d.speed / d.top_speed, 0.004, 0.0005);
}

TEST(SoftChopping, TheDifferenceIsNotTheNaiveSimulatorsStep) {
  const Differences coarse = against_naive(1e-6), fine = against_naive(0.25e-6);
  EXPECT_NEAR(coarse.current, fine.current, 1e-3 * fine.current);
  EXPECT_NEAR(coarse.speed, fine.speed, 1e-3 * fine.speed);
}

/// Counts the starts of conduction: a leg had no current in one segment, and its diode conducts in the next
/// segment.
struct Starts {
  plant::Legs before{};
  int count = 0;
  void segment(const rig::LeanRig<double>& rig, double s) {
    if (!(s > 0)) return;
    const plant::Legs& legs = rig.plant().mode().legs;
    for (int k = 0; k < 3; ++k) count += plant::is_floating(before[k]) && plant::is_diode(legs[k]);
    before = legs;
  }
};

TEST(SoftChopping, FloatingPhaseConductsAsOftenAsInTheReference) {
  const Board board = Board::duty(0.5);
  auto rig = board.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, length_s, laws), sim::Stop::end);
  laws.expect_all();
  auto again = board.rig();
  Starts starts;
  ASSERT_EQ(run_to(again, length_s, starts), sim::Stop::end);
  // The numbers of events in the reference trajectory R3.
  EXPECT_EQ(rig.event_count(rig::EventKind::sector_edge), 224);
  EXPECT_EQ(rig.event_count(rig::EventKind::diode_off), 2034);
  EXPECT_EQ(starts.count, 1600);
}

/// The largest current of the free phase. The free phase is a leg outside the driven pair whose current has
/// already been zero.
struct FreePhase {
  double worst_A = 0;
  std::array<bool, 3> was_free{};
  void segment(const rig::LeanRig<double>& rig, double s) {
    const auto& mode = rig.plant().mode();
    const auto& pair = rig.modulator().command().pair;
    for (unsigned k = 0; k < 3; ++k) {
      const bool in_pair = k == static_cast<unsigned>(pair.source) || k == static_cast<unsigned>(pair.sink);
      if (in_pair) was_free[k] = false;
      if (!in_pair && plant::is_floating(mode.legs[k])) was_free[k] = true;
      if (was_free[k])
        worst_A = std::max(worst_A, std::fabs(series::evaluate(rig.plant().expansion().i[k],
                                                               rig.plant().expansion().degree, s)));
    }
  }
};

/// With PWM-ON-PWM, the star point is at the lower rail in the off-times of one half of the sector, and at
/// the upper rail in the off-times of the other half. The free phase's back-EMF e therefore drives a current
/// through the diodes only in the off-time in which e changes its sign. In a sector, e changes by 2 K_e w,
/// and L di/dt = -2/3 e. With every other pattern, this current flows during half of each sector.
TEST(PwmPattern, OnlyPwmOnPwmLeavesTheFreePhaseWithoutCurrent) {
  using control::PwmPattern;
  constexpr double T = 30e-6;
  for (const PwmPattern pattern : {PwmPattern::upper, PwmPattern::lower, PwmPattern::pwm_on,
                                   PwmPattern::on_pwm, PwmPattern::pwm_on_pwm}) {
    Board board = Board::duty(0.5);
    board.drive.extras.on = true;
    board.drive.extras.pwm = {pattern, 6.0 * board.machine.pole_pairs * T / std::numbers::pi};
    LawChecker<> laws;
    auto rig = board.rig();
    ASSERT_EQ(run_to(rig, length_s, laws), sim::Stop::end);
    laws.expect_all();
    auto again = board.rig(), third = board.rig();
    FreePhase free;
    Starts starts;
    ASSERT_EQ(run_to(again, length_s, free), sim::Stop::end);
    ASSERT_EQ(run_to(third, length_s, starts), sim::Stop::end);
    // Counts and currents that docs/reference/commutation.md states.
    static constexpr struct {
      int starts;
      double worst_mA;
    } rows[] = {{1600, 189}, {1674, 191}, {1744, 192}, {1535, 178}, {151, 19}};
    EXPECT_EQ(starts.count, rows[static_cast<int>(pattern)].starts) << static_cast<int>(pattern);
    EXPECT_NEAR(1e3 * free.worst_A, rows[static_cast<int>(pattern)].worst_mA, 0.5)
        << static_cast<int>(pattern);
    if (pattern != PwmPattern::pwm_on_pwm) continue;
    const double w = rig.plant().state().w, sector_s = std::numbers::pi / 3 / board.machine.pole_pairs / w;
    EXPECT_LT(free.worst_A,
              2.0 / 3 * (2 * board.machine.K_e_V_s * w / sector_s) * T * T / 2 / board.machine.L_H);
    EXPECT_LT(starts.count, rig.event_count(rig::EventKind::sector_edge)) << "one in a sector";
  }
}

}  // namespace SIXSTEP_TEST_FILE
