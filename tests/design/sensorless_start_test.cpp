// SPDX-License-Identifier: Apache-2.0
// The design values of a sensorless drive are compared with the closed forms of sensorless_start.hpp, which
// are computed by hand.
#include "sixstep/design/loops/sensorless_start.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "tests/design/sensorless_maxon.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using sixstep::testing::maxon;
using sixstep::testing::spec;

TEST(SensorlessStart, FollowsItsClosedForms) {
  const auto start = design::sensorless_start(maxon(), spec, 5.825);
  ASSERT_TRUE(start);
  const control::SensorlessConfig<double>& c = start->rotor;
  EXPECT_DOUBLE_EQ(start->start_current_A, 1.5 * 2.33);
  EXPECT_EQ(c.crossing.threshold, 3) << "two steps of the converter, rounded up";
  EXPECT_EQ(c.crossing.rail_counts, std::round(0.03 * 24 / (30.0 / 4096)));
  EXPECT_DOUBLE_EQ(start->lowest_rad_s, 0.05 * 24 / 0.0335);
  EXPECT_NEAR(start->highest_rad_s, base::pi / 3 / 8 / (4 * 30e-6), 1e-9);
  const double swing_s = 2 * base::pi * std::sqrt(1.35e-5 / (8 * 0.0335 * 3.495));
  EXPECT_NEAR(c.start.align_ticks, 6 * swing_s * 16e6, 1);
  const double a = (0.0335 * 3.495 - 0.5 * 0.0335 * 2.33) / (2 * 1.35e-5);
  EXPECT_NEAR(c.start.acceleration, a * 8 / (base::pi / 3) * 9e-10 * 4294967296.0, 1);
  // The current at the end of the ramp, for acceleration and viscous drag. It is relative to 5.825 A, the
  // full output of the speed loop.
  EXPECT_DOUBLE_EQ(start->start_output, (1.35e-5 * a + 7.3e-6 * start->lowest_rad_s) / 0.0335 / 5.825);
  EXPECT_NEAR(c.start.trusted_ticks, base::pi / 3 / 8 / start->lowest_rad_s * 16e6, 1);
  EXPECT_NEAR(start->duty_per_period, 2.33 * 0.0335 * 0.0335 / (1.35e-5 * 24) * 30e-6, 1e-12);
  EXPECT_DOUBLE_EQ(start->least_duty, 2 * 0.25e-6 / 30e-6);
  EXPECT_GT(c.speed.timeout_ticks, c.lock.longest_ticks) << "a time-out would end the history";
}

/// The sample is in the middle of the pulse. If the pulse begins late, its part before the sample is shorter.
TEST(SensorlessStart, APulseThatBeginsLateNeedsMoreDuty) {
  design::SensorlessSpec late = spec;
  late.pulse_late_s = 1e-6;
  const auto start = design::sensorless_start(maxon(), late, 5.825);
  ASSERT_TRUE(start);
  EXPECT_DOUBLE_EQ(start->least_duty, 2 * (1e-6 + 0.25e-6) / 30e-6);
}

TEST(SensorlessStart, AFilterSetsLeadBlankingAndLeastDuty) {
  design::SensorlessSpec filtered = spec;
  filtered.lowest_part = 0.2;
  filtered.terminal_bandwidth_Hz = 250e3;
  const double tau = 1 / (2 * base::pi * 250e3);
  const auto start = design::sensorless_start(maxon(), filtered, 5.825);
  ASSERT_TRUE(start);
  EXPECT_EQ(start->rotor.clock.lead_ticks, std::round(tau * 16e6));
  EXPECT_EQ(start->rotor.crossing.settle_ticks, std::ceil(3.5 * tau * 16e6));
  EXPECT_EQ(start->rotor.crossing.margin_ticks, start->rotor.crossing.settle_ticks);
  EXPECT_DOUBLE_EQ(start->least_duty, 7 * tau / 30e-6);
  EXPECT_NEAR(start->highest_rad_s, base::pi / 3 / 8 / (5 * 30e-6), 1e-9);
  EXPECT_EQ(start->rotor.lock.most_flux, 0xffffffffu) << "in soft chopping sizes tell nothing";
  filtered.blanking_s = 4 * tau;
  const auto longer = design::sensorless_start(maxon(), filtered, 5.825);
  ASSERT_TRUE(longer);
  EXPECT_EQ(longer->rotor.crossing.margin_ticks, std::ceil(4 * tau * 16e6)) << "the longer of both";
}

