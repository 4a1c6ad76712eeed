// SPDX-License-Identifier: Apache-2.0
// Tests the behaviour of the drive at its limits, in the full switching simulation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::MetricKind;
using study::Scenario;
using study::Signal;

/// A flywheel that reaches 100 rad/s after some 60 ms at full torque.
Scenario flywheel() {
  Scenario s = maxon_scenario(Mode::speed, 100.0);
  s.duration_s = 0.15;
  s.control.speed.torque_limit_Nm = 0.5;  // 14.9 A: the bus can drive it up to 100 rad/s
  s.load.inertia_kg_m2 = 3e-4;
  return s;
}

/// Overshoot of the speed loop with an ideal current loop. The plant is dw = T_s T/J (sample period T_s,
/// torque T, inertia J), as in the design of the loop. With `winds_up`, the output is limited while the
/// integral continues; without it, the loop has no limit.
double overshoot_of_the_design(const Scenario& s, bool winds_up) {
  const auto compiled = study::compile(s);
  const control::PiConfig<double>& pi = compiled->drive.speed;
  const double per_tick = s.pwm.period_s * *s.control.speed.torque_limit_Nm / compiled->shaft.J_kg_m2;
  const double height = s.reference.value;
  double w = 0, u = 0, e = 0, most = 0;
  for (int n = 0; n < 20000; ++n) {
    const double error = height - w;
    u += pi.d1 * error + pi.d0 * e;
    e = error;
    w += per_tick * (winds_up ? std::clamp(u, -1.0, 1.0) : u);
    most = std::max(most, w - height);
  }
  return most;
}

TEST(Behaviour, FiftyMillisecondsAtTheLimitWindNothingUp) {
  Scenario s = flywheel();
  study::Measure over = measure(MetricKind::overshoot, Signal::speed);
  over.level = 100.0;
  over.start = 0.0;
  ask(s, over);
  study::Measure reach = measure(MetricKind::reach_time, Signal::speed);
  reach.level = 100.0;
  reach.start = 0.0;
  ask(s, reach);
  const auto out = study::run(s);
  ASSERT_TRUE(out);
  const double designed = overshoot_of_the_design(s, false), wound_up = overshoot_of_the_design(s, true);
  std::printf("overshoot %.3g rad/s, designed %.3g, wound up %.3g, reach %.3g s\n",
              out->comparisons[0].measured, designed, wound_up, out->comparisons[1].measured);
  EXPECT_GT(out->comparisons[1].measured, 50e-3) << "it was at the limit for so long";
  EXPECT_LE(out->comparisons[0].measured, designed);
  EXPECT_GT(wound_up, 2 * designed) << "or the test would show nothing";
}

TEST(Behaviour, ReversalAtSpeedKeepsTheCurrentLimit) {
  Scenario s = maxon_scenario(Mode::speed, 0.0);
  s.duration_s = 0.2;
  s.control.current.limit_A = 10.0;
  s.reference = {.shape = study::Shape::steps, .times_s = {0.0, 0.1}, .values = {200.0, -200.0}};
  for (const MetricKind metric : {MetricKind::maximum, MetricKind::minimum})
    ask(s, measure(metric, Signal::current));
  study::Measure final = measure(MetricKind::mean, Signal::speed);
  final.from_s = 0.18;
  ask(s, final);
  const auto out = study::run(s);
  ASSERT_TRUE(out);
  EXPECT_FALSE(out->fault);
  // The bound is the sum of three terms:
  // - the limit of 10 A;
  // - the overshoot of the PI at the largest step, 20 A; the design has 0.375 A at 5 A (thesis 7.3.1);
  // - the ripple that the bus voltage and the back-EMF cause until the next sample.
  const double e_V = 0.0335 * 200.0, ripple = (24.0 + e_V) / 0.572e-3 * s.pwm.period_s;
  const double most = 10.0 + 20.0 * 0.375 / 5.0 + ripple;
  std::printf("current %.4g .. %.4g A, bound %.4g\n", out->comparisons[1].measured,
              out->comparisons[0].measured, most);
  EXPECT_LE(out->comparisons[0].measured, most);
  EXPECT_GE(out->comparisons[1].measured, -most);
  EXPECT_NEAR(out->comparisons[2].measured, -200.0, 0.2) << "0.1 %, as in 7.4";
}

/// The drive brakes a flywheel from 600 rad/s. The source cannot sink current. At 5 A, most of the power from
/// the back-EMF of 20 V returns to the bus. At 20 A, the windings would dissipate all of it.
Scenario braking() {
  Scenario s = maxon_scenario(Mode::speed, 0.0);
  s.duration_s = 0.1;
  s.initial.speed_rad_s = 600.0;
  s.load.inertia_kg_m2 = 1e-4;
  s.control.current.limit_A = 5.0;
  s.pwm.chopping = control::Chopping::complementary;
  s.supply = {.voltage_V = 24.0, .resistance_ohm = 0.1, .capacitance_F = 10e-3, .sinks = false};
  ask(s, measure(MetricKind::maximum, Signal::bus_voltage));
  return s;
}

TEST(Behaviour, RegenerationLimitKeepsTheBusWithinItsBound) {
  Scenario s = braking();
  const auto free = study::run(s);
  ASSERT_TRUE(free);
  std::printf("bus without the limit %.4g V\n", free->comparisons[0].measured);
  EXPECT_GT(free->comparisons[0].measured, 30.0) << "or there were nothing to limit";
  s.control.regeneration.limit_V = 30.0;
  for (const study::Arithmetic a : {study::Arithmetic::float64, study::Arithmetic::q15}) {
    s.control.arithmetic = a;
    const auto limited = study::run(s);
    ASSERT_TRUE(limited) << to_string(limited.problems()[0]);
    std::printf("with it %.6g V\n", limited->comparisons[0].measured);
    // The bound adds two terms to 30 V. At the switch-off, the current is 5/4 of 5 A, and the back-EMF is 20
    // V. The energy of the inductance L returns to the bus: L I^2/(2 C 10 V). The current of one period adds
    // I T/C.
    EXPECT_LT(limited->comparisons[0].measured,
              30.0 + 0.572e-3 * 6.25 * 6.25 / (2 * 10e-3 * 10.0) + 6.25 * 30e-6 / 10e-3);
    EXPECT_GT(limited->comparisons[0].measured, 24.0);
  }
}

TEST(Behaviour, OneShuntTurnsTheRotorAsPhaseCurrentsDo) {
  // The drive applies 5 A while the rotor accelerates. The run therefore includes commutations, and duties
  // from zero upwards.
  Scenario s = maxon_scenario(Mode::current, 5.0);
  s.pwm.alignment = study::Alignment::centre;
  s.pwm.sample = study::SampleAt::middle;
  s.load.inertia_kg_m2 = 1e-4;
  study::Measure mean = measure(MetricKind::mean, Signal::current);
  mean.from_s = 2e-3;
  ask(s, mean);
  const auto ideal = study::run(s);
  s.sensors.currents = rig::CurrentMeasurement::dc_link;
  s.sensors.current_range_A = 20.48;
  const auto shunt = study::run(s);
  ASSERT_TRUE(ideal && shunt);
  std::printf("mean current %.5g A ideal, %.5g A by one shunt\n", ideal->comparisons[0].measured,
              shunt->comparisons[0].measured);
  // One count of 12 bits over +-20.48 A is 10 mA. The measured difference is 1.2 mA.
  EXPECT_NEAR(shunt->comparisons[0].measured, ideal->comparisons[0].measured, 10e-3);
}

}  // namespace SIXSTEP_TEST_FILE
