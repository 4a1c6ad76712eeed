// SPDX-License-Identifier: Apache-2.0
// Tests the product drive from registers to command, in the full switching simulation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/study/check/check.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::Arithmetic;
using study::MetricKind;
using study::Scenario;
using study::Signal;
using ::testing::HasSubstr;

constexpr double T = 30e-6;
// The drive receives the request to run at the first tick. Then the calibration takes 64 samples.
constexpr double calibrated_s = 64 * T;

/// Runs the scenario with a witness. The witness checks that no leg has both switches on.
study::Outcome run_watched(const Scenario& s, Witness& w) {
  auto out = study::run(s, {.on_event = [&w](study::Row row) { w(row); }});
  if (!out) {
    ADD_FAILURE() << to_string(out.problems()[0]);
    return {};
  }
  EXPECT_FALSE(w.both_of_a_leg);
  EXPECT_DOUBLE_EQ(out->simulated_s, s.duration_s) << "a trip does not end the simulation";
  return *out;
}

Scenario at_100_rad_s() {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.duration_s = 0.4;
  study::Measure m = measure(MetricKind::mean, Signal::speed);
  m.from_s = 0.3;
  ask(s, m);
  return s;
}

TEST(Product, StartsByCalibrationAndAlignmentAndHoldsTheSpeed) {
  for (const Arithmetic a : {Arithmetic::float64, Arithmetic::float32, Arithmetic::q15, Arithmetic::q31}) {
    Scenario s = at_100_rad_s();
    s.control.arithmetic = a;
    s.sensors.current_offset_A = 0.2;
    s.protection.align = {.current_A = 3.0, .longest_s = 0.1, .settled_s = 5e-3, .sector = 0};
    Witness w;
    const study::Outcome out = run_watched(s, w);
    EXPECT_FALSE(out.fault) << to_string(*out.fault);
    EXPECT_DOUBLE_EQ(w.first_on(), calibrated_s)
        << "off until the offsets are known, then the pair that pulls";
    // The bound is the same as for the lean drive (sensors_test.cpp): one timer count in 1309 per sector,
    // plus the speed ripple within a sector.
    EXPECT_NEAR(out.comparisons[0].measured, 100.0, 100.0 * (1.0 / 1309 + 0.004));
  }
}

TEST(Product, RunsAtOnceWhereNoAlignmentIsAsked) {
  Witness w;
  EXPECT_FALSE(run_watched(at_100_rad_s(), w).fault);
  EXPECT_DOUBLE_EQ(w.first_on(), calibrated_s + T) << "the tick after the last sample";
}

TEST(Product, ARotorThatDoesNotComeWherePulledIsAFault) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.load.locked = true;  // in sector 0; the alignment pulls it to another angle
  s.protection.align = {.current_A = 3.0, .longest_s = 5e-3, .settled_s = 1e-3, .sector = 0};
  Witness w;
  const study::Outcome out = run_watched(s, w);
  ASSERT_TRUE(out.fault);
  EXPECT_THAT(out.fault->limit, HasSubstr("did not reach the alignment position"));
  EXPECT_NEAR(w.off_for_good(), calibrated_s + 5e-3, 2 * T);
}

/// The recorded values of controller and plant from the time `from_s` on.
std::vector<double> recorded(const Scenario& s, double from_s) {
  std::vector<double> all;
  const auto out = study::run(s, {.on_record = [&](study::Row row) {
                                if (row[0] >= from_s)
                                  for (const double x : row)
                                    if (!std::isnan(x)) all.push_back(x);
                              }});
  EXPECT_TRUE(out && !out->fault);
  return all;
}

TEST(Product, WithoutAFaultItIsTheLeanDriveToTheLastBit) {
  // After the calibration of the offsets, the speed reference steps from rest to 100 rad/s, and later to 102
  // rad/s. During the calibration, the product's bridge is off, and the lean drive has duty 0 with a rotor at
  // rest. Neither drive has a current. After the calibration, both drives run the same loops on the same
  // counts and captured edges, so any difference is an error in one of the two programs. (The rows are on a
  // grid, and the bus voltage is stiff.)
  for (const Arithmetic a : {Arithmetic::float64, Arithmetic::float32}) {
    Scenario product = product_scenario(Mode::speed, 0.0);
    product.duration_s = 0.3;
    product.control.arithmetic = a;
    product.reference = {.shape = study::Shape::steps, .times_s = {3e-3, 0.2}, .values = {100.0, 102.0}};
    Scenario lean = product;
    lean.control.drive = study::FirmwareKind::lean;
    lean.protection = {};
    const std::vector<double> p = recorded(product, 3e-3), l = recorded(lean, 3e-3);
    ASSERT_EQ(p.size(), l.size());
    ASSERT_GT(p.size(), 100000u);
    std::size_t differ = 0;
    for (std::size_t n = 0; n < p.size(); ++n) differ += p[n] != l[n];
    EXPECT_EQ(differ, 0u);
  }
}

