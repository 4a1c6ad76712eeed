// SPDX-License-Identifier: Apache-2.0
// Crossed wires (model.md 7): the phases in all six orders, and the probes in all six orders. The expected
// results follow from the table of model.md 3 and from the shape of the back-EMF. This file defines both
// independently of the tested code.
#include "sixstep/rig/wiring.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/general.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using rig::WireOrder;
using rig::Wiring;

constexpr WireOrder orders[] = {WireOrder::abc, WireOrder::bca, WireOrder::cab,
                                WireOrder::acb, WireOrder::cba, WireOrder::bac};
constexpr const char* words[] = {"abc", "bca", "cab", "acb", "cba", "bac"};
constexpr int probes[6][3] = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {1, 0, 1}};
constexpr int pairs[6][2] = {{0, 1}, {0, 2}, {1, 2}, {1, 0}, {2, 0}, {2, 1}};

/// Index of the wire end at a position. The word of an order has one letter for each position.
int end_at(WireOrder order, int place) { return words[static_cast<int>(order)][place] - 'a'; }

/// At an electrical angle, the shape of phase k: a trapezoid with a flat top of 120 degrees.
double shape(double electrical_deg, int k) {
  const double from_top = std::remainder(electrical_deg - 120.0 * k - 60.0, 360.0);
  return std::fmax(-1.0, std::fmin(1.0, (90.0 - std::fabs(from_top)) / 30.0));
}

/// The phases that the board drives in a sector of the rotor: {source, sink}.
std::array<int, 2> driven(const Wiring& wires, int sector) {
  for (int seen = 0; seen < 6; ++seen) {
    bool same = true;
    for (int pin = 0; pin < 3; ++pin) same &= probes[seen][pin] == probes[sector][end_at(wires.probes, pin)];
    if (same) return {end_at(wires.phases, pairs[seen][0]), end_at(wires.phases, pairs[seen][1])};
  }
  ADD_FAILURE() << "no sector";
  return {};
}

/// The torque at an angle, divided by K_e and by the current.
double torque_factor(const Wiring& wires, double electrical_deg) {
  const auto [source, sink] = driven(wires, static_cast<int>(electrical_deg / 60));
  return shape(electrical_deg, source) - shape(electrical_deg, sink);
}

enum class Does { forward, backward, stands };
/// If the torques of all sectors have one sign, the rotor turns. If the signs differ, the rotor stops,
/// because the mean torque over a turn is zero.
Does expected(const Wiring& wires) {
  double least = 9, most = -9, sum = 0;
  for (int sector = 0; sector < 6; ++sector) {
    double mean = 0;
    for (int n = 0; n < 60; ++n) mean += torque_factor(wires, 60 * sector + n + 0.5) / 60;
    least = std::fmin(least, mean);
    most = std::fmax(most, mean);
    sum += mean;
  }
  if (least > 0.5) return Does::forward;
  if (most < -0.5) return Does::backward;
  EXPECT_NEAR(sum, 0, 1e-12);
  return Does::stands;
}

GeneralRig wired(const Board& board, const Wiring& wires, double electrical_deg, GeneralSetup setup = {}) {
  setup.start.angle_rad = at_electrical_deg(electrical_deg);
  return GeneralRig(setup.plant(), board.drive, board.board, board.timeline, {}, wires);
}

template <class Check>
void for_all_36(Check&& check) {
  for (const WireOrder phases : orders)
    for (const WireOrder pins : orders) {
      SCOPED_TRACE(::testing::Message() << "phases " << words[static_cast<int>(phases)] << ", probes "
                                        << words[static_cast<int>(pins)]);
      check(Wiring{.phases = phases, .probes = pins});
    }
}