/// At the lowest speed, the on-time is a fifth of the period with soft chopping, and three fifths with hard
/// chopping.
TEST(SensorlessStart, RefusesAFilterThatTheLeastOnTimeIsTooShortFor) {
  for (const auto& [chopping, part] :
       {std::pair{control::Chopping::soft, 0.2}, {control::Chopping::hard, 0.6}}) {
    design::SensorlessSpec filtered = spec;
    filtered.lowest_part = 0.2;
    filtered.chopping = chopping;
    const double least_Hz = 7 / (2 * base::pi * part * 30e-6);
    filtered.terminal_bandwidth_Hz = 1.0001 * least_Hz;
    EXPECT_TRUE(design::sensorless_start(maxon(), filtered, 5.825)) << part;
    filtered.terminal_bandwidth_Hz = 0.9999 * least_Hz;
    const auto refused = design::sensorless_start(maxon(), filtered, 5.825);
    ASSERT_FALSE(refused) << part;
    EXPECT_EQ(refused.problems().front().where, "terminal_bandwidth_Hz");
    EXPECT_NE(refused.problems().front().cure.find("lowest_part"), std::string::npos);
  }
}

TEST(SensorlessStart, NoiseRaisesTheLowestSpeedUntilItIsRefused) {
  design::SensorlessSpec noisy = spec;
  noisy.adc_noise_V = 0.05;
  const auto start = design::sensorless_start(maxon(), noisy, 0);
  ASSERT_TRUE(start);
  EXPECT_NEAR(start->lowest_rad_s, 4 * (5 * std::sqrt(6.0) * 0.05 + 2 * 30.0 / 4096) / (2 * 0.01675), 1e-9);
  EXPECT_EQ(start->start_output, 0.0) << "no speed loop";
  noisy.adc_noise_V = 0.5;
  const auto refused = design::sensorless_start(maxon(), noisy, 0);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems().front().where, "adc_noise_V");
}

TEST(SensorlessStart, TellsEveryMistakeByItsKey) {
  const auto where = [](const design::SensorlessSpec& s, const design::MotorModel& m) {
    const auto start = design::sensorless_start(m, s, 0);
    return start ? std::string() : start.problems().front().where;
  };
  design::SensorlessSpec s = spec;
  s.bus_V = 0;
  EXPECT_EQ(where(s, maxon()), "bus_V");
  s = spec;
  s.period_s = 0;
  EXPECT_EQ(where(s, maxon()), "period_s");
  s = spec;
  s.capture_Hz = -1;
  EXPECT_EQ(where(s, maxon()), "capture_Hz");
  s = spec;
  s.adc_bits = 4;
  EXPECT_EQ(where(s, maxon()), "adc_bits");
  s = spec;
  s.greatest_load = 1.6;
  EXPECT_EQ(where(s, maxon()), "greatest_load");
  design::MotorModel light = maxon();
  light.shaft.J_kg_m2 = 0;
  EXPECT_EQ(where(spec, light), "motor");
  EXPECT_EQ(where(spec, maxon()), "");
}

/// The hand-over uses the reserve of the start current as the ramp does: half of the torque that the load
/// leaves accelerates the rotor. The torque of dry friction is added.
TEST(SensorlessStart, HandsOverTheRampsTorqueAndItsDrag) {
  design::MotorModel rubbing = maxon();
  rubbing.shaft.coulomb_Nm = 0.01;
  rubbing.shaft.static_Nm = 0.012;  // only at rest: it is part of the greatest load, but not of the current
                                    // at the ramp's end
  const auto start = design::sensorless_start(rubbing, spec, 5.825);
  ASSERT_TRUE(start);
  const double a = (0.0335 * 3.495 - 0.5 * 0.0335 * 2.33 - 0.012) / (2 * 1.35e-5);
  const double A = (1.35e-5 * a + 0.01 + 7.3e-6 * start->lowest_rad_s) / 0.0335;
  EXPECT_DOUBLE_EQ(start->start_output, A / 5.825);
  EXPECT_LT(A, start->start_current_A);
  // The drag alone needs more than the start current. The output is limited to the start current and to full
  // output.
  rubbing.shaft.coulomb_Nm = rubbing.shaft.static_Nm = 0.0;
  rubbing.shaft.B_Nm_s = 0.01;
  EXPECT_DOUBLE_EQ(design::sensorless_start(rubbing, spec, 5.825)->start_output, 3.495 / 5.825);
  EXPECT_EQ(design::sensorless_start(rubbing, spec, 1.0)->start_output, 1.0);
}

