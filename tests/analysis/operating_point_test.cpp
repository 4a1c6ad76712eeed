// SPDX-License-Identifier: Apache-2.0
// The steady state at a constant speed is compared with physical laws and with independent runs.
#include "sixstep/analysis/curve/operating_point.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/analysis/curve/full_on.hpp"
#include "sixstep/analysis/curve/open_loop.hpp"
#include "sixstep/analysis/curve/sums_recorder.hpp"
#include "sixstep/base/random.hpp"
#include "tests/support/bench.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::Bench;
using analysis::OperatingPoint;
using analysis::Orbit;

OperatingPoint at(const Bench& b, double speed) {
  const base::Result<OperatingPoint> p = analysis::operating_point(b, speed);
  EXPECT_TRUE(p) << base::to_string(p.problems()[0]);
  return p ? *p : OperatingPoint{};
}

const double speeds[] = {0.5, 20.0, 150.0, 400.0, 548.7, 702.6, 716.0, 900.0, 1500.0, -10.0, -300.0};

/// Largest relative residual of a point's energies. It allows for the rounding of the integrals over some
/// hundred segments, a few machine epsilons each, and of their sums.
constexpr double balance = 1e-12;

TEST(OperatingPoint, EnergyBalances) {
  for (const bool ideal : {true, false}) {
    Bench b = maxon_bench();
    if (!ideal) b.devices = {.R_on_ohm = 0.02, .V_f_V = 0.7, .r_d_ohm = 0.01};
    for (const double speed : speeds) {
      const OperatingPoint p = at(b, speed);
      SCOPED_TRACE(speed);
      EXPECT_LE(std::fabs(p.energy_residual), balance);
      const double left = p.supplied_W - p.copper_W - p.devices_W - p.friction_W - p.shaft_W;
      // The mean torque is computed separately from the mean of T_e w (torque times speed). The stored energy
      // changes by the residual of the periodic orbit.
      EXPECT_NEAR(left, 0.0, balance * (p.copper_W + std::fabs(p.supplied_W) + std::fabs(p.shaft_W)));
      EXPECT_EQ(p.devices_W > 0, !ideal);
    }
  }
}

TEST(OperatingPoint, ComesWithABoundFarBelowANanoampere) {
  for (const double speed : speeds) {
    const OperatingPoint p = at(maxon_bench(), speed);
    EXPECT_EQ(p.orbit, Orbit::periodic);
    EXPECT_TRUE(p.precise);
    EXPECT_LE(p.residual_A, 1e-9) << speed;
    EXPECT_LE(p.error_bound_A, 1e-9) << speed;
    EXPECT_GE(p.error_bound_A, p.residual_A * 0.5);
  }
}

TEST(OperatingPoint, RippleAndRmsAreOrderedAsTheyMustBe) {
  for (const double speed : speeds) {
    const OperatingPoint p = at(maxon_bench(), speed);
    SCOPED_TRACE(speed);
    EXPECT_LE(p.ripple_rms_Nm, p.ripple_Nm / 2 * (1 + 1e-12));  // Popoviciu's inequality
    EXPECT_LE(p.phase_rms_A, p.phase_peak_A);
    EXPECT_LE(p.motor_current_A, p.winding_current_A * (1 + 1e-12));  // triangle inequality
    // The three currents sum to zero, so half the sum of their magnitudes is the largest magnitude. Its
    // square is at most 2/3 of the sum of squares.
    EXPECT_LE(p.winding_current_A, std::sqrt(2.0) * p.phase_rms_A * (1 + 1e-12));
  }
}

