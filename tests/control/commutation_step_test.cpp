// SPDX-License-Identifier: Apache-2.0
// At a commutation, one phase stays. The duty that keeps its current constant is compared with the equations
// of the star, for every sector, both directions, and either chopped switch.
#include "sixstep/control/commutation_step.hpp"

#include <gtest/gtest.h>

#include <array>

#include "sixstep/control/drive.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

constexpr double E = 2.0, R = 0.3, U = 24.0;

/// The mean of L di/dt of the staying phase over a period: v_k - v_n - e_k - R i_k (leg voltage v, back-EMF
/// e, phase k). The voltage v_n of the star point is the mean of v - e. The leaving phase's diode connects
/// its terminal to the rail in the direction of its current, except during the overlap.
double slope(Pair pair, Leg staying, ChoppedSwitch chopped, double duty, double overlap, double E_V,
             double I) {
  const Leg leaving = free_leg(pair);
  const auto at = [](Leg leg) { return static_cast<std::size_t>(leg); };
  std::array<double, 3> v{}, e{};
  v[at(pair.source)] = chopped == ChoppedSwitch::upper ? duty * U : U;
  v[at(pair.sink)] = chopped == ChoppedSwitch::lower ? (1 - duty) * U : 0.0;
  e[at(pair.source)] = E_V;
  e[at(pair.sink)] = -E_V;
  // If the source stays, the sink leaves. The current of the sink flows out of the motor into the upper
  // diode.
  const bool was_sink = staying == pair.source;
  v[at(leaving)] =
      was_sink ? (1 + overlap) * U : overlap * U;  // its lower or upper switch is connected to the opposite
                                                   // rail
  e[at(leaving)] = was_sink ? -E_V : E_V;
  double star = 0.0;
  for (std::size_t k = 0; k < 3; ++k) star += (v[k] - e[k]) / 3;
  const double i = staying == pair.source ? I : -I;
  return v[at(staying)] - star - e[at(staying)] - R * i;
}

template <class Scalar>
class CommutationStepOf : public ::testing::Test {};
TYPED_TEST_SUITE(CommutationStepOf, Scalars);

TYPED_TEST(CommutationStepOf, HoldsTheStayingPhase) {
  using S = TypeParam;
  const double volt = 1.0 / 32, ampere = 1.0 / 16, speed = 1.0 / 512;  // relative to the scalar's 1
  CommutationStepConfig<S> config{Gain<S>(2 * E / 100.0 * volt / speed), Gain<S>(1.5 * R * volt / ampere),
                                  Gain<S>(0.0)};
  int overlapping = 0;
  for (std::uint8_t before = 0; before < 6; ++before)
    for (const bool backward : {false, true})
      for (const ChoppedSwitch chopped : {ChoppedSwitch::upper, ChoppedSwitch::lower})
        for (const double I : {1.0, 5.0, 10.0})
          for (const double turned : {0.0, 30.0, 100.0, 250.0}) {
            const bool beyond = 4 * E * turned / 100.0 + 3 * R * I > U;
            config.overlap_bus_V = S(beyond ? U * volt : 0.0);
            CommutationStepState<S> state;
            enter_sector(config, state, before);
            EXPECT_FALSE(state.hands_over) << "nothing was before";
            state.driven_A = S(I * ampere);
            state.drives = true;
            const auto sector = static_cast<std::uint8_t>((before + (backward ? 5 : 1)) % 6);
            enter_sector(config, state, sector);
            EXPECT_TRUE(state.hands_over);
            const S u = holding_voltage(config, S(turned * speed), state.driven_A);
            state.part = S(static_cast<double>(u) / (U * volt));
            const Pair pair = backward ? swapped(positive_pair(sector)) : positive_pair(sector);
            const double duty = static_cast<double>(holding_duty(state, pair, chopped));
            const double overlap = static_cast<double>(holding_overlap(state, pair));
            EXPECT_EQ(overlap != 0.0, beyond);
            EXPECT_NEAR(slope(pair, state.staying.leg, chopped, duty, overlap, E * turned / 100.0, I), 0.0,
                        8 * U * digit<S>() * (is_fixed<S> ? 1.0 / volt / U : 1.0) + 1e-12)
                << int(sector) << " " << backward << " " << I << " A, " << turned << " rad/s";
            overlapping += beyond;
          }
  EXPECT_EQ(overlapping, 6 * 2 * 2 * 2);  // the two larger currents at the highest speed
}