TEST(Product, FollowsTheStepsOf74AsTheIdealDrive) {
  // The setpoints are 100, 102, 104 and 102 rad/s, and each mean begins after the transient. A speed measured
  // from Hall edges has two errors: a timer count in a sector of 1309 counts (at 100 rad/s), and the ripple
  // within a sector. The current has 16 bits (0.6 mA per count), so that its resolution adds no error.
  Scenario s = product_scenario(Mode::speed, 0.0);
  s.duration_s = 1.6;
  s.sensors.adc_bits = 16;
  s.reference = {
      .shape = study::Shape::steps, .times_s = {0.0, 0.4, 0.8, 1.2}, .values = {100.0, 102.0, 104.0, 102.0}};
  for (int n = 0; n < 4; ++n) {
    study::Measure m = measure(MetricKind::mean, Signal::speed);
    m.from_s = 0.4 * n + 0.3;
    m.to_s = 0.4 * n + 0.4;
    ask(s, m);
  }
  Scenario ideal = s;
  ideal.control.drive = study::FirmwareKind::lean;
  ideal.sensors = {};
  ideal.protection = {};
  const auto p = study::run(s), l = study::run(ideal);
  ASSERT_TRUE(p && l);
  EXPECT_FALSE(p->fault);
  for (std::size_t n = 0; n < 4; ++n) {
    const double there = l->comparisons[n].measured;
    std::printf("%.6g rad/s, ideal %.6g\n", p->comparisons[n].measured, there);
    EXPECT_NEAR(p->comparisons[n].measured, there, there * (1.0 / 1309 + 0.004));
  }
}

TEST(Product, ABrokenHallLineStopsTheBridgeAndIsNamed) {
  for (const auto commutation : {study::CommutationAt::hall_edge, study::CommutationAt::sample})
    for (int line = 1; line <= 3; ++line)
      for (const study::Level01 level : {study::Level01::low, study::Level01::high}) {
        Scenario s = at_100_rad_s();
        s.pwm.commutation = commutation;
        s.sensors.hall_break = {.at_s = 0.3, .line = line, .level = level};
        Witness w;
        const study::Outcome out = run_watched(s, w);
        ASSERT_TRUE(out.fault) << line;
        EXPECT_THAT(out.fault->limit, HasSubstr("Hall"));
        EXPECT_THAT(out.fault->limit, HasSubstr("line H" + std::to_string(line)));
        EXPECT_GE(w.off_for_good(), 0.3);
        EXPECT_LE(w.off_for_good(), w.first_impossible() + T);
        EXPECT_LT(w.last_speed, 95.0) << "it coasts against its friction";
      }
}

TEST(Product, OverCurrentOfAHeldRotorStopsTheBridge) {
  // With full duty and a locked rotor, i = U/R (1 - exp(-t/tau)) exceeds 15 A after tau ln(1/(1 - 15 R/U)).
  for (const Arithmetic a : {Arithmetic::float64, Arithmetic::q14}) {
    Scenario s = product_scenario(Mode::duty, 1.0);
    s.control.arithmetic = a;
    s.load.locked = true;
    s.initial.angle_rad = 0.02;
    Witness w;
    const study::Outcome out = run_watched(s, w);
    ASSERT_TRUE(out.fault);
    EXPECT_THAT(out.fault->limit, HasSubstr("over-current"));
    const double passes_s = 0.572e-3 / 1.03 * std::log(1 / (1 - 15.0 * 1.03 / 24.0));
    const double since = w.off_for_good() - w.first_on(), rise_A = (24.0 - 15.0 * 1.03) / 0.572e-3 * T;
    // A reading is rounded by half a count of 10 mA, which corresponds to 1 us. The trip then waits for the
    // next sample.
    EXPECT_GE(since, passes_s - 1e-6);
    EXPECT_LE(since, passes_s + T + 1e-6);
    EXPECT_LE(w.most_A, 15.005 + rise_A);
  }
}