/// A run of the complete program at a speed that a large flywheel keeps constant. With 1e9 kg m^2, 0.8 N m
/// changes the speed by less than 1e-10 rad/s in 0.1 s.
study::Outcome long_run(const Bench& b, double speed, double from_s, double seconds) {
  study::Scenario s = maxon_scenario(control::Mode::duty, b.duty);
  s.duration_s = from_s + seconds;
  s.load.inertia_kg_m2 = 1e9;
  s.initial.speed_rad_s = speed;
  s.bridge.on_resistance_ohm = b.devices.R_on_ohm;
  s.bridge.diode_drop_V = b.devices.V_f_V;
  s.bridge.diode_resistance_ohm = b.devices.r_d_ohm;
  using study::MetricKind;
  using study::Signal;
  for (const auto& [kind, signal] : {std::pair{MetricKind::mean, Signal::torque},
                                     {MetricKind::peak_to_peak, Signal::torque},
                                     {MetricKind::mean, Signal::bus_current},
                                     {MetricKind::mean, Signal::current_magnitude},
                                     {MetricKind::rms, Signal::phase_a},
                                     {MetricKind::maximum, Signal::phase_a}}) {
    study::Measure m = measure(kind, signal);
    m.from_s = from_s;
    m.to_s = from_s + seconds;
    ask(s, m);
  }
  base::Result<study::Outcome> out = study::run(s);
  EXPECT_TRUE(out) << base::to_string(out.problems()[0]);
  return std::move(*out);
}

TEST(OperatingPoint, IsTheTailOfALongRunTo1e9) {
  for (const bool ideal : {true, false})
    for (const double speed : {60.0, 400.0, 702.6, 1500.0, -300.0}) {
      SCOPED_TRACE(speed);
      Bench b = maxon_bench();
      if (!ideal) b.devices = {.R_on_ohm = 0.02, .V_f_V = 0.7, .r_d_ohm = 0.01};
      const OperatingPoint p = at(b, speed);
      // The window has whole electrical turns and begins after 60 time constants. Its ends are rounded to
      // picoseconds, which is an error of 1e-12 s at 40 A in at least 0.02 s.
      const double turn_s = 2 * base::pi / (8 * std::fabs(speed));
      const study::Outcome run = long_run(b, speed, 0.035, std::ceil(0.02 / turn_s) * turn_s);
      const auto measured = [&](std::size_t n) { return run.comparisons[n].measured; };
      EXPECT_NEAR(p.torque_Nm, measured(0), 1e-9);
      EXPECT_NEAR(p.ripple_Nm, measured(1), 1e-9);
      EXPECT_NEAR(p.bus_current_A, measured(2), 4e-9);
      EXPECT_NEAR(p.winding_current_A, measured(3), 4e-9);
      EXPECT_NEAR(p.phase_rms_A, measured(4), 4e-9);
      EXPECT_NEAR(p.phase_peak_A, measured(5), 1e-9);
    }
}

TEST(OperatingPoint, WithoutInductanceIsTheIdealLine) {
  for (const double speed : {50.0, 400.0, 650.0}) {
    Bench b = maxon_bench();
    const double ideal = analysis::ideal_torque_Nm(b, speed);
    const auto missing = [&](double part) {
      b.motor.machine.L_H = part * 0.286e-3;
      return ideal - at(b, speed).torque_Nm;
    };
    const double coarse = missing(1e-3), fine = missing(0.5e-3);
    EXPECT_GT(coarse, 0.0) << speed;
    // To first order, the torque lost to inductance is proportional to L. The relative error of second order
    // is the ratio of lost torque to ideal torque.
    EXPECT_NEAR(fine / coarse, 0.5, 2 * coarse / ideal) << speed;
    EXPECT_NEAR(2 * fine - coarse, 0.0, 2 * coarse * coarse / ideal) << speed;
  }
}

TEST(OperatingPoint, InductanceBendsTheLineDownwards) {
  const Bench b = maxon_bench();
  for (const double speed : {50.0, 200.0, 400.0, 600.0, 702.6})
    EXPECT_LT(at(b, speed).torque_Nm, analysis::ideal_torque_Nm(b, speed)) << speed;
  // At the ideal no-load speed, no current flows, so commutation has no effect.
  const double axis = analysis::ideal_no_load_rad_s(b);
  EXPECT_NEAR(at(b, axis).torque_Nm, 0.0, 1e-14);
}

