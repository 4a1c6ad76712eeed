// SPDX-License-Identifier: Apache-2.0
// Tests the drive with the sensors of a board in its loops, in the full switching simulation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using rig::CurrentMeasurement;
using study::Arithmetic;
using study::MetricKind;
using study::Scenario;
using study::Signal;
using ::testing::HasSubstr;

/// The drive controls 5 A with a locked rotor, so only the measurement changes the result.
Scenario held_at_5_A() {
  Scenario s = maxon_scenario(Mode::current, 5.0);
  s.load.locked = true;
  s.initial.angle_rad = 0.02;
  study::Measure m = measure(MetricKind::mean, Signal::current);
  m.from_s = 10e-3;
  ask(s, m);
  return s;
}

Scenario with_phases(Scenario s, int bits = 12) {
  s.sensors.currents = CurrentMeasurement::phases;
  s.sensors.adc_bits = bits;
  s.sensors.current_range_A = 20.48;
  return s;
}

double mean_of(const Scenario& s) {
  const auto out = study::run(s);
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  return out ? out->comparisons[0].measured : -1e9;
}

TEST(Sensors, ConverterHoldsTheCurrentWithinHalfACount) {
  // The integral controls the mean reading to 5 A, which is a whole number of counts. Every reading differs
  // from its current by at most half a count.
  const double ideal = mean_of(held_at_5_A());
  for (const int bits : {8, 10, 12, 16}) {
    const double lsb = 2 * 20.48 / (1 << bits);
    EXPECT_NEAR(mean_of(with_phases(held_at_5_A(), bits)), ideal, lsb / 2 + 1e-3 * lsb) << bits;
  }
}

TEST(Sensors, AGainErrorIsTheCurrentsOwn) {
  Scenario s = with_phases(held_at_5_A(), 16);
  const double ideal = mean_of(held_at_5_A());
  s.sensors.current_gain_error = 0.05;
  // The loop controls to 5 A a reading that is 5 % too large, so the sampled current is 5 A/1.05. The mean is
  // half a ripple above the samples. A change of the duty by 2 % changes the ripple by at most 2 %.
  EXPECT_NEAR(mean_of(s), ideal - 5.0 * (1 - 1 / 1.05), 0.05 * (ideal - 5.0) + 20.48 / (1 << 15));
}

TEST(Sensors, CalibrationTakesTheOffsetAway) {
  Scenario s = with_phases(held_at_5_A());
  const double plain = mean_of(s);
  // The motor current is (i_a - i_b)/2, so equal offsets cancel even without calibration. A shunt has only
  // one offset, which does not cancel.
  s.sensors.current_offset_A = 0.5;
  EXPECT_NEAR(mean_of(s), plain, 20.48 / (1 << 11));
}

Scenario with_shunt(Scenario s) {
  s.pwm.alignment = study::Alignment::centre;
  s.pwm.sample = study::SampleAt::middle;
  s.sensors.currents = CurrentMeasurement::dc_link;
  s.sensors.current_range_A = 40.96;
  return s;
}

study::At drifts(double at_s, std::optional<double> offset_A, std::optional<double> gain_error) {
  study::At at;
  at.time_s = at_s;
  at.sensors.current_offset_A = offset_A;
  at.sensors.current_gain_error = gain_error;
  return at;
}

/// The drive measured its zero before the drift. After the drift, its readings are equal to readings with an
/// offset that was never calibrated.
TEST(Sensors, AnAmplifierThatDriftsShiftsEverySampleByJustThat) {
  for (Scenario drifted : {with_phases(held_at_5_A()), with_shunt(held_at_5_A())}) {
    Scenario never_measured = drifted;
    never_measured.sensors.current_offset_A = 0.31;
    never_measured.sensors.current_gain_error = -0.07;
    never_measured.sensors.calibrated = false;
    const auto usual = study::run(drifted);
    drifted.at.push_back(drifts(0.0, 0.31, -0.07));
    const auto a = study::run(drifted), b = study::run(never_measured);
    ASSERT_TRUE(a && b && usual);
    EXPECT_EQ(a->digest, b->digest);
    EXPECT_NE(a->digest, usual->digest);
  }
}

TEST(Sensors, AnOffsetThatJumpsDuringTheRunMovesTheShuntsCurrentByIt) {
  Scenario s = with_shunt(held_at_5_A());
  s.sensors.adc_bits = 16;
  s.sensors.current_offset_A = 0.2;  // the drive measured this offset
  const double before = mean_of(s);
  s.at.push_back(drifts(4e-3, 0.2 + 0.5, {}));  // and still subtracts 0.2 A after the drift
  EXPECT_NEAR(mean_of(s), before - 0.5, 2 * 20.48 / (1 << 15));
  s.at.push_back(drifts(7e-3, 0.2, {}));
  EXPECT_NEAR(mean_of(s), before, 2 * 20.48 / (1 << 15));
}

