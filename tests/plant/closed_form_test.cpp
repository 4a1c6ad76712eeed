// SPDX-License-Identifier: Apache-2.0
// The plant is compared with closed solutions for stall, coasting, braking, the decay of a diode's current,
// and the bus.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/laws.hpp"
#include "tests/support/maxon.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using sim::Stop;

TEST(Stall, CurrentRisesExponentially) {
  Drivetrain setup;
  setup.shaft.locked = true;
  setup.start.angle_rad = 0.02;
  Held<> bench(setup, a_to_b());
  LawChecker<> laws;
  for (const double t : {1e-9, 10e-6, 123.456e-6, 0.5e-3, 1e-3, 2e-3, 5e-3}) {
    ASSERT_EQ(bench.run_to(t, laws), Stop::end);
    const double exact = -setup.supply.V_0_V / setup.R_tt() * std::expm1(-t * setup.R_tt() / setup.L_tt());
    EXPECT_NEAR(bench.state().i[0], exact, 1e-13 * exact) << t;
    EXPECT_EQ(bench.state().i[1], -bench.state().i[0]);
    EXPECT_EQ(bench.state().i[2], 0.0);
  }
  laws.expect_all();
}

TEST(Stall, DeviceDropsEnterAsTheyShould) {
  Drivetrain setup;
  setup.shaft.locked = true;
  setup.start.angle_rad = 0.02;
  setup.devices = {.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.02};
  Held<> bench(setup, a_to_b());
  ASSERT_EQ(bench.run_to(1e-3), Stop::end);
  const double R = setup.R_tt() + 0.02;  // the channels of two switches
  const double exact = -24.0 / R * std::expm1(-1e-3 * R / setup.L_tt());
  EXPECT_NEAR(bench.state().i[0], exact, 1e-13 * exact);
}

TEST(CoastDown, SpeedFallsExponentiallyWithViscousFriction) {
  Drivetrain setup;
  setup.start.speed_rad_s = 500.0;  // 2 K_e w = 16.75 V: no diode conducts
  Held<> bench(setup, all_off());
  LawChecker<> laws;
  ASSERT_EQ(bench.run_to(0.1, laws), Stop::end);
  const double rate = setup.shaft.B_Nm_s / setup.shaft.J_kg_m2;
  EXPECT_NEAR(bench.state().w, 500.0 * std::exp(-0.1 * rate), 8 * eps * 500.0);
  const double turned = -500.0 / rate * std::expm1(-0.1 * rate);
  EXPECT_NEAR(bench.angle(), turned, 8 * eps * turned);
  laws.expect_all();
  EXPECT_EQ(laws.highest_current_A(), 0.0);
}

/// Largest error, in rad, of the angle in snapshots within a segment. Meanwhile, the plant's state is still
/// the state at the beginning of the segment.
struct Between {
  double worst = 0.0;
  void segment(const Held<>& bench, double s) {
    const auto& plant = bench.plant();
    for (const double part : {0.0, 0.3, 1.0}) {
      const double later_s = bench.now().seconds() + part * s * plant.expansion().h;
      worst = std::fmax(worst, std::fabs(plant.at(part * s).angle - 400.0 * later_s));
    }
  }
};

TEST(CoastDown, SnapshotsTurnWithTheRotor) {
  Drivetrain setup;
  setup.shaft.B_Nm_s = 0.0;
  setup.start.speed_rad_s = 400.0;
  Held<> bench(setup, all_off());
  Between between;
  ASSERT_EQ(bench.run_to(10e-3, between), Stop::end);
  EXPECT_LE(between.worst, 8 * eps * 4.0);
}

TEST(ShortCircuitBrake, TurnsMotionIntoHeatAndTakesNothingFromTheBus) {
  Drivetrain setup;
  setup.start.speed_rad_s = 600.0;
  Held<> bench(setup, all_low());
  LawChecker<> laws;
  double before = 600.0;
  for (double t = 1e-3; t < 0.2; t += 1e-3) {
    ASSERT_EQ(bench.run_to(t, laws), Stop::end);
    EXPECT_LE(bench.state().w, before + 64 * eps * 716.0) << t;
    before = bench.state().w;
  }
  const plant::EnergyBook book = laws.audit().energy();
  EXPECT_EQ(book.supplied, 0.0);
  EXPECT_GT(book.copper, 0.9 * 0.5 * setup.shaft.J_kg_m2 * 600 * 600);
  EXPECT_NEAR(book.copper + book.friction, -book.kinetic - book.magnetic, 1e-11 * std::fabs(book.kinetic));
  EXPECT_LT(bench.state().w, 1.0) << "the mechanical time constant is about 12 ms";
  laws.expect_all();
}

struct Decay {
  Drivetrain setup;
  Held<> bench;
  double i_0;
};

/// The rotor is locked. A current flows from a to b, or from a to b and c, for 0.3 ms. Then all gates are
/// off.
Decay start_decay(const plant::Devices& devices, const plant::Gates& first) {
  Drivetrain setup;
  setup.shaft.locked = true;
  setup.start.angle_rad = 0.02;
  setup.devices = devices;
  Decay d{setup, Held<>(setup, first), 0.0};
  EXPECT_EQ(d.bench.run_to(0.3e-3), Stop::end);
  d.i_0 = d.bench.state().i[0];
  EXPECT_GT(d.i_0, 5.0);
  EXPECT_TRUE(d.bench.plant().set_gates(all_off()));
  return d;
}