TEST(OperatingPoint, MirroredItIsTheSame) {
  for (const double speed : {30.0, 400.0, 900.0, -200.0}) {
    Bench b = maxon_bench();
    b.devices = {.R_on_ohm = 0.02, .V_f_V = 0.7, .r_d_ohm = 0.01};
    const OperatingPoint p = at(b, speed);
    b.duty = -1;
    const OperatingPoint q = at(b, -speed);
    const double bound = p.error_bound_A + q.error_bound_A;
    EXPECT_NEAR(p.torque_Nm, -q.torque_Nm, 2 * 0.0335 * bound) << speed;
    EXPECT_NEAR(p.shaft_torque_Nm, -q.shaft_torque_Nm, 2 * 0.0335 * bound) << speed;
    EXPECT_NEAR(p.ripple_Nm, q.ripple_Nm, 4 * 0.0335 * bound) << speed;
    EXPECT_NEAR(p.bus_current_A, q.bus_current_A, 2 * bound) << speed;
    EXPECT_NEAR(p.phase_peak_A, q.phase_peak_A, bound) << speed;
  }
}

/// Mean over rotors held at many angles. Gauss quadrature on each piece of the back-EMF's shape is exact if
/// the pieces are linear.
struct HeldMeans {
  double torque = 0.0, square = 0.0, low = 1e9, high = -1e9;
};
HeldMeans held(const Bench& b, const std::vector<double>& kinks_deg) {
  HeldMeans out;
  for (std::size_t n = 0; n + 1 < kinks_deg.size(); ++n) {
    const double from = kinks_deg[n], span = kinks_deg[n + 1] - from;
    const auto torque_at = [&](double deg) {
      Drivetrain setup{b.motor.machine, {.J_kg_m2 = 1.0, .locked = true}};
      setup.start.angle_rad = at_electrical_deg(deg);
      Held<> bench(setup, a_to_b());
      EXPECT_EQ(bench.run_to(50 * setup.tau()), sim::Stop::end);
      bench.plant().expand(1e-6);
      const double T = bench.plant().at(0.0).torque;
      out.low = std::min(out.low, T);
      out.high = std::max(out.high, T);
      return T;
    };
    for (std::size_t k = 0; k < 8; ++k) {
      const double T = torque_at(from + span * static_cast<double>(series::gauss<8>.node[k]));
      const double weight = span / 60 * static_cast<double>(series::gauss<8>.weight[k]);
      out.torque += weight * T;
      out.square += weight * T * T;
    }
    torque_at(from + 1e-9);
    torque_at(from + span - 1e-9);
  }
  return out;
}

TEST(OperatingPoint, AtStandstillIsTheMeanOverHeldRotors) {
  using design::BackEmfShape;
  struct Case {
    Bench bench;
    std::vector<double> kinks_deg;
  };
  for (const Case& c :
       {Case{maxon_bench(), {0, 60}}, Case{shaped(BackEmfShape::trapezoid, 90), {0, 15, 45, 60}},
        Case{shaped(BackEmfShape::sine, 120), {0, 30, 60}}}) {
    const OperatingPoint p = at(c.bench, 0.0);
    const HeldMeans mean = held(c.bench, c.kinks_deg);
    EXPECT_EQ(p.orbit, Orbit::standstill);
    EXPECT_NEAR(p.torque_Nm, 0.0335 * 24 / 1.03, 4 * eps) << "K_t U/R";
    EXPECT_NEAR(p.torque_Nm, mean.torque, 1e-12);  // the table of the back-EMF's shape is in degrees and rad
    EXPECT_NEAR(p.ripple_rms_Nm, std::sqrt(std::max(0.0, mean.square - mean.torque * mean.torque)), 2e-8);
    EXPECT_NEAR(p.ripple_Nm, mean.high - mean.low, 1e-8);
    EXPECT_NEAR(p.phase_rms_A, std::sqrt(2.0 / 3) * 24 / 1.03, 1e-13);
  }
}