TEST(Sensors, AProductDriveDoesNotKnowEither) {
  Scenario s = product_scenario(Mode::current, 3.0);
  s.duration_s = 30e-3;
  s.load.locked = true;
  s.sensors.adc_bits = 12;
  study::Measure m = measure(MetricKind::mean, Signal::current);
  m.from_s = 20e-3;
  ask(s, m);
  const double before = mean_of(s);
  s.at.push_back(drifts(12e-3, {}, 0.25));
  EXPECT_NEAR(mean_of(s) / before, 1 / 1.25, 0.01);
}

TEST(Sensors, WhatDriftsMustBeThere) {
  const auto told = [](Scenario s, const study::At& at) {
    s.at.push_back(at);
    const auto out = study::run(s);
    return out ? std::string() : to_string(out.problems()[0]);
  };
  EXPECT_THAT(told(held_at_5_A(), drifts(1e-3, 0.1, {})), HasSubstr("at[0].sensors.current_offset_A = 0.1"));
  EXPECT_THAT(told(held_at_5_A(), drifts(1e-3, {}, 0.1)), HasSubstr("sensors.currents = \"ideal\""));
  EXPECT_THAT(told(with_phases(held_at_5_A()), drifts(1e-3, -30.0, {})), HasSubstr("leaves no range within"));
}

TEST(Sensors, ShuntsOffsetShowsUntilItIsCalibrated) {
  Scenario s = with_shunt(held_at_5_A());
  const double plain = mean_of(s), lsb = 2 * 40.96 / 4096;
  s.sensors.current_offset_A = 0.5;
  EXPECT_NEAR(mean_of(s), plain, lsb);
  s.sensors.calibrated = false;
  EXPECT_NEAR(mean_of(s), plain - 0.5, lsb);
}

TEST(Sensors, OneShuntHoldsTheCurrentOfPhaseSensing) {
  // The rotor is locked, and the pulses are long enough to sample. Both kinds of measurement give the same
  // sample, within one count of the converter.
  Scenario ideal = held_at_5_A();
  ideal.pwm.alignment = study::Alignment::centre;
  ideal.pwm.sample = study::SampleAt::middle;
  EXPECT_NEAR(mean_of(with_shunt(held_at_5_A())), mean_of(ideal), 2 * 40.96 / 4096);
}

TEST(Sensors, NoiseIsTheSeedsAndTheSameOnEveryRun) {
  Scenario s = with_phases(current_square());
  s.sensors.current_noise_A = 0.05;
  const std::uint64_t first = study::run(s)->digest;
  EXPECT_EQ(study::run(s)->digest, first);
  s.sensors.seed = 1;
  EXPECT_NE(study::run(s)->digest, first);
}

TEST(Sensors, IdealOnesLeaveTheRunAsItIs) {
  Scenario s = current_square();
  const std::uint64_t plain = study::run(s)->digest;
  s.sensors.seed = 5;
  s.sensors.adc_bits = 8;
  s.sensors.current_noise_A = 1.0;  // noise of a converter that ideal measurement does not use
  EXPECT_EQ(study::run(s)->digest, plain);
}

TEST(Sensors, ErrorsOfTheBusConverterAreTheDutys) {
  // The duty is divided by the bus reading. A reading that is too high by 5 % and 1 V reduces the voltage by
  // 5 % and by 1/25.2. The integral restores the voltage, so the steady current is unchanged.
  Scenario s = with_phases(held_at_5_A(), 16);
  s.control.current.measured_bus_from_V = 10.0;
  s.sensors.bus = study::BusSensing::adc;
  s.sensors.bus_range_V = 40.96;
  study::Measure first = measure(MetricKind::maximum, Signal::current);
  first.to_s = 29e-6;  // s; the end of the first period, before any feedback
  s.compare.clear();
  ask(s, first);
  const double right = mean_of(s);
  s.sensors.bus_gain_error = 0.05;
  s.sensors.bus_offset_V = 1.0;
  // The current is the on-time times U/L. R reduces the current only slightly, because 30 us are short
  // compared with 0.56 ms. Half a count of 16 bits, 0.3 mV, is negligible.
  EXPECT_NEAR(mean_of(s) / right, 24.0 / (24.0 * 1.05 + 1.0), 0.03);
}

Scenario at_100_rad_s() {
  Scenario s = maxon_scenario(Mode::speed, 100.0);
  s.duration_s = 0.3;
  s.load.coulomb_Nm = 0.02;
  study::Measure m = measure(MetricKind::mean, Signal::speed);
  m.from_s = 0.2;
  ask(s, m);
  return s;
}

