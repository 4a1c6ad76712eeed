// SPDX-License-Identifier: Apache-2.0
// The starting pulses of a sensorless drive are compared with the closed forms of pulse_start.hpp.
#include "sixstep/design/loops/pulse_start.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "tests/design/sensorless_maxon.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using sixstep::testing::maxon;

/// The 251601 motor at 24 V. The test assumes a salient rotor and saturated iron, and a converter with 5 mA
/// per count.
constexpr design::PulseSpec salient{.bus_V = 24,
                                    .period_s = 30e-6,
                                    .L_d_H = 0.24e-3,
                                    .L_q_H = 0.34e-3,
                                    .saturation_A = 40,
                                    .most_A = 3.495,
                                    .current_range_A = 10.24};

constexpr double L_S = 0.29e-3;

double current_A(double t_s, double L_H) { return 24 / 1.03 * (1 - std::exp(-1.03 * t_s / (2 * L_H))); }

/// Ratio of polarity signal to noise for a pulse of `periods` periods. The only noise is the rounding of the
/// converter.
double north(double periods, double lsb_A) {
  const double t = periods * 30e-6, I = current_A(t, L_S), x = 1.03 * t / (2 * L_S),
               k = x / (std::exp(x) - 1);
  const double m = 2 / std::sqrt(3.0) * 0.24e-3 * I / (2 * 40 * L_S);
  const double sigma = std::sqrt(64.0 / 6 / 8 + 3 * 64.0 / 6 / 64 + 45);
  return 0.75 * m * k * std::sqrt(3.0) * (2 * I / lsb_A * 8) / sigma;
}

TEST(PulseStartDesign, FollowsItsClosedForms) {
  const auto start = design::pulse_start(maxon(), salient);
  ASSERT_TRUE(start) << to_string(start.problems().front());
  const control::PulsePositionConfig& p = start->pulses;
  EXPECT_LT(north(0.5, 5e-3), 12.0) << "one period shows too little";
  EXPECT_GT(north(1.5, 5e-3), 12.0) << "two are enough";
  EXPECT_EQ(p.pulse_ticks, 2);
  EXPECT_GE(p.rest_ticks, p.pulse_ticks) << "the current ends against the whole bus";
  EXPECT_EQ(p.current.offset_counts, 2048);
  EXPECT_NEAR(start->north, north(1.5, 5e-3), 1e-9);
  EXPECT_NEAR(start->axis / start->north,
              (0.05 / 0.29) / (0.75 * 2 / std::sqrt(3.0) * 0.24e-3 * start->current_A / (80 * L_S)), 1e-9);
  EXPECT_NEAR(start->current_A, current_A(45e-6, L_S), 1e-12);
  const double least = 0.24e-3 * (1 - 2 / std::sqrt(3.0) * 3.495 / 80);
  EXPECT_NEAR(start->greatest_A, current_A(45e-6, least), 1e-12);
  // The greatest current i satisfies i L(x, i) = psi. No rotor angle gives a greater current.
  double i = 0;
  for (int n = 0; n < 100; ++n) i = current_A(45e-6, 0.24e-3 * (1 - 2 / std::sqrt(3.0) * i / 80));
  EXPECT_LT(i, start->greatest_A);
  const double m = 2 / std::sqrt(3.0) * 0.24e-3 * start->current_A / (80 * L_S);
  EXPECT_NEAR(start->off_deg, (5 / start->axis + 3.0 / 32 * m * m / (0.05 / 0.29)) / 2 * 180 / base::pi,
              1e-9);
  EXPECT_NEAR(start->lasts_s, (64 + 8 * 6 * (p.pulse_ticks + p.rest_ticks)) * 30e-6, 1e-12);
}

/// The rotation is proportional to the torque constant, the current, the square of the time, and 1/inertia.
/// Without saliency and saturation, only the first part of the rotation is left.
TEST(PulseStartDesign, BoundsWhatThePulsesTurn) {
  design::PulseSpec round = salient;
  round.L_d_H = round.L_q_H = L_S;
  round.saturation_A = 0;
  round.most_A = current_A(1.6 * 30e-6, L_S);  // two periods are allowed, three are not
  const auto start = design::pulse_start(maxon(), round);
  ASSERT_TRUE(start);
  ASSERT_EQ(start->pulses.pulse_ticks, 2);
  const double P = base::pi / 3 * 0.0335 * current_A(45e-6, L_S) * 45e-6, D = 5 * 30e-6;
  EXPECT_NEAR(start->turned_deg, 8 * D * 2 * P / 1.35e-5 * 8 * 180 / base::pi, 1e-9);
  const auto uneven = design::pulse_start(maxon(), salient);
  ASSERT_TRUE(uneven);
  EXPECT_GT(uneven->turned_deg, start->turned_deg);
  design::MotorModel light = maxon();
  light.shaft.J_kg_m2 /= 100;
  const auto refused = design::pulse_start(light, salient);
  EXPECT_TRUE(!refused || refused->turned_deg <= 15.0) << "a quarter of a sector";
}