void expect_zero_at(Decay& d, double R, double L, double U) {
  LawChecker<> laws;
  ASSERT_EQ(d.bench.run_to(1e-3, laws), Stop::end);
  ASSERT_EQ(d.bench.events.size(), 1u) << "all currents vanish in one event";
  // The current starts at i_0 and follows U + R i + L di/dt = 0. It reaches 0 at (L/R) ln(1 + i_0 R/U).
  const double exact = L / R * std::log1p(d.i_0 * R / U);
  const double found = sim::seconds_between(sim::to_instant(0.3e-3), d.bench.events[0].at);
  // The error of the current is a few eps of its scale. Near zero, the current falls by U/L per second.
  EXPECT_NEAR(found, exact, 8 * eps * (d.i_0 + U / R) * L / U);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(d.bench.state().i[k], 0.0);
    EXPECT_TRUE(plant::is_floating(d.bench.plant().mode().legs[k]));
  }
  laws.expect_all();
}

TEST(DiodeDecay, CurrentThroughTwoIdealDiodesEndsAtTheClosedFormInstant) {
  Decay d = start_decay({}, a_to_b());
  expect_zero_at(d, d.setup.R_tt(), d.setup.L_tt(), 24.0);
}

TEST(DiodeDecay, RealDiodesEndItSooner) {
  Decay d = start_decay({.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.02}, a_to_b());
  expect_zero_at(d, d.setup.R_tt() + 0.04, d.setup.L_tt(), 24.0 + 1.4);
}

TEST(DiodeDecay, ThreeCurrentsMayVanishTogether) {
  Decay d = start_decay({}, gates({true, false, false}, {false, true, true}));
  EXPECT_NEAR(d.bench.state().i[1], d.bench.state().i[2], 4 * eps * d.i_0);
  expect_zero_at(d, 1.5 * d.setup.machine.R_ohm, 1.5 * d.setup.machine.L_H, 24.0);
}

TEST(DiodeDecay, FreewheelingInALoopNeverCrossesZero) {
  // The rotor is locked, and the lower switch of b remains on. The loop through the lower diode of a contains
  // no voltage source.
  Decay d = start_decay({}, a_to_b());
  d.bench.plant().set_gates(gates({}, {false, true, false}));
  ASSERT_EQ(d.bench.run_to(5e-3), Stop::end);
  const double exact = d.i_0 * std::exp(-4.7e-3 / d.setup.tau());
  EXPECT_NEAR(d.bench.state().i[0], exact, 32 * eps * d.i_0);
  EXPECT_TRUE(d.bench.events.empty());
}

Drivetrain rc_bus(double bus_V, bool sinks) {
  Drivetrain setup;
  setup.supply = {.V_0_V = 24.0, .R_b_ohm = 0.1, .C_F = 1e-3, .sinks = sinks};
  setup.start.bus_V = bus_V;
  return setup;
}

TEST(Bus, CapacitorChargesThroughTheSourcesResistance) {
  for (const bool sinks : {true, false}) {
    Held<> bench(rc_bus(20.0, sinks), all_off());
    ASSERT_EQ(bench.run_to(0.2e-3), Stop::end);
    EXPECT_NEAR(bench.state().bus, 24.0 - 4.0 * std::exp(-0.2e-3 / 1e-4), 16 * eps * 24.0) << sinks;
  }
}

TEST(Bus, ASourceThatCannotSinkLeavesAHigherBusAlone) {
  Held<> sinking(rc_bus(30.0, true), all_off()), rectified(rc_bus(30.0, false), all_off());
  ASSERT_EQ(sinking.run_to(0.2e-3), Stop::end);
  ASSERT_EQ(rectified.run_to(0.2e-3), Stop::end);
  EXPECT_NEAR(sinking.state().bus, 24.0 + 6.0 * std::exp(-0.2e-3 / 1e-4), 16 * eps * 30.0);
  EXPECT_EQ(rectified.state().bus, 30.0);
}

TEST(Bus, RegenerationLiftsABusThatCannotGiveBack) {
  for (const bool sinks : {true, false}) {
    Drivetrain setup = rc_bus(24.0, sinks);
    setup.start.speed_rad_s = 900.0;  // 2 K_e w = 30.15 V: the diodes rectify
    Held<> bench(setup, all_off());
    LawChecker<> laws;
    ASSERT_EQ(bench.run_to(20e-3, laws), Stop::end);
    laws.expect_all();
    if (sinks) continue;
    // Nothing discharges the capacitor, so its energy rises by the energy that the bridge returned.
    const double U = bench.state().bus;
    EXPECT_GT(U, 25.0);
    const double gained = 0.5 * 1e-3 * (U * U - 24.0 * 24.0);
    EXPECT_NEAR(-laws.audit().energy().supplied, gained, 1e-11 * gained);
  }
}

TEST(Gates, ShootThroughIsRefusedAndChangesNothing) {
  plant::Plant<double> plant = Drivetrain{}.plant();
  ASSERT_TRUE(plant.set_gates(a_to_b()));
  for (int k = 0; k < 3; ++k) {
    plant::Gates bad = a_to_b();
    bad.high[k] = bad.low[k] = true;
    EXPECT_FALSE(plant.set_gates(bad));
    EXPECT_EQ(plant.gates(), a_to_b());
  }
}

}  // namespace SIXSTEP_TEST_FILE