TEST(Sensors, SpeedFromHallEdgesHoldsTheSpeed) {
  // The speed loop is slow, because the exact pole placement assumes a speed without delay, but the speed
  // from edges is a sector late.
  Scenario s = at_100_rad_s();
  s.control.speed.settle_s = 0.1;
  s.control.speed.damping = 0.9;
  s.sensors.rotor = study::RotorSensing::hall;
  s.sensors.speed_edges = 1;
  // The mean of 1/T over equal sectors is exact, apart from a timer count, which is 1 in 1309 at 1 MHz. The
  // integral controls the time mean of the reading to 100 rad/s. The ripple within a sector, 0.4 %, is not
  // corrected.
  EXPECT_NEAR(mean_of(s), 100.0, 100.0 * (1.0 / 1309 + 0.004));
}

TEST(Sensors, CoarseTimerShowsInTheSpeed) {
  Scenario s = at_100_rad_s();
  s.control.speed.settle_s = 0.1;
  s.control.speed.damping = 0.9;
  s.sensors.rotor = study::RotorSensing::hall;
  const std::uint64_t fine = study::run(s)->digest;
  s.sensors.capture_Hz = 2e4;
  EXPECT_NE(study::run(s)->digest, fine);
}

TEST(Sensors, PositionFromHallEdgesComesToItsTarget) {
  // The target is the middle of a sector, which is 7.5 degrees wide. If a rotor is at rest anywhere in the
  // sector, its reading is this middle.
  Scenario s = maxon_scenario(Mode::position, 363.75);
  s.duration_s = 0.6;
  s.control.speed.settle_s = 0.05;
  s.control.speed.damping = 0.9;
  s.control.position.gain_rad_s_per_deg = 0.2;
  s.sensors.rotor = study::RotorSensing::hall;
  ask(s, measure(MetricKind::final_value, Signal::position));
  const auto out = study::run(s);
  ASSERT_TRUE(out);
  // Without friction, the rotor drifts until it passes an edge, and then turns back. The error is therefore
  // up to half a sector plus one sector.
  EXPECT_NEAR(out->comparisons[0].measured, 363.75, 1.5 * 7.5);
}

TEST(Sensors, FixedPointReadsTheSameCounts) {
  // One count of 12 bits over +-20.48 A is 10 mA. With the bases of the scenario, a digit of Q15 is 0.46 mA.
  Scenario s = with_phases(held_at_5_A());
  const double wide = mean_of(s);
  for (const Arithmetic a : {Arithmetic::q15, Arithmetic::q31, Arithmetic::float32}) {
    s.control.arithmetic = a;
    EXPECT_NEAR(mean_of(s), wide, 10e-3);
  }
}

TEST(Sensors, ABrokenLineStopsTheBridgeAndIsNamed) {
  for (int line = 1; line <= 3; ++line)
    for (const study::Level01 level : {study::Level01::low, study::Level01::high}) {
      Scenario s = at_100_rad_s();
      s.sensors.hall_break = {.at_s = 0.1, .line = line, .level = level};
      const auto out = study::run(s);
      ASSERT_TRUE(out);
      ASSERT_TRUE(out->fault) << line;
      EXPECT_THAT(out->fault->limit, HasSubstr("line H" + std::to_string(line)));
      // A line that breaks just after one of its edges reverses this edge. Its next edge, three sectors
      // later, is missing. One sector later, an edge of another line makes the code impossible. This happens
      // within five sectors, each 1.31 ms at 100 rad/s. The wrong pair slows the rotor, so the time may be 5
      // % longer.
      EXPECT_LE(out->simulated_s, 0.1 + 5 * 1.31e-3 * 1.05);
    }
}

/// Time between the first event and the last event at which the pins have an impossible code.
double impossible_for(const Scenario& s) {
  std::size_t column = 0;
  while (study::all_columns()[column].name != "hall") ++column;
  double first = -1, last = -1;
  const auto out = study::run(s, {.on_event = [&](study::Row row) {
                                if (row[column] != 0 && row[column] != 7) return;
                                if (first < 0) first = row[0];
                                last = row[0];
                              }});
  EXPECT_TRUE(out && out->fault);
  return last - first;
}

TEST(Sensors, AnImpossibleCodeStopsTheBridgeWithinAPeriod) {
  Scenario s = at_100_rad_s();
  s.sensors.hall_break = {.at_s = 0.1, .line = 2, .level = study::Level01::high};
  EXPECT_EQ(impossible_for(s), 0.0) << "in the Hall interrupt";
  s.pwm.commutation = study::CommutationAt::sample;
  const double stood = impossible_for(s);
  EXPECT_GT(stood, 0.0);
  EXPECT_LE(stood, s.pwm.period_s) << "at the next sample";
}

}  // namespace SIXSTEP_TEST_FILE
