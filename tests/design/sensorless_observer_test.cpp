// SPDX-License-Identifier: Apache-2.0
// The back-EMF observers' values are compared with the closed forms of sensorless_observer.hpp.
#include "sixstep/design/loops/sensorless_observer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/scaling/observer_scaling.hpp"
#include "tests/design/sensorless_maxon.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using control::Follow;
using sixstep::testing::maxon;
using sixstep::testing::spec;

/// The lag is a fifth of the shortest sector.
const double lag_s = base::pi / 3 / 8 / (24 / 0.0335) / 5;

TEST(SensorlessObserver, PlacesBothPolesOfLuenbergersWhereTheLagAsks) {
  const auto o = design::sensorless_observer(maxon(), spec, Follow::luenberger);
  ASSERT_TRUE(o);
  EXPECT_NEAR(o->lag_s, lag_s, 1e-15);
  const double p = o->pole;
  EXPECT_NEAR((2 * p / (1 - p) + 0.5) * 30e-6, lag_s, 1e-15) << "the lag of a double pole";
  const auto& c = o->chip.luenberger;
  EXPECT_NEAR(c.decay, std::exp(-0.515 * 30e-6 / 0.286e-3), 1e-15);
  EXPECT_NEAR(c.drive, (1 - c.decay) / 0.515, 1e-15);
  // The matrix of the observer's error: error of the current and of the back-EMF after a period.
  const double m[2][2] = {{(1 - c.current) * c.decay, -(1 - c.current) * c.drive},
                          {c.emf * c.decay, 1 - c.emf * c.drive}};
  EXPECT_NEAR(m[0][0] + m[1][1], 2 * p, 1e-14) << "trace";
  EXPECT_NEAR(m[0][0] * m[1][1] - m[0][1] * m[1][0], p * p, 1e-14) << "determinant";
  EXPECT_EQ(o->chip.lag_ticks, std::floor(lag_s * 16e6 + 0.5));
}

TEST(SensorlessObserver, SlidingModeHasTheBusAsItsGainAndTheNarrowestLayer) {
  const auto o = design::sensorless_observer(maxon(), spec, Follow::sliding_mode);
  ASSERT_TRUE(o);
  const auto& c = o->chip.sliding_mode;
  EXPECT_EQ(c.limit_V, 24.0);
  EXPECT_NEAR(c.slope * c.drive, c.decay, 1e-15) << "a - b k/phi = 0: at rest after one period";
  EXPECT_NEAR(((1 - c.share) / c.share + 0.5) * 30e-6, lag_s, 1e-15);
  EXPECT_NEAR(c.raise * c.decay, 1.0, 1e-15);
}

TEST(SensorlessObserver, TheFluxLevelIsThatOfTheShape) {
  plant::Machine m = maxon().machine;
  EXPECT_NEAR(design::flux_level_V_s(m), 0.01675 / 8 * base::pi / 18, 1e-12) << "of 2/3 theta/30 degrees";
  m.back_emf = plant::BackEmf::sine;
  EXPECT_NEAR(design::flux_level_V_s(m), 0.01675 / 8 * (1 - std::cos(base::pi / 6)), 1e-12);
  const auto o = design::sensorless_observer(maxon(), spec, Follow::flux);
  ASSERT_TRUE(o);
  EXPECT_NEAR(o->chip.flux.per_V * o->level_V_s / 30e-6, o->chip.flux.level, 1e-15) << "psi_c is the level";
  design::SensorlessSpec early = spec;
  early.advance_deg = 10;
  EXPECT_NEAR(design::sensorless_observer(maxon(), early, Follow::flux)->chip.flux.level / o->chip.flux.level,
              4.0 / 9.0, 1e-15)
      << "the fall grows with the square of the angle";
  EXPECT_EQ(o->chip.lag_ticks, 240u) << "half a period";
}

TEST(SensorlessObserver, TellsEveryMistakeByItsKey) {
  const auto where = [](const design::SensorlessSpec& s, const design::MotorModel& m) {
    const auto o = design::sensorless_observer(m, s, Follow::luenberger);
    return o ? std::string() : o.problems().front().where;
  };
  design::SensorlessSpec s = spec;
  s.seen = control::NeutralSeen::freewheel;
  EXPECT_EQ(where(s, maxon()), "seen");
  s = spec;
  s.adc_bits = 16;
  EXPECT_EQ(where(s, maxon()), "adc_bits");
  design::MotorModel ironless = maxon();
  ironless.machine.L_H = 0;
  EXPECT_EQ(where(spec, ironless), "motor.L_H");
  EXPECT_EQ(where(spec, maxon()), "");
  s.adc_bits = 16;
  EXPECT_TRUE(design::sensorless_observer(maxon(), s, Follow::crossings)) << "nothing to observe";
}

TEST(SensorlessObserver, FixedPointKeepsEveryRatio) {
  const auto o = design::sensorless_observer(maxon(), spec, Follow::sliding_mode);
  ASSERT_TRUE(o);
  const design::Bases bases{.current_A = 20, .voltage_V = 30};
  const auto c = design::observer_in<control::Q15>(o->chip, bases);
  const auto expect = [](double got, double wanted) {
    EXPECT_NEAR(got, wanted, std::fabs(wanted) * 0x1p-14);
  };
  expect(static_cast<double>(c.sliding_mode.drive), o->chip.sliding_mode.drive * 30 / 20);
  expect(static_cast<double>(c.sliding_mode.slope), o->chip.sliding_mode.slope * 20 / 30);
  expect(static_cast<double>(c.sliding_mode.limit_V), 24.0 / 30);
  expect(static_cast<double>(c.voltage.third_per_count), 30.0 / 4096 / 3 / 30 * 32768);
  expect(static_cast<double>(c.counts_per_V), 3 * 4096 / 30.0 * 30 / 32768);
  EXPECT_EQ(c.lag_ticks, o->chip.lag_ticks);
  EXPECT_EQ(design::observer_in<double>(o->chip, bases), o->chip) << "floating point: every base is 1";
}

}  // namespace SIXSTEP_TEST_FILE