/// In each period, the leaving current decreases by T (2 E + 3 R I/2)/L (period T, back-EMF E, current I).
/// The step ends when less than half of this decrease remains, because the next command would act too late.
TYPED_TEST(CommutationStepOf, LastsWhileACurrentLeaves) {
  using S = TypeParam;
  const CommutationStepConfig<S> config{Gain<S>(0.5), Gain<S>(0.25),
                                        Gain<S>(0.25)};  // 0.4 of speed, 0.5 A: u = 0.325, 0.08125 A
  Measurement<S> m{};
  const auto with = [&m](double a, double b, double c) -> const Measurement<S>& {
    m.i_a_A = S(a), m.i_b_A = S(b), m.i_c_A = S(c);
    return m;
  };
  m.speed_rad_s = S(0.4);
  CommutationStepState<S> state;
  watch_leaving(config, state, with(0.5, -0.5, 0.0), 0, false);
  EXPECT_NEAR(static_cast<double>(state.volts), 0.325, 8 * digit<S>());
  EXPECT_FALSE(state.hands_over);
  watch_leaving(config, state, with(0.5, -0.4, -0.1), 1, false);  // a-b to a-c, detected at a tick
  EXPECT_TRUE(state.hands_over);
  watch_leaving(config, state, with(0.5, -0.083, -0.417), 1, false);
  EXPECT_TRUE(state.hands_over);
  watch_leaving(config, state, with(0.5, -0.079, -0.421), 1, false);
  EXPECT_FALSE(state.hands_over);
  watch_leaving(config, state, with(0.5, -0.2, -0.3), 1, false);
  EXPECT_FALSE(state.hands_over) << "over is over until the next sector";
  watch_leaving(config, state, with(0.06, -0.06, 0.0), 1, false);
  enter_sector(config, state, 2);
  EXPECT_TRUE(state.hands_over) << "u = 0.215: 0.054 A";
  watch_leaving(config, state, with(0.05, 0.0, -0.05), 2, false);
  enter_sector(config, state, 3);
  EXPECT_FALSE(state.hands_over);
  // The overlap cancels a part of the bus voltage. The remaining voltage reduces the leaving current: 0.4 -
  // 0.325 = 0.075 V gives 0.01875 A.
  CommutationStepConfig<S> overlaps = config;
  overlaps.overlap_bus_V = S(0.4);
  watch_leaving(overlaps, state, with(0.0, 0.5, -0.5), 2, false);
  EXPECT_NEAR(static_cast<double>(state.least_A), 0.01875, 8 * digit<S>());
  // The flank of the back-EMF begins a quarter of its length after the edge. A tick covers an eighth f of the
  // flank, so the voltage is 4 E - 2 E f.
  CommutationStepConfig<S> flanked = config;
  flanked.flanks_per_rad_s = Gain<S>(0.3125);
  flanked.ahead_per_rad_s = Gain<S>(0.3125);
  flanked.flat_flanks = S(0.25);
  for (const double f : {0.0, 0.125, 0.25}) {
    watch_leaving(flanked, state, with(0.5, 0.5, -0.5), 1, false);
    if (f == 0.0) state.hands_over = true;
    EXPECT_NEAR(static_cast<double>(state.volts), 0.325 - 0.1 * f, 8 * digit<S>()) << f;
  }
  m.speed_rad_s = S(-0.4);
  watch_leaving(config, state, with(0.0, -0.5, 0.5), 3, true);  // reversed, against the command's sign
  EXPECT_NEAR(static_cast<double>(state.driven_A), 0.5, 2 * digit<S>());
}

/// The drive's Hall interrupt sets the duty of the step at once. Ticks keep this duty while the current
/// leaves, and the PI pauses. After the step, the PI continues from its last output.
TEST(CommutationStep, TheLoopRestsMeanwhile) {
  DriveConfig<double> config{};
  config.mode = Mode::current;
  config.current = {0.5, -0.4, U};
  config.nominal_bus_V = U;
  config.extras.on = config.extras.steps_commutation = true;
  config.extras.commutation = {2 * E / 100.0, 1.5 * R, 0.15, 0.0, 0.375};  // 2 + 1.8 V: 0.57 A
  DriveState<double> state{};
  Telemetry<double> telemetry{};
  Measurement<double> m{
      .i_a_A = 4.0, .i_b_A = -4.0, .i_c_A = 0.0, .speed_rad_s = 50.0, .hall = hall_of_sector(0)};
  step(config, state, m, {5.0}, telemetry);
  const double before = state.command.duty, u = state.current.u;
  const double entering = (2 * E + 3 * R * 4.0) / U;  // 4 E at half the speed
  on_hall(config, state, hall_of_sector(1));
  EXPECT_DOUBLE_EQ(state.command.duty, 0.5 + entering / 2) << "a stays, and its upper switch is chopped";
  m.hall = hall_of_sector(1);
  m.i_b_A = -3.0, m.i_c_A = -1.0;
  step(config, state, m, {5.0}, telemetry);
  EXPECT_DOUBLE_EQ(state.command.duty, 0.5 + (entering / 2 + 0.375 / U)) << "and towards 5 A";
  EXPECT_EQ(state.current.u, u);
  m.i_b_A = 0.0, m.i_c_A = -4.0;
  step(config, state, m, {5.0}, telemetry);
  EXPECT_NE(state.current.u, u);
  EXPECT_NEAR(state.command.duty, before, 0.1);
  config.mode = Mode::duty;
  step(config, state, m, {0.25}, telemetry);
  on_hall(config, state, hall_of_sector(2));
  EXPECT_EQ(state.command.duty, 0.25) << "a duty that is asked for stays";
}

}  // namespace SIXSTEP_TEST_FILE