TEST(OperatingPoint, ALockedRotorLoadsTwoPhasesAndItsAngleDecides) {
  const double i = 24 / 1.03;
  for (const Bench& b : {maxon_bench(), shaped(design::BackEmfShape::trapezoid, 90),
                         shaped(design::BackEmfShape::sine, 120)}) {
    const OperatingPoint p = at(b, 0.0);
    const HeldMeans angles = held(b, {0, 15, 30, 45, 60});
    ASSERT_TRUE(p.locked);
    EXPECT_NEAR(p.locked->phase_rms_A, i, 1e-12) << "nobody takes turns";
    EXPECT_NEAR(p.locked->least_torque_Nm, angles.low, 1e-8);
    EXPECT_NEAR(p.locked->greatest_torque_Nm, angles.high, 1e-8);
    EXPECT_EQ(p.locked->ripple_Nm, 0.0);
    EXPECT_FALSE(at(b, 1.0).locked);
  }
  Bench chopped = maxon_bench();
  chopped.duty = 0.5;
  const OperatingPoint p = at(chopped, 0.0);
  ASSERT_TRUE(p.locked);
  EXPECT_NEAR(3 * p.phase_rms_A * p.phase_rms_A, 2 * p.locked->phase_rms_A * p.locked->phase_rms_A, 1e-9);
  EXPECT_GT(p.locked->ripple_Nm, 0.0);
}

TEST(OperatingPoint, SlowRotationLeadsToStandstill) {
  for (const Bench& b : {maxon_bench(), shaped(design::BackEmfShape::sine, 120)}) {
    const OperatingPoint still = at(b, 0.0), slow = at(b, 0.01), slower = at(b, 0.005);
    // Two effects are of first order in the speed: the back-EMF, and the part of the time in commutations.
    EXPECT_NEAR(2 * slower.torque_Nm - slow.torque_Nm, still.torque_Nm, 1e-9);
    EXPECT_LT(slow.torque_Nm, slower.torque_Nm);
    EXPECT_LT(slower.torque_Nm, still.torque_Nm);
    EXPECT_NEAR(2 * slower.bus_current_A - slow.bus_current_A, still.bus_current_A, 3e-8);
  }
}

/// Dry friction remains constant as the rotor slows down. At speed 0, the friction is equal to the friction
/// of slow rotation, but at most equal to the driving torque.
TEST(OperatingPoint, WhatJustTurnsHasTheFrictionOfSlowRotation) {
  Bench b = maxon_bench();
  b.motor.shaft.coulomb_Nm = 0.1;
  const OperatingPoint still = at(b, 0.0), slow = at(b, 0.01), slower = at(b, 0.005);
  EXPECT_NEAR(still.torque_Nm - still.shaft_torque_Nm, 0.1, 1e-12);
  EXPECT_NEAR(2 * slower.shaft_torque_Nm - slow.shaft_torque_Nm, still.shaft_torque_Nm, 1e-9);
  b.motor.shaft.coulomb_Nm = 2 * still.torque_Nm;
  EXPECT_EQ(at(b, 0.0).shaft_torque_Nm, 0.0);
}

