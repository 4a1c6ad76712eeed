// SPDX-License-Identifier: Apache-2.0
// The audit divides the error of the energy balance by the energy that moved.
#include "sixstep/plant/audit.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "tests/support/board.hpp"
#include "tests/support/laws.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

/// The fuzzer found this case: the load accelerates the shaft and brakes it to rest, so the load's energies
/// sum to zero. The error of the balance was divided by a sum near zero.
TEST(Audit, ALoadThatTakesBackWhatItGaveIsAYardstickStill) {
  Board b = Board::duty(0.0);
  b.drive.mode = control::Mode::off;
  b.start.angle_rad = at_electrical_deg(30.0);
  b.shaft.B_Nm_s = 0.0;
  b.shaft.static_Nm = 0.01;  // holds the shaft once it is at rest
  b.load(0, -0.05);
  b.load(1'000'000'000, 0.009);
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 8e-3, laws), sim::Stop::end);
  EXPECT_EQ(rig.plant().state().w, 0.0);
  EXPECT_GT(laws.audit().energy().moved, 1e-6);
  laws.expect_all(1e-11);
}

/// The fuzzer found this case: pulses of 1e-22 s moved an energy of 1e-34 J. No digit of this energy is
/// significant.
TEST(Audit, LessEnergyThanANoiseCurrentHoldsIsNotBalanced) {
  Drivetrain setup;
  setup.start.angle_rad = 0.02;
  Held<> bench(setup, a_to_b());
  LawChecker<> laws;
  ASSERT_EQ(sim::run(bench, sim::Instant{0, 1e-9}, laws).stop, sim::Stop::end);
  EXPECT_GT(laws.audit().energy().moved, 0.0);
  EXPECT_LT(laws.audit().energy().moved, 1e-30);
  laws.expect_all(1e-11);
}

/// The fuzzer found this case: when a switch opens, the plant sets a diode's current to zero if it is below
/// the noise, 1e-12 A in this test. At a thousandth of its stall current, a motor lost the energy of this
/// current in every period.
TEST(Audit, WhatACurrentBelowTheNoiseTookAlongIsKnown) {
  Board b = Board::duty(0.008, control::Chopping::complementary);
  b.board.modulator.dead_ticks = 90'000;
  b.start.angle_rad = at_electrical_deg(30.0);
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 3e-4, laws), sim::Stop::end);
  EXPECT_GT(std::fabs(laws.audit().energy().electrical_residual), 1e-11);
  laws.expect_all(1e-13);
}

/// Compares the integrals of each segment with integrals of the complete products, which contain all terms up
/// to degree 2 n.
struct BesideProducts {
  struct Worst {
    double supplied = 0, copper = 0, devices = 0, air_gap = 0, viscous = 0, travel = 0;
  } worst;
  std::array<int, 4> connected{};  ///< segments, by number of connected legs
  int other_bits = 0;              ///< segments whose bits differ from this file's build without AVX

  template <class System>
  void segment(const System& system, double s) {
    const plant::Plant<double>& p = system.plant();
    const plant::Constants<double>& c = p.constants();
    const plant::Expansion<double>& y = p.expansion();
    const plant::SegmentEnergy<double> e = plant::segment_energy(p, s), exact = by_products(p, s);
    const double A = c.amp_scale, V = c.volt_scale, w = c.speed_scale, dt = y.h * s + 1e-300;
    const auto look = [](double& most, double off) { most = std::max(most, std::fabs(off)); };
    look(worst.supplied, (e.supplied - exact.supplied) / (V * A * dt));
    look(worst.copper, (e.copper - exact.copper) / (V * A * dt));
    look(worst.devices, (e.devices - exact.devices) / (V * A * dt));
    look(worst.air_gap, (e.air_gap - exact.air_gap) / (c.torque_scale * w * dt));
    look(worst.viscous, (e.viscous - exact.viscous) / (c.torque_scale * w * dt));
    look(worst.travel, (e.travel - exact.travel) / (w * dt));
    using Bits = std::array<std::uint64_t, sizeof e / sizeof(double)>;
    other_bits +=
        std::bit_cast<Bits>(e) != std::bit_cast<Bits>(plant::detail::segment_energy_here(p, s)) ? 1 : 0;
    ++connected[static_cast<std::size_t>(plant::connected_count(p.mode().legs))];
  }

  static plant::SegmentEnergy<double> by_products(const plant::Plant<double>& p, double s) {
    using series::product_integral, series::integral;
    const plant::Constants<double>& c = p.constants();
    const plant::Expansion<double>& y = p.expansion();
    const int n = y.degree;
    plant::SegmentEnergy<double> e;
    series::Coefficients<double> dc{};
    for (int k = 0; k < 3; ++k) {
      const plant::Connection leg = p.mode().legs[k];
      if (plant::is_floating(leg)) continue;
      const double square = product_integral(y.i[k], y.i[k], n, s), charge = integral(y.i[k], n, s);
      e.copper += y.h * c.R * square;
      e.devices += y.h * plant::pole_terms<double>(leg, c.devices).r_ohm * square;
      if (plant::is_diode(leg))
        e.devices += y.h * c.devices.V_f_V * (leg == plant::Connection::low_diode ? charge : -charge);
      if (plant::is_high(leg))
        for (int j = 0; j <= n; ++j) dc[j] += y.i[k][j];
    }
    e.supplied = y.h * product_integral(y.bus, dc, n, s);
    e.air_gap = y.h * product_integral(y.torque, y.w, n, s);
    e.viscous = y.h * c.B * product_integral(y.w, y.w, n, s);
    e.travel = y.h * integral(y.w, n, s);
    return e;
  }
};