TEST(CrossedWires, HoldTheRotorWithTheTorqueOfThePhasesThatAreDriven) {
  GeneralSetup locked;
  locked.shaft.locked = true;
  for_all_36([&](const Wiring& wires) {
    for (double deg = 6; deg < 360; deg += 12) {
      GeneralRig rig = wired(Board::duty(1.0), wires, deg, locked);
      ASSERT_EQ(run_to(rig, 100e-6), sim::Stop::end);
      general::Plant<double> plant = rig.plant();
      ASSERT_GE(plant.expand(1e-9), 0);
      const double current = 24 / 1.03 * -std::expm1(-100e-6 * 1.03 / 0.572e-3);
      EXPECT_NEAR(plant.at(0).torque, 0.01675 * torque_factor(wires, deg) * current, 1e-13) << deg;
      const auto [source, sink] = driven(wires, static_cast<int>(deg / 60));
      EXPECT_NEAR(plant.state().i[static_cast<std::size_t>(source)], current, 1e-12);
      EXPECT_NEAR(plant.state().i[static_cast<std::size_t>(sink)], -current, 1e-12);
    }
  });
}

TEST(CrossedWires, NineOrdersRunForwardNineBackwardAndEighteenStand) {
  GeneralSetup setup;
  setup.shaft.coulomb_Nm = 0.002;
  int count[3] = {};
  for_all_36([&](const Wiring& wires) {
    const Does does = expected(wires);
    ++count[static_cast<int>(does)];
    GeneralRig rig = wired(Board::duty(0.2), wires, 30, setup);
    for (int row = 1; row <= 20; ++row) {
      ASSERT_EQ(run_to(rig, row * 5e-3), sim::Stop::end);
      ASSERT_LE(std::abs(rig.plant().state().sector), does == Does::stands ? 4 : 9999) << row;
    }
    const auto turned = rig.plant().state().sector;
    EXPECT_EQ(turned > 30, does == Does::forward) << turned;
    EXPECT_EQ(turned < -30, does == Does::backward) << turned;
  });
  EXPECT_EQ(count[0], 9);
  EXPECT_EQ(count[1], 9);
  EXPECT_EQ(count[2], 18);
}

Board phase_hysteresis() {
  Board b = Board::hysteresis(3.0, 0.3, control::Chopping::hard);
  b.drive.hysteresis.watch = control::Watch::phase;
  return b;
}

/// Expects that both runs have the same currents in the legs of the board. The rotor of the second run turns
/// by `way` times the angle of the first rotor.
void expect_the_board_sees_no_difference(const Wiring& wires, double straight_deg, double crossed_deg,
                                         double way) {
  const Board boards[] = {Board::duty(0.5), Board::duty(0.7, control::Chopping::hard),
                          Board::hysteresis(4.0, 0.2, control::Chopping::soft), phase_hysteresis()};
  for (const Board& board : boards) {
    GeneralRig straight = wired(board, {}, straight_deg), crossed = wired(board, wires, crossed_deg);
    for (int row = 1; row <= 40; ++row) {
      ASSERT_EQ(run_to(straight, row * 0.25e-3), sim::Stop::end);
      ASSERT_EQ(run_to(crossed, row * 0.25e-3), sim::Stop::end);
      const auto &a = straight.plant().state(), &b = crossed.plant().state();
      for (std::size_t leg = 0; leg < 3; ++leg) EXPECT_NEAR(b.i[wires.phase(leg)], a.i[leg], 1e-10);
      EXPECT_NEAR(b.w, way * a.w, 1e-10);
      EXPECT_EQ(crossed.pins(), straight.pins());
      EXPECT_EQ(crossed.leg_gates(), straight.plant().gates());
      EXPECT_EQ(crossed.board_sector(), straight.plant().sector());
    }
    EXPECT_EQ(crossed.modulator().turn_ons(), straight.modulator().turn_ons());
    EXPECT_GT(std::fabs(crossed.plant().state().w), 5.0);
  }
}

TEST(CrossedWires, ThatMoveOnTogetherRunAsIfTheyWereStraight) {
  expect_the_board_sees_no_difference({WireOrder::bca, WireOrder::bca}, 17, 120 + 17, 1);
  expect_the_board_sees_no_difference({WireOrder::cab, WireOrder::cab}, 17, 240 + 17, 1);
}

/// The voltage u_ab of phases a and b has the sign pattern of H1. Swapping a and b reverses u_ab and
/// exchanges u_bc with u_ca. If H2 and H3 are also exchanged, the board receives consistent codes. For the
/// board, the motor's angle then counts in the other direction, so the motor turns backwards.
TEST(CrossedWires, OfTwoPhasesAndTheTwoProbesBesideThemRunTheMirroredMotor) {
  expect_the_board_sees_no_difference({WireOrder::bac, WireOrder::acb}, 17, 60 - 17, -1);
  expect_the_board_sees_no_difference({WireOrder::cba, WireOrder::bac}, 17, 180 - 17, -1);
  expect_the_board_sees_no_difference({WireOrder::acb, WireOrder::cba}, 17, 300 - 17, -1);
}