/// A flywheel brakes from 600 rad/s, and the source of the bus cannot sink the energy.
Scenario braking() {
  Scenario s = product_scenario(Mode::speed, 0.0);
  s.duration_s = 0.1;
  s.initial.speed_rad_s = 600.0;
  s.protection.over_speed_rad_s = 700.0;
  s.load.coulomb_Nm = 0.0;
  s.load.inertia_kg_m2 = 1e-4;
  s.control.current.limit_A = 5.0;
  s.pwm.chopping = control::Chopping::complementary;
  s.supply = {.voltage_V = 24.0, .resistance_ohm = 0.1, .capacitance_F = 10e-3, .sinks = false};
  s.protection.over_voltage_V = 30.0;
  ask(s, measure(MetricKind::maximum, Signal::bus_voltage));
  ask(s, measure(MetricKind::final_value, Signal::speed));
  return s;
}

TEST(Product, OverVoltageByRegenerationLetsTheMotorCoast) {
  Scenario s = braking();
  Witness w;
  const study::Outcome out = run_watched(s, w);
  ASSERT_TRUE(out.fault);
  EXPECT_THAT(out.fault->limit, HasSubstr("over-voltage"));
  // The bound contains half a count of 10 mV, and three samples. In these samples, 5 A plus the design's
  // overshoot and a period's ripple charge 10 mF. After the trip, the winding's energy L i^2/2 also returns
  // to the bus, where it is C U dU.
  const double i_A = 5.0 + 0.375 + (30.0 + 0.0335 * 600.0) / 0.572e-3 * T;
  const double late = 3 * T * i_A / 10e-3 + 0.005, rest = 0.572e-3 / 2 * i_A * i_A / (10e-3 * 30.0);
  EXPECT_GT(out.comparisons[0].measured, 30.0 - 0.005);
  EXPECT_LE(out.comparisons[0].measured, 30.0 + late + rest);
  EXPECT_GT(out.comparisons[1].measured, 300.0) << "it coasts";
  s.control.regeneration.limit_V = 29.0;
  Witness limited;
  EXPECT_FALSE(run_watched(s, limited).fault) << "the limit keeps the drive from its threshold";
}

TEST(Product, UnderVoltageOfASaggingSourceStopsTheBridge) {
  // While the drive accelerates, 10 A flow through 1 ohm. The bus falls towards 24 V - d 10 A (duty d), which
  // is below 20 V.
  Scenario s = product_scenario(Mode::speed, 300.0);
  s.duration_s = 0.2;
  s.supply = {.voltage_V = 24.0, .resistance_ohm = 1.0, .capacitance_F = 1e-3};
  s.load.inertia_kg_m2 = 1e-4;
  s.protection.under_voltage_V = 20.0;
  ask(s, measure(MetricKind::minimum, Signal::bus_voltage));
  Witness w;
  const study::Outcome out = run_watched(s, w);
  ASSERT_TRUE(out.fault);
  EXPECT_THAT(out.fault->limit, HasSubstr("under-voltage"));
  EXPECT_LT(out.comparisons[0].measured, 20.0 + 0.005);
  // In three samples, at most 10 A plus the overshoot discharge 1 mF. The over-current threshold limits this
  // current to 15 A.
  EXPECT_GT(out.comparisons[0].measured, 20.0 - 3 * T * 15.0 / 1e-3 - 0.005);
}

TEST(Product, StallIsToldWithinItsTime) {
  Scenario s = product_scenario(Mode::current, 5.0);
  s.duration_s = 0.1;
  s.load.locked = true;
  s.protection.stall_current_A = 3.0;
  s.protection.stall_s = 20e-3;
  Witness w;
  const study::Outcome out = run_watched(s, w);
  ASSERT_TRUE(out.fault);
  EXPECT_THAT(out.fault->limit, HasSubstr("stall"));
  // The stall time is 20 ms, from the first sample above 3 A. The current loop exceeds 3 A within its
  // settling time.
  const double since = w.off_for_good() - w.first_on();
  EXPECT_GE(since, 20e-3 - T);
  EXPECT_LE(since, 20e-3 + 1e-3 + T);
  s.protection.stall_current_A = s.protection.stall_s = std::nullopt;
  Witness unwatched;
  EXPECT_FALSE(run_watched(s, unwatched).fault);
}