/// The rounding of values, products and sums is below 64 eps of the scale in both calculations. The back-EMF
/// is a trapezoid or a sine, the bus is stiff or has R and C, and the devices are real.
TEST(SegmentEnergy, IsThatOfTheWholeProducts) {
  std::array<int, 4> connected{};
  for (int n = 0; n < 8; ++n) {
    SCOPED_TRACE(n);
    Board b = Board::duty(n % 2 == 0 ? 0.4 : -0.9, n & 2 ? control::Chopping::hard : control::Chopping::soft);
    b.devices = {.R_on_ohm = 0.02, .V_f_V = 0.7, .r_d_ohm = 0.01};
    if (n & 4) b.machine.back_emf = plant::BackEmf::sine;
    if (n % 4 >= 2) b.supply.C_F = 200e-6, b.supply.R_b_ohm = 0.1;
    b.shaft.coulomb_Nm = n & 1 ? 0.002 : 0.0;
    b.setpoint(10'000'000'000, 0.1);
    b.load(5'000'000'000, 0.05);
    std::stable_sort(b.timeline.begin(), b.timeline.end(),
                     [](const rig::Action& x, const rig::Action& y) { return x.at < y.at; });
    auto rig = b.rig();
    BesideProducts beside;
    ASSERT_EQ(run_to(rig, 20e-3, beside), sim::Stop::end);
    constexpr double tolerance = 64 * 0x1p-52;
    EXPECT_LE(beside.worst.supplied, tolerance);
    EXPECT_LE(beside.worst.copper, tolerance);
    EXPECT_LE(beside.worst.devices, tolerance);
    EXPECT_LE(beside.worst.air_gap, tolerance);
    EXPECT_LE(beside.worst.viscous, tolerance);
    EXPECT_LE(beside.worst.travel, tolerance);
    EXPECT_EQ(beside.other_bits, 0);
    for (std::size_t k = 0; k < 4; ++k) connected[k] += beside.connected[k];
  }
  EXPECT_GT(connected[2], 1000);
  EXPECT_GT(connected[3], 1000);
}

/// Kirchhoff's law applies to each order of the series of the three currents. The audit's sums check it only
/// at both ends of a segment. A floating leg has no current in any order.
struct SumsOfSeries {
  double worst_A = 0, floating_A = 0;
  int of_legs[4] = {};
  void segment(const rig::LeanRig<double>& rig, double) {
    const auto& plant = rig.plant();
    const auto& y = plant.expansion();
    for (int j = 0; j <= y.degree; ++j)
      worst_A = std::max(worst_A, std::fabs(y.i[0][j] + y.i[1][j] + y.i[2][j]));
    for (std::size_t k = 0; k < 3; ++k)
      for (int j = 0; j <= y.degree && plant::is_floating(plant.mode().legs[k]); ++j)
        floating_A = std::max(floating_A, std::fabs(y.i[k][j]));
    ++of_legs[plant::connected_count(plant.mode().legs)];
  }
};

TEST(Audit, CurrentsSumToZeroOrderByOrder) {
  const Board board = Board::duty(0.5);
  auto rig = board.rig();
  SumsOfSeries sums;
  ASSERT_EQ(run_to(rig, 20e-3, sums), sim::Stop::end);
  EXPECT_LE(sums.worst_A, 4 * eps * 24.0 / board.R_tt());
  EXPECT_EQ(sums.floating_A, 0.0);
  EXPECT_GT(sums.of_legs[2], 100);
  EXPECT_GT(sums.of_legs[3], 100);
}

/// A diode's current is continued beyond the instant at which it ends, so it has the wrong sign. The audit
/// must report an error for it; otherwise the audit would never report one.
TEST(Audit, SeesADiodeThatConductsBackwards) {
  for (const bool high : {true, false}) {
    Drivetrain setup;
    setup.shaft.locked = true;
    setup.start.angle_rad = 0.02;
    Held<> bench(setup, a_to_b());
    ASSERT_EQ(bench.run_to(10e-6), sim::Stop::end);
    // The current flows through one diode and one switch against the bus voltage. It flows into the upper
    // diode of b, or out of the lower diode of a.
    bench.plant().set_gates(high ? gates({}, {true, false, false}) : gates({false, true, false}, {}));
    const double i_0 = bench.state().i[0], length = bench.plant().expand(30e-6);
    const double exact =
        i_0 * std::exp(-length / setup.tau()) + 24.0 / setup.R_tt() * std::expm1(-length / setup.tau());
    ASSERT_LT(exact, -0.1);
    plant::Audit<double> audit;
    bench.plant().end_at(0.2);
    audit.segment(bench.plant(), 0.2);
    EXPECT_EQ(audit.laws().reverse_diode_A, 0.0) << high;
    ASSERT_EQ(bench.plant().expand(30e-6), length);
    audit.segment(bench.plant(), 1.0);
    EXPECT_NEAR(audit.laws().reverse_diode_A, -exact, 32 * eps * i_0) << high;
  }
}

}  // namespace SIXSTEP_TEST_FILE