/// If the sheet states no saturation current, the necessary pulse is unknown. The design then uses the
/// longest pulse within its limits: with one period more, the pulse would exceed a limit.
TEST(PulseStartDesign, AsksAsLoudAsItMayWhereTheSheetIsSilent) {
  design::PulseSpec silent = salient;
  silent.saturation_A = 0;
  const auto start = design::pulse_start(maxon(), silent);
  ASSERT_TRUE(start);
  EXPECT_EQ(start->north, 0.0);
  EXPECT_EQ(start->off_deg, (5 / start->axis) / 2 * 180 / base::pi);
  const double t = (start->pulses.pulse_ticks - 0.5) * 30e-6;
  EXPECT_LE(current_A(t, 0.24e-3), 3.495);
  EXPECT_GT(current_A(t + 30e-6, 0.24e-3), 3.495);
}

/// A delayed command reduces the allowed pulse by one period. A noisy converter and a slow amplifier need
/// longer pulses.
TEST(PulseStartDesign, LengthensWithWhatTheBoardTakes) {
  const design::PulseStart plain = *design::pulse_start(maxon(), salient);
  design::PulseSpec s = salient;
  s.delay_periods = 1;
  const auto delayed = design::pulse_start(maxon(), s);
  ASSERT_TRUE(delayed);
  EXPECT_EQ(delayed->pulses.pulse_ticks, plain.pulses.pulse_ticks + 1);
  EXPECT_EQ(delayed->current_A, plain.current_A);
  s = salient;
  s.noise_A = 0.05;  // ten counts
  const auto noisy = design::pulse_start(maxon(), s);
  ASSERT_TRUE(noisy);
  const double of_reading = 2 * (8 * 10.0 * 8 * 10.0 + 64.0 / 12);
  const double louder =
      std::sqrt((of_reading / 8 + 3 * of_reading / 64 + 45) / (64.0 / 6 / 8 + 3 * 64.0 / 6 / 64 + 45));
  EXPECT_NEAR(noisy->north * louder, north(noisy->pulses.pulse_ticks - 0.5, 5e-3), 1e-9);
  s = salient;
  s.late_s = 4.5e-6;  // a tenth of the pulse
  EXPECT_NEAR(design::pulse_start(maxon(), s)->north, 0.9 * plain.north, 1e-9);
}

TEST(PulseStartDesign, TellsEveryMistakeByItsKey) {
  const auto where = [](const design::PulseSpec& s, const design::MotorModel& m) {
    const auto start = design::pulse_start(m, s);
    return start ? std::string() : start.problems().front().where;
  };
  const auto with = [](auto change) {
    design::PulseSpec s = salient;
    change(s);
    return s;
  };
  EXPECT_EQ(where(with([](auto& s) { s.bus_V = 0; }), maxon()), "bus_V");
  EXPECT_EQ(where(with([](auto& s) { s.period_s = 0; }), maxon()), "period_s");
  EXPECT_EQ(where(with([](auto& s) { s.current_range_A = 0; }), maxon()), "current_range_A");
  EXPECT_EQ(where(with([](auto& s) { s.adc_bits = 4; }), maxon()), "adc_bits");
  EXPECT_EQ(where(with([](auto& s) { s.L_d_H = 0; }), maxon()), "motor");
  // In each case, a pulse of a single period already exceeds a limit: the start's current, the converter's
  // range, the saturation model, or the allowed rotation.
  EXPECT_EQ(where(with([](auto& s) { s.most_A = 0.3; }), maxon()), "overload");
  EXPECT_EQ(where(with([](auto& s) { s.current_range_A = 0.3; }), maxon()), "current_range_A");
  EXPECT_EQ(where(with([](auto& s) { s.saturation_A = 0.5; }), maxon()), "period_s");
  design::MotorModel light = maxon();
  light.shaft.J_kg_m2 = 1e-8;
  EXPECT_EQ(where(salient, light), "period_s");
  // The step of the converter is too coarse for every allowed current.
  EXPECT_EQ(where(with([](auto& s) { s.current_range_A = 2000; }), maxon()), "current_range_A");
  EXPECT_EQ(where(salient, maxon()), "");
}

}  // namespace SIXSTEP_TEST_FILE