TEST(OperatingPoint, ChoppedIntervalCoversARunTenTimesAsLong) {
  constexpr std::uint64_t seed = 20260611;
  constexpr int drawn = 8;
  int missed = 0;
  for (std::uint64_t n = 0; n < drawn; ++n) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ", draw " << n);
    const auto draw = [&](std::uint64_t what) { return base::uniform({seed, what, n}); };
    Bench b = maxon_bench();
    b.duty = 0.2 + 0.7 * draw(0);
    b.chopping = static_cast<control::Chopping>(static_cast<int>(3 * draw(1)));
    b.devices = {.R_on_ohm = 0.02, .V_f_V = 0.5, .r_d_ohm = 0.01};
    const double speed = 30 + 600 * draw(2);
    const OperatingPoint p = at(b, speed);
    EXPECT_EQ(p.orbit, Orbit::quasi_periodic);
    EXPECT_TRUE(p.precise);
    EXPECT_LE(std::fabs(p.energy_residual), 1e-11);
    EXPECT_GE(p.winding_current_A, p.motor_current_A);
    analysis::OpenLoop run(b, analysis::plant_of(b, analysis::imposed_speed(), speed));
    analysis::SumsRecorder recorder;
    ASSERT_EQ(run.run_for(0.02), sim::Stop::end);
    ASSERT_EQ(run.run_for(10 * p.simulated_s, recorder), sim::Stop::end);
    const analysis::Sums& s = recorder.sums();
    missed += std::fabs(p.torque_Nm - s.torque / s.seconds) > p.half_width_Nm;
    missed += std::fabs(p.bus_current_A - s.supplied / s.seconds / 24) > p.half_width_A;
  }
  // The intervals have a confidence of 99 %. With random phases of the PWM, more than one of 16 intervals
  // would miss in one of 90 runs. The phases in this test are evenly spread.
  EXPECT_LE(missed, 1) << "seed " << seed;
}

TEST(OperatingPoint, ChoppedAtNearlyFullDutyComesToFullDuty) {
  Bench b = maxon_bench();
  const OperatingPoint full = at(b, 400.0);
  b.duty = 1 - 1e-6;  // one part in a million of the period, 30 ps
  const OperatingPoint chopped = at(b, 400.0);
  EXPECT_NEAR(chopped.torque_Nm, full.torque_Nm, 5e-6 * 0.78 + chopped.half_width_Nm);
  EXPECT_NEAR(chopped.phase_peak_A, full.phase_peak_A, 1e-3);
}

TEST(OperatingPoint, HeldRotorUnderChoppingIsTheMeanVoltageOverTheResistance) {
  // With ideal devices, the current never stops. The mean voltage is d U for soft and complementary chopping,
  // and (2 d - 1) U for hard chopping, with duty d and bus voltage U.
  for (const control::Chopping chopping :
       {control::Chopping::soft, control::Chopping::hard, control::Chopping::complementary}) {
    Bench b = maxon_bench();
    b.duty = 0.8;
    b.chopping = chopping;
    const OperatingPoint p = at(b, 0.0);
    // After twenty time constants, exp(-20) of the initial deviation remains.
    EXPECT_NEAR(p.torque_Nm, 0.0335 * analysis::mean_voltage_V(b) / 1.03, std::exp(-20.0) * p.torque_Nm)
        << name_of(chopping);
    EXPECT_NEAR(p.energy_residual, 0.0, balance);
  }
}

TEST(OperatingPoint, RefusesWhatIsNoOperatingPoint) {
  const auto refused = [](auto&& change, const char* text, double speed = 100.0) {
    Bench b = maxon_bench();
    change(b);
    const base::Result<OperatingPoint> p = analysis::operating_point(b, speed);
    ASSERT_FALSE(p);
    EXPECT_NE(base::to_string(p.problems()[0]).find(text), std::string::npos)
        << base::to_string(p.problems()[0]);
  };
  refused([](Bench& b) { b.duty = 0; }, "duty = 0 must be in (0, 1]");
  refused([](Bench& b) { b.duty = 1.2; }, "duty = 1.2");
  refused([](Bench& b) { b.voltage_V = -24; }, "voltage_V = -24 must be above 0");
  refused([](Bench& b) { b.pwm_period_s = 0; }, "pwm_period_s = 0");
  refused([](Bench& b) { b.devices.V_f_V = -0.7; }, "diode_drop_V = -0.7");
  refused([](Bench&) {}, "must be a finite number", std::nan(""));
}

}  // namespace SIXSTEP_TEST_FILE