/// The inverted code is the code of the sector three sectors later. The pair of that sector is the reversed
/// pair, as for a negative command.
TEST(CrossedWires, InvertedLinesAreANegativeCommand) {
  GeneralRig inverted = wired(Board::duty(0.5), {.inverted = 7}, 17);
  GeneralRig negative = wired(Board::duty(-0.5), {}, 17);
  ASSERT_EQ(run_to(inverted, 20e-3), sim::Stop::end);
  ASSERT_EQ(run_to(negative, 20e-3), sim::Stop::end);
  EXPECT_EQ(inverted.plant().state().i, negative.plant().state().i);
  EXPECT_EQ(inverted.plant().state().w, negative.plant().state().w);
  EXPECT_LT(inverted.plant().state().w, -10);
}

TEST(CrossedWires, OneInvertedLineMakesACodeThatCannotBe) {
  GeneralRig rig =
      wired(Board::duty(0.5), {.inverted = 2}, 17);  // 100 reads 110, 110 reads 100, 010 reads 000
  EXPECT_EQ(run_to(rig, 50e-3), sim::Stop::fault);
  EXPECT_EQ(rig.fault(), rig::Fault::impossible_hall);
  EXPECT_EQ(rig.pins(), 0);
}

/// Probe k (k = 0 for H1) shows 1 in the half turn of sectors (2k + 5) mod 6 to (2k + 7) mod 6. The test
/// covers all 48 ways to connect three lines.
TEST(CrossedWires, EachPinShowsItsProbeOrTheContrary) {
  for (const WireOrder order : orders)
    for (std::uint8_t inverted = 0; inverted < 8; ++inverted)
      for (int sector = 0; sector < 6; ++sector) {
        const GeneralRig rig =
            wired(Board::duty(0.1), {.probes = order, .inverted = inverted}, 60.0 * sector + 30);
        for (int pin = 0; pin < 3; ++pin) {
          const int probe = end_at(order, pin), into = (sector - 2 * probe + 7) % 6;
          const bool high = into < 3, turned = (inverted >> (2 - pin) & 1) != 0;
          EXPECT_EQ((rig.pins() >> (2 - pin) & 1) != 0, high != turned)
              << words[static_cast<int>(order)] << " inverted " << int{inverted} << " sector " << sector;
        }
      }
}

TEST(CrossedWires, MayBeCrossedAtAnyTime) {
  Board later = Board::duty(0.5);
  later.timeline.push_back({{}, rig::ActionKind::wire_phases, static_cast<double>(WireOrder::bac)});
  later.timeline.push_back({{}, rig::ActionKind::wire_probes, static_cast<double>(WireOrder::acb)});
  GeneralRig told = wired(later, {}, 17);
  GeneralRig built = wired(Board::duty(0.5), {WireOrder::bac, WireOrder::acb}, 17);
  ASSERT_EQ(run_to(told, 10e-3), sim::Stop::end);
  ASSERT_EQ(run_to(built, 10e-3), sim::Stop::end);
  EXPECT_EQ(told.plant().state().i, built.plant().state().i);
  EXPECT_EQ(told.plant().state().w, built.plant().state().w);
  // An edge between two ticks causes a commutation at once, and the currents are continuous.
  Board running = Board::duty(0.5);
  running.timeline.push_back(
      {{10'000'000'100, 0.0}, rig::ActionKind::wire_probes, static_cast<double>(WireOrder::bca)});
  GeneralRig rig = wired(running, {}, 17);
  ASSERT_EQ(run_to(rig, 10e-3), sim::Stop::end);
  const auto before = rig.plant().state().i;
  const int seen = rig.board_sector();
  ASSERT_EQ(run_to(rig, 10e-3 + 200e-12), sim::Stop::end);
  EXPECT_EQ(rig.board_sector(), (seen + 4) % 6);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(rig.plant().state().i[k], before[k], 1e-4);
}

}  // namespace SIXSTEP_TEST_FILE