TEST(Product, OverSpeedOfADrivingLoadStopsTheBridge) {
  Scenario s = at_100_rad_s();
  s.protection.over_speed_rad_s = 150.0;
  s.control.current.limit_A = 3.0;  // 0.1 N m from the drive; the load drives with 0.3 N m
  s.load.times_s = {0.0, 0.3};
  s.load.torques_Nm = {0.0, -0.3};
  Witness w;
  const study::Outcome out = run_watched(s, w);
  ASSERT_TRUE(out.fault);
  EXPECT_THAT(out.fault->limit, HasSubstr("over-speed"));
  double fastest = 0.0;
  for (const Witness::Instant& n : w.seen)
    if (n.any_gate) fastest = std::max(fastest, n.speed);
  EXPECT_GE(fastest, 150.0);
  // An edge shows the mean speed over the sector before the edge. The trip is therefore late by up to one and
  // a half sectors and a sample.
  const double rad_s2 = 0.3 / 1.35e-5;
  EXPECT_LE(fastest, 150.0 + rad_s2 * (1.5 * M_PI / 24 / 150.0 + T));
}

TEST(Product, BrakesThenLetsGoWhenTheRequestEnds) {
  Scenario s = at_100_rad_s();
  s.reference.value = 200.0;
  s.duration_s = 1.2;
  s.load.coulomb_Nm = 0.002;
  s.load.inertia_kg_m2 = 1e-4;
  s.protection.brake_current_A = 5.0;
  s.protection.off_at_s = 0.4;
  study::Measure least = measure(MetricKind::minimum, Signal::current);
  least.from_s = 0.4;
  ask(s, least);
  Witness w;
  const study::Outcome out = run_watched(s, w);
  EXPECT_FALSE(out.fault);
  EXPECT_LT(out.comparisons[1].measured, -4.0) << "against the turning";
  EXPECT_NEAR(w.last_speed, 0.0, 1.0);
  // The drive brakes with 5 A to 154 rad/s, where the short circuit conducts 5 A, or at most to standstill.
  // Then the speed follows w' = -w/tau - c, with tau = J R/K_t^2 and c from the friction, until the edges
  // time out.
  const double J = 1.135e-4, K_t = 0.0335, tau = J * 1.03 / (K_t * K_t), c = 0.002 / J,
               from = 5.0 * 1.03 / K_t;
  EXPECT_GT(w.off_for_good(), 0.4 + J * (200.0 - from) / (K_t * 5.0 + 0.002) + 0.05);
  EXPECT_LT(w.off_for_good(), 0.4 + J * 200.0 / (K_t * 5.0) + tau * std::log(1 + from / (tau * c)) + 0.05);
  s.protection.brake_current_A = 0.0;
  Witness coasts;
  run_watched(s, coasts);
  EXPECT_GT(coasts.last_speed, 100.0) << "friction alone takes 14 rad/s from 200 in 0.8 s, and B its share";
}

TEST(Product, OneShuntAndALateAnswerStopWithinTheTickToo) {
  Scenario shunt = at_100_rad_s();
  shunt.pwm.alignment = study::Alignment::centre;
  shunt.pwm.sample = study::SampleAt::middle;
  shunt.sensors.currents = rig::CurrentMeasurement::dc_link;
  Witness w;
  const study::Outcome out = run_watched(shunt, w);
  EXPECT_FALSE(out.fault) << to_string(*out.fault);
  EXPECT_NEAR(out.comparisons[0].measured, 100.0, 100.0 * (1.0 / 1309 + 0.004));
  Scenario late = at_100_rad_s();
  late.pwm.delay_periods = 1;
  for (Scenario s : {shunt, late}) {
    s.sensors.hall_break = {.at_s = 0.3, .line = 2, .level = study::Level01::high};
    Witness broken;
    EXPECT_TRUE(run_watched(s, broken).fault);
    EXPECT_LE(broken.off_for_good(), broken.first_impossible() + T);
  }
}

TEST(Product, SaysWhatItLacks) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.sensors = {};
  s.protection.over_current_A = std::nullopt;
  s.protection.stall_s = 0.1;
  std::string all;
  for (const base::Problem& p : study::check(s)) all += to_string(p) + "\n";
  for (const char* key : {"sensors.currents", "sensors.bus", "sensors.rotor", "protection.over_current_A",
                          "protection.stall_current_A"})
    EXPECT_THAT(all, HasSubstr(key));
  s = product_scenario(Mode::speed, 100.0);
  s.protection.over_current_A = 25.0;
  ASSERT_EQ(study::check(s).size(), 1u);
  EXPECT_THAT(to_string(study::check(s)[0]), HasSubstr("converter measures only up to"));
  s = product_scenario(Mode::speed, 100.0);
  s.control.drive = study::FirmwareKind::lean;
  ASSERT_EQ(study::check(s).size(), 1u);
  EXPECT_THAT(to_string(study::check(s)[0]), HasSubstr("product drive only"));
}

}  // namespace SIXSTEP_TEST_FILE