/// With the virtual star point as reference, 5 tau may last half a sector at no load, 183 us. With half the
/// bus voltage as reference, 7 tau may last the least on-time, 1.5 us (tau: time constant of the filter). The
/// offset and half the hysteresis raise the lock's threshold and the lowest speed.
TEST(SensorlessStart, ComparatorsSetLeadLockAndLowestSpeed) {
  const double sector_s = base::pi / 3 / 8 * 0.0335 / 24;
  const auto with = [](const design::ComparatorSpec& comparators) {
    design::SensorlessSpec s = spec;
    s.comparators = comparators;
    return design::sensorless_start(maxon(), s, 5.825);
  };
  const auto Hz = [](double tau) { return 1 / (2 * base::pi * tau); };
  const auto plain = design::sensorless_start(maxon(), spec, 5.825);
  for (const bool half_bus : {false, true}) {
    const double most_s = half_bus ? 0.05 * 30e-6 / 7 : sector_s / 10;
    for (const double bandwidth_Hz : {0.0, 0.999 * Hz(most_s)}) {
      const auto refused = with({true, bandwidth_Hz, half_bus});
      ASSERT_FALSE(refused);
      EXPECT_EQ(refused.problems()[0].where, "comparators.bandwidth_Hz");
    }
    const auto taken = with({true, 1.001 * Hz(most_s), half_bus, 0.02, 0.01});
    ASSERT_TRUE(taken);
    const control::SensorlessConfig<double>& c = taken->rotor;
    EXPECT_TRUE(c.captured.follows);
    EXPECT_NEAR(c.clock.lead_ticks, most_s * 16e6, 0.01 * most_s * 16e6 + 0.5);
    EXPECT_EQ(c.captured.lag_ticks, c.clock.lead_ticks);
    EXPECT_EQ(c.captured.period_ticks, half_bus ? 480u : 0u);
    EXPECT_EQ(c.crossing.threshold, plain->rotor.crossing.threshold) << "samples are what they were";
    const double y_V = 2 * 30.0 / 4096 + (half_bus ? 2 : 3) * (0.02 + 0.005);
    EXPECT_EQ(c.lock.threshold, std::floor(y_V / (30.0 / 4096)) + 1);
    EXPECT_NEAR(taken->highest_rad_s, base::pi / 3 / 8 / (3 * 30e-6), 1e-9);
    EXPECT_DOUBLE_EQ(taken->least_duty,
                     half_bus ? 2 * 3.5 / (2 * base::pi * 1.001 * Hz(most_s)) / 30e-6 : plain->least_duty);
    const auto coarse = with({true, 1e6, half_bus, 0.4, 0.0});
    ASSERT_TRUE(coarse);
    EXPECT_NEAR(coarse->lowest_rad_s, 4 * (2 * 30.0 / 4096 + (half_bus ? 2 : 3) * 0.4) / (2 * 0.01675), 1e-9);
    const auto hidden = with({true, 1e6, half_bus, 2.0, 0.0});
    ASSERT_FALSE(hidden);
    EXPECT_EQ(hidden.problems()[0].where, "comparators");
  }
}

TEST(SensorlessStart, HardAndComplementaryChoppingMoveTheirDutyHalfAsFast) {
  for (const control::Chopping chopping : {control::Chopping::hard, control::Chopping::complementary}) {
    design::SensorlessSpec other = spec;
    other.chopping = chopping;
    EXPECT_DOUBLE_EQ(design::sensorless_start(maxon(), other, 0)->duty_per_period,
                     design::sensorless_start(maxon(), spec, 0)->duty_per_period / 2);
  }
}

}  // namespace SIXSTEP_TEST_FILE
