// SPDX-License-Identifier: Apache-2.0
// Encoders and resolvers that fail during a run, and sensors on the load's side of a shaft. The drive's
// reaction is compared with physical laws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/timeline.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;
using ::testing::HasSubstr;

constexpr double K_t = 33.5e-3;

At event(double at_s) {
  At at;
  at.time_s = at_s;
  return at;
}

Scenario positioned(double to_deg) {
  Scenario s = cascade(0.6);
  s.pwm.commutation = CommutationAt::sample;
  s.control.mode = Mode::position;
  s.control.position.gain_rad_s_per_deg = 1;
  s.initial.angle_rad = 0.01;
  s.reference.value = to_deg;
  s.load.coulomb_Nm = 0.002;
  s.sensors.rotor = RotorSensing::encoder;
  s.sensors.capture_Hz = 48e6;
  return s;
}

// Until the index corrects the count, the shaft's position is too large by the missed counts.
TEST(EncoderFault, MissedEdgesShiftThePositionUntilTheIndexPasses) {
  Scenario s = positioned(180);
  s.at.push_back(event(0));
  s.at.back().sensors.missed_edges = 40;
  s.at.push_back(event(0.25));
  s.at.back().reference = Reference{};
  s.at.back().reference->value = 450;
  ask(s, over(MetricKind::mean, Signal::position, 0.22, 0.25));
  ask(s, measure(MetricKind::final_value, Signal::position));
  const Outcome out = outcome_of(s);
  constexpr double count_deg = 360.0 / 4096;
  EXPECT_NEAR(out.comparisons[0].measured, 180 + 40 * count_deg, 2 * count_deg);
  EXPECT_NEAR(out.comparisons[1].measured, 450, 2 * count_deg);
}

// The missed edges follow a Poisson process. Their number is within three standard deviations of the mean.
// The same seed gives the same edges.
TEST(EncoderFault, EdgesAreMissedAtTheRateAskedFor) {
  Scenario s = positioned(90);
  s.sensors.encoder.missed_Hz = 2000;
  const auto missed = [&](int seed) {
    s.sensors.seed = seed;
    std::vector<std::int64_t> at;
    for (const rig::Action& action : timeline_of(s))
      if (action.kind == rig::ActionKind::encoder_misses) at.push_back(action.at.ticks);
    return at;
  };
  const double mean = 2000 * s.duration_s;
  EXPECT_NEAR(static_cast<double>(missed(7).size()), mean, 3 * std::sqrt(mean));
  EXPECT_EQ(missed(7), missed(7));
  EXPECT_NE(missed(7), missed(8));
  s.sensors.rotor = RotorSensing::absolute;
  EXPECT_TRUE(missed(7).empty());
}

/// The drive holds 2 A with the rotor locked at an electrical angle. Each test adds its sensor fault to the event at 5 ms.
Scenario held_at(double electrical_deg) {
  Scenario s = maxon_scenario(Mode::current, 2.0);
  s.duration_s = 10e-3;
  s.control.current = {.type = CurrentLoopType::hysteresis, .band_A = 0.01};
  s.pwm.chopping = control::Chopping::hard;
  s.pwm.commutation = CommutationAt::sample;
  s.load.locked = true;
  s.initial.angle_rad = electrical_deg / 8 * base::pi / 180;
  s.at.push_back(event(5e-3));
  ask(s, over(MetricKind::mean, Signal::torque, 1e-3, 5e-3));
  ask(s, over(MetricKind::mean, Signal::torque, 6e-3));
  return s;
}

// With 8 pole pairs, track 11 of 14 (bit 10) mirrors each electrical turn. An angle of 270 degrees reads as
// 90 degrees, three sectors away, so the torque reverses.
TEST(AbsoluteFault, ABadTrackOfTheElectricalTurnBrakesWithFullTorque) {
  Scenario s = held_at(270);
  s.sensors.rotor = RotorSensing::absolute;
  s.sensors.absolute.bits = 14;
  s.at[0].sensors.bad_track = AtTrack{.track = 11, .level = EncoderLevel::low};
  const Outcome out = outcome_of(s);
  EXPECT_NEAR(out.comparisons[0].measured, 2 * K_t, 0.01 * K_t);
  EXPECT_NEAR(out.comparisons[1].measured, -2 * K_t, 0.01 * K_t);
}

// Without its cosine winding, a resolver reads 90 degrees at all angles from 0 to 180 degrees. At 150
// degrees, the drive's sector is therefore one sector off. The back-EMF of one driven phase is zero, so the
// torque is half.
TEST(ResolverFault, ABrokenWindingLeavesHalfTheTorque) {
  for (const auto reading : {rig::ResolverReading::sampled, rig::ResolverReading::tracking}) {
    Scenario s = held_at(150);
    s.sensors.rotor = RotorSensing::resolver;
    s.sensors.resolver.pole_pairs = 8;
    s.sensors.resolver.excitation_Hz = 0.5 / s.pwm.period_s;
    s.sensors.resolver.reading = reading;
    s.at[0].sensors.broken_winding = Winding::cosine;
    s.sensors.watched = false;
    const Outcome out = outcome_of(s);
    EXPECT_NEAR(out.comparisons[0].measured, 2 * K_t, 0.01 * K_t);
    EXPECT_NEAR(out.comparisons[1].measured, K_t, 0.01 * K_t);
  }
}

Scenario tracked(Scenario s, int bits) {
  s.sensors.rotor = RotorSensing::resolver;
  s.pwm.commutation = CommutationAt::sample;
  s.sensors.resolver.reading = rig::ResolverReading::tracking;
  s.sensors.resolver.bits = bits;
  s.sensors.resolver.latency_s = 2e-6;
  return s;
}

// In this motor, a count of 10 bits is 2.8 electrical degrees. The rotor rests within one count of the
// target, plus one count to which the loop may not react.
TEST(ConverterChip, HoldsAPositionToItsResolution) {
  for (const int bits : {10, 12, 16}) {
    Scenario s = tracked(cascade(0.8), bits);
    s.control.mode = Mode::position;
    s.control.speed.settle_s = 20e-3;
    s.control.position.gain_rad_s_per_deg = 0.5;
    s.reference.value = 400;
    s.load.coulomb_Nm = 0.002;
    ask(s, measure(MetricKind::final_value, Signal::position));
    EXPECT_NEAR(outcome_of(s).comparisons[0].measured, 400, 2 * 360 / std::ldexp(1.0, bits) + 0.02) << bits;
  }
}

/// A load behind a gear and a coupling. The drive controls the position.
Scenario on_the_load(SensorShaft shaft, double torque_Nm) {
  Scenario s = positioned(90);
  s.sensors.rotor = RotorSensing::absolute;
  s.sensors.absolute.bits = 20;
  s.sensors.shaft = shaft;
  s.control.speed.settle_s = 50e-3;
  s.control.position.gain_rad_s_per_deg = 0.3;
  s.duration_s = 1.2;
  s.load.coulomb_Nm = 0;
  s.load.gear = 2;
  s.load.inertia_kg_m2 = 2e-5;
  s.load.stiffness_Nm_rad = 40;
  s.load.damping_Nm_s_rad = 0.02;
  s.load.torque_Nm = torque_Nm;
  ask(s, over(MetricKind::mean, Signal::position, 1.0));
  return s;
}

// At rest, the coupling is twisted by T/k (torque T, stiffness k). An encoder on the motor positions the
// motor. An encoder on the load positions the load, and the motor is ahead by the twist times the gear. A
// speed below one count in eight samples reads as zero or as one count, so the shaft oscillates by the
// reaction of the position loop to this reading.
TEST(LoadSideSensor, HoldsTheLoadWhateverTwistsTheCoupling) {
  const double told_rad_s = 2 * base::pi / 0x1p20 / (8 * 30e-6),
               hunts_deg = 2 * 360 / 0x1p16 + told_rad_s / 0.3;
  for (const double torque : {0.1, -0.1}) {
    const double ahead_deg = 2 * torque / 40 * 180 / base::pi;
    ASSERT_GT(std::fabs(ahead_deg), 3 * hunts_deg) << "the twist is what is looked at";
    EXPECT_NEAR(outcome_of(on_the_load(SensorShaft::motor, torque)).comparisons[0].measured, 90, hunts_deg);
    EXPECT_NEAR(outcome_of(on_the_load(SensorShaft::load, torque)).comparisons[0].measured, 90 + ahead_deg,
                hunts_deg);
  }
}

TEST(ShaftSensorFaults, WhatCannotBeIsRefused) {
  const auto refused = [](auto&& change) -> std::string {
    Scenario s = positioned(90);
    s.at.push_back(event(0.1));
    s.at.back().load.torque_Nm = 0.0;
    change(s);
    const base::Problems problems = check(s);
    return problems.empty() ? "nothing" : to_string(problems[0]);
  };
  EXPECT_EQ(refused([](Scenario&) {}), "nothing");
  EXPECT_EQ(refused([](Scenario& s) { s.at[0].sensors.missed_edges = 3; }), "nothing");
  EXPECT_THAT(refused([](Scenario& s) { s.at[0].sensors.bad_track = AtTrack{}; }),
              HasSubstr("applies to an absolute encoder"));
  EXPECT_THAT(refused([](Scenario& s) { s.at[0].sensors.broken_winding = Winding::sine; }),
              HasSubstr("applies to a resolver"));
  EXPECT_THAT(refused([](Scenario& s) {
                s.sensors.rotor = RotorSensing::absolute;
                s.at[0].sensors.bad_track = AtTrack{.track = 15};
              }),
              HasSubstr("name a track from 1 to sensors.absolute.bits"));
  EXPECT_THAT(refused([](Scenario& s) { s.sensors.encoder.missed_Hz = 1e7; }), HasSubstr("100000"));
  EXPECT_THAT(refused([](Scenario& s) { s = tracked(s, 9); }), HasSubstr("converter chip"));
  EXPECT_THAT(refused([](Scenario& s) {
                s = tracked(s, 12);
                s.sensors.resolver.bandwidth_Hz = 3e5;
              }),
              HasSubstr("the chip's clock"));
  EXPECT_THAT(refused([](Scenario& s) {
                s.sensors.rotor = RotorSensing::hall;
                s.sensors.shaft = SensorShaft::load;
              }),
              HasSubstr("to an encoder or a resolver"));
  EXPECT_EQ(refused([](Scenario& s) {
              s.sensors.shaft = SensorShaft::load;
              s.pwm.commutation = CommutationAt::hall_edge;
            }),
            "nothing")
      << "the Hall probes commutate";
}

}  // namespace SIXSTEP_TEST_FILE
