// SPDX-License-Identifier: Apache-2.0
// measure_emf() is tested with random recordings, and with recordings whose result is known.
#include "sixstep/analysis/identification/emf/emf.hpp"

#include <gmock/gmock.h>

#include "sixstep/analysis/identification/emf/emf_shape.hpp"
#include "sixstep/analysis/identification/emf/frame_check.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/shape_factors.hpp"
#include "tests/analysis/identification/counted.hpp"
#include "tests/analysis/identification/drawn_emf.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::EmfHarmonic;
using analysis::EmfResult;
using ::testing::HasSubstr;

EmfTruth clean(bool trapezoid) {
  EmfTruth t;
  t.frequency_Hz = 50.0;
  t.periods = 7.3;
  t.rows_per_period = 1000.0;
  t.cos_part[1] = 1.0;
  if (trapezoid) make_trapezoid(t, 120.0);
  t.noise_V = 1e-5;
  return t;
}

TEST(EmfCalibration, IntervalsHoldTheTruth) {
  const int count = drawn_count(80);
  HeldOften frequency("frequency"), flux("flux linkage"), peak("line peak"), fifth("5th harmonic"),
      seventh("7th harmonic"), none("harmonics that are none"), lag("lag of the second channel");
  int taken_for_clipped = 0;
  for (int n = 1; n <= count; ++n) {
    const EmfTruth t = drawn_emf(static_cast<std::uint64_t>(n));
    const auto found = analysis::measure_emf(drawn_record(t));
    if (!found && found.problems()[0].limit.starts_with("is clipped")) {
      ++taken_for_clipped;
      continue;
    }
    ASSERT_TRUE(found) << "seed " << t.seed << ": " << to_string(found.problems()[0]);
    frequency.count(found->frequency_Hz.holds(t.frequency_Hz), t.seed);
    flux.count(found->constants.phase_fundamental.holds(t.flux_Vs), t.seed);
    peak.count(found->constants.line_peak.holds(true_line_peak(t)), t.seed);
    for (const EmfHarmonic& h : found->harmonics) {
      const auto order = static_cast<std::size_t>(h.order);
      const bool common = h.order % 3 == 0 && !t.star;
      const double part = common ? 0.0 : std::hypot(t.cos_part[order], t.sin_part[order]);
      if (part == 0.0) none.count(h.part.holds(0.0), t.seed);
      if (part > 0.0 && h.order == 5) fifth.count(h.part.holds(part), t.seed);
      if (part > 0.0 && h.order == 7) seventh.count(h.part.holds(part), t.seed);
    }
    if (t.channels == 1) continue;
    EXPECT_EQ(found->backward, t.backward) << "seed " << t.seed;
    lag.count(found->channels[1].phase_deg.holds(t.backward ? 240.0 : 120.0), t.seed);
  }
  // Four of 4400 recordings are refused as clipped. Their tops are round, and without noise nothing proves
  // that they are not clipped.
  EXPECT_LE(taken_for_clipped, 1 + count / 300);
  for (const HeldOften* held : {&frequency, &flux, &peak, &fifth, &seventh}) held->expect_95();
  // The interval of an absent harmonic starts at 0, so it can miss the true value on one side only. Hum is
  // equal in both channels, so it cancels in the phase between them.
  none.expect_at_least_95(count);
  lag.expect_at_least_95();
}

TEST(Emf, ATrapezoidBetweenLinesIsFoundAgain) {
  EmfTruth t = clean(true);
  t.channels = 3;
  analysis::EmfRequest request = drawn_record(t);
  request.pole_pairs = 4;
  const auto found = analysis::measure_emf(request);
  ASSERT_TRUE(found) << to_string(found.problems()[0]);
  EXPECT_NEAR(found->constants.phase_fundamental.value, 5e-3, 1e-8);
  EXPECT_NEAR(found->frequency_Hz.value, 50.0, 1e-5);
  EXPECT_EQ(found->pole_pairs, 4);
  EXPECT_FALSE(found->backward);
  for (const EmfHarmonic& h : found->harmonics) {
    const auto order = static_cast<std::size_t>(h.order);
    if (h.order % 3 == 0) continue;
    EXPECT_NEAR(h.in_phase, t.cos_part[order], 2e-6) << h.order;
    EXPECT_NEAR(h.across, 0.0, 2e-6) << h.order;
  }
  // The line voltage of a 120 degree trapezoid reaches 2 K_e at one angle only. Harmonics that are equal in
  // all phases are absent from line voltages and do not contribute to the torque per ampere.
  const design::ShapeFactors ideal = design::shape_factors(design::BackEmfShape::trapezoid, 120.0);
  const double K_t = found->shape_sector_mean * found->constants.phase_peak.value;
  EXPECT_NEAR(K_t / found->constants.phase_fundamental.value, ideal.sector_mean / ideal.fundamental, 2e-3);
}

/// If a probe is set to x10, or a heading says mV instead of V, the mean of the channels is a constant that
/// no motor has.
TEST(Emf, ChannelsThatContradictEachOtherAreRefused) {
  for (const double factor : {0.001, 0.1, 0.5, 0.88, 1.2, 10.0}) {
    EmfTruth t = clean(false);
    t.channels = 2;
    analysis::EmfRequest request = drawn_record(t);
    for (double& u : request.record.channels[1].u_V) u *= factor;
    const auto found = analysis::measure_emf(request);
    ASSERT_FALSE(found) << factor;
    EXPECT_THAT(found.problems()[0].limit, HasSubstr("differ too much for the phases of one motor"))
        << factor;
  }
}

/// The bounds contain the true constant, whichever channel is correct.
TEST(Emf, ChannelsThatDifferByAFewPerCentWidenTheBounds) {
  for (const double factor : {0.92, 0.97, 1.03, 1.08}) {
    EmfTruth t = clean(false);
    t.channels = 2;
    analysis::EmfRequest request = drawn_record(t);
    for (double& u : request.record.channels[1].u_V) u *= factor;
    const auto found = analysis::measure_emf(request);
    ASSERT_TRUE(found) << factor;
    EXPECT_TRUE(found->constants.phase_fundamental.holds(t.flux_Vs)) << factor;
    EXPECT_TRUE(found->constants.phase_fundamental.holds(t.flux_Vs * factor)) << factor;
  }
}

TEST(Emf, APhaseOfATrapezoidIsFlatForAsLongAsItIs) {
  EmfTruth t = clean(true);
  t.star = true;
  const auto found = analysis::measure_emf(drawn_record(t));
  ASSERT_TRUE(found);
  // A sum of 25 harmonics has a ripple of 1 % at the top. This ripple widens the part above 95 % of the peak
  // by a degree.
  EXPECT_NEAR(found->flat_deg, analysis::flat_of_trapezoid_deg, 2.0);
  const auto at = [&](int deg) { return found->shape[static_cast<std::size_t>(deg / 2)]; };
  EXPECT_NEAR(at(60), 1.0, 0.01);
  EXPECT_NEAR(at(330), 0.0, 0.01);  // the zero is half a ramp before the top, which is from 0 to 120 degrees
  EXPECT_NEAR(at(240), -1.0, 0.01);
  t.cos_part = {};
  t.cos_part[1] = 1.0;
  const auto sine = analysis::measure_emf(drawn_record(t));
  ASSERT_TRUE(sine);
  EXPECT_NEAR(sine->flat_deg, analysis::flat_of_sine_deg, 0.3);
  EXPECT_NEAR(sine->crest, std::sqrt(2.0), 1e-5);
  EXPECT_NEAR(sine->shape_sector_mean, 3 * std::sqrt(3.0) / base::pi, 1e-7);
}

/// The shape over the angle is the same for both directions of rotation, and for line voltages and phase
/// voltages.
TEST(Emf, TheShapeIsTheMotorsWhicheverWayItIsTurnedAndProbed) {
  for (const bool star : {false, true})
    for (const bool backward : {false, true}) {
      EmfTruth t = clean(false);
      t.star = star;
      t.backward = backward;
      t.channels = 3;
      t.cos_part[5] = -0.04, t.sin_part[5] = 0.01, t.cos_part[7] = 0.02, t.sin_part[7] = -0.015,
      t.cos_part[2] = 0.01, t.sin_part[4] = 0.005;
      const auto found = analysis::measure_emf(drawn_record(t));
      ASSERT_TRUE(found) << to_string(found.problems()[0]);
      EXPECT_EQ(found->backward, backward);
      double peak = 0.0;
      for (int deg = 0; deg < 360; ++deg)
        peak = std::max(peak, std::fabs(phase_shape(t, deg * std::numbers::pi / 180)));
      for (std::size_t n = 0; n < found->shape.size(); ++n)
        EXPECT_NEAR(found->shape[n], phase_shape(t, found->angle_deg[n] * std::numbers::pi / 180) / peak,
                    2e-4)
            << "star " << star << " backward " << backward << " at " << found->angle_deg[n];
    }
}

/// A complete trapezoid of height 1, not only the sum of its first harmonics. The middle of the top is at y =
/// 0, and the flanks are straight.
double whole_trapezoid(double y, double flat_deg) {
  const double off = std::fabs(std::remainder(y, 2 * base::pi)), half = flat_deg / 2 * base::rad_per_deg;
  return std::clamp((base::pi / 2 - off) / (base::pi / 2 - half), -1.0, 1.0);
}

/// A flat top has harmonics above the 25th. The sum of the first 25 harmonics overshoots; the motor's voltage
/// does not.
TEST(Emf, ThePeakIsThatOfTheWaveAndNotOfItsFirstHarmonics) {
  for (const double flat_deg : {30.0, 60.0, 90.0, 120.0, 150.0, 165.0})
    for (const bool star : {false, true}) {
      EmfTruth t = clean(false);
      t.star = star;
      analysis::EmfRequest request = drawn_record(t);
      const auto f = [&](double y) { return whole_trapezoid(y, flat_deg); };
      const double third = 2 * base::pi / 3, V = 20e-3, w = 2 * base::pi * t.frequency_Hz;
      double line_peak = 0.0;
      for (double y = 0; y < 2 * base::pi; y += 1e-3)
        line_peak = std::max(line_peak, V * (f(y) - f(y - third)));
      for (std::size_t n = 0; n < request.record.t_s.size(); ++n) {
        const double y = w * request.record.t_s[n];
        const double wave = star ? f(y) : f(y) - f(y - third),
                     noise = request.record.channels[0].u_V[n] > 0 ? 1e-6 : -1e-6;
        request.record.channels[0].u_V[n] = V * w * wave + noise;
      }
      const auto found = analysis::measure_emf(request);
      ASSERT_TRUE(found) << flat_deg;
      const analysis::EmfConstants& k = found->constants;
      EXPECT_TRUE(k.line_peak.holds(line_peak))
          << flat_deg << star << k.line_peak.low << ' ' << k.line_peak.high;
      const bool flat = flat_deg > 60.0;  // a pointed line voltage is the sum of two smaller phase voltages
      EXPECT_NEAR(k.line_peak.value, line_peak, (flat ? 2.5e-3 : 0.02) * line_peak) << flat_deg << star;
      EXPECT_LT(k.line_peak.half_width(), 0.025 * line_peak);
      if (!star) continue;  // line voltages do not contain orders 3, 9, 15, so the star's peak is unknown
      EXPECT_TRUE(k.phase_peak.holds(V)) << flat_deg << k.phase_peak.low << ' ' << k.phase_peak.high;
      EXPECT_NEAR(k.phase_peak.value, V, 4e-3 * V) << flat_deg;
    }
}

TEST(Emf, LinesOfAPhaseAndBack) {
  analysis::ShapeHarmonics phase;
  phase.resize(13);
  phase.re[4] = -0.05, phase.im[4] = 0.02, phase.re[6] = 0.03, phase.im[10] = 0.01, phase.im[1] = 0.004;
  const analysis::ShapeHarmonics line = analysis::line_of_phase(phase), back = analysis::phase_of_line(line);
  for (std::size_t n = 0; n < phase.size(); ++n) {
    EXPECT_NEAR(back.re[n], phase.re[n], 1e-14);
    EXPECT_NEAR(back.im[n], phase.im[n], 1e-14);
  }
  const double shift = std::numbers::pi / 6, third = 2 * std::numbers::pi / 3;
  for (double y = -3.0; y < 3.0; y += 0.1)
    EXPECT_NEAR(std::sqrt(3.0) * line.at(y + shift), phase.at(y) - phase.at(y - third), 1e-12) << y;
}

TEST(Emf, TheShaftsSpeedGivesThePolePairs) {
  analysis::EmfRequest request = drawn_record(clean(false));
  const auto at_rpm = [&](double rpm, std::optional<int> pairs) {
    request.speed_rad_s = rpm * std::numbers::pi / 30;
    request.pole_pairs = pairs;
    return analysis::measure_emf(request);
  };
  EXPECT_EQ(at_rpm(750.0, {})->pole_pairs, 4);
  EXPECT_EQ(at_rpm(738.0, 4)->pole_pairs, 4);
  EXPECT_THAT(to_string(at_rpm(700.0, {}).problems()[0]),
              HasSubstr("speed = 700 rpm with 50 Hz makes 4.286 pole pairs, no whole number"));
  EXPECT_THAT(to_string(at_rpm(750.0, 7).problems()[0]), HasSubstr("makes 4 pole pairs, not 7"));
}

/// A sheet states a motor's constant in one frame, such as line peak or phase rms. Only this frame agrees
/// with the recording.
TEST(FrameCheck, NamesTheFrameThatThePrintIsIn) {
  analysis::EmfRequest request = drawn_record(clean(false));
  request.pole_pairs = 4;
  const auto found = analysis::measure_emf(request);
  ASSERT_TRUE(found);
  const double phase_V_krpm = 5e-3 * 4 * 1000 * std::numbers::pi / 30, root3 = std::sqrt(3.0),
               root2 = std::sqrt(2.0);
  const std::pair<const char*, double> prints[] = {{"line-peak", root3 * phase_V_krpm},
                                                   {"line-rms", root3 / root2 * phase_V_krpm},
                                                   {"phase-peak", phase_V_krpm},
                                                   {"phase-rms", phase_V_krpm / root2},
                                                   {"six-step", 1.6539866862653762 * phase_V_krpm}};
  for (const auto& [frame, volts] : prints) {
    design::Sheet sheet;
    sheet.back_emf_constant_V_krpm = base::Quantity{.value = volts, .frame = frame};
    const auto checks = analysis::check_frames(*found, sheet, 0.02);
    ASSERT_EQ(checks.size(), 1u);
    EXPECT_TRUE(checks[0].holds()) << frame;
    for (const analysis::FrameReading& r : checks[0].readings) {
      EXPECT_EQ(r.fits, r.frame == frame) << frame << " read as " << r.frame;
      EXPECT_EQ(r.is_printed, r.frame == frame);
    }
    sheet.back_emf_constant_V_krpm->value *= 1.05;
    EXPECT_FALSE(analysis::check_frames(*found, sheet, 0.02)[0].holds());
  }
}

TEST(FrameCheck, EveryPrintOfTheTorqueConstantIsHeldAgainstTheVoltage) {
  analysis::EmfRequest request = drawn_record(clean(false));
  request.pole_pairs = 4;
  const auto found = analysis::measure_emf(request);
  ASSERT_TRUE(found);
  const double K_e = 0.02, K_t = 1.65399 * K_e;
  design::Sheet sheet;
  sheet.torque_constant_mNm_A = base::Quantity{.value = 1e3 * K_t};
  sheet.back_emf_mV_s = base::Quantity{.value = 1e3 * K_e};
  sheet.torque_constant_Nm_A = base::Quantity{.value = 1.5 * std::sqrt(2.0) * K_e, .frame = "rms"};
  sheet.flux_linkage_mWb = base::Quantity{.value = 5.0};
  sheet.speed_constant_rpm_V = base::Quantity{.value = 30 / std::numbers::pi / K_t, .frame = "six-step"};
  const auto checks = analysis::check_frames(*found, sheet, 0.005);
  ASSERT_EQ(checks.size(), 5u);
  for (const analysis::FrameCheck& c : checks) EXPECT_TRUE(c.holds()) << c.key;
  request.pole_pairs.reset();
  const auto without = analysis::check_frames(*analysis::measure_emf(request), sheet, 0.005);
  ASSERT_EQ(without.size(), 1u);
  EXPECT_EQ(without[0].key, "flux_linkage_mWb");
}

/// For each fault, one message names the position in the recording and the remedy.
TEST(Emf, WhatIsNoRecordingIsToldWhy) {
  const auto told = [](const analysis::EmfRequest& request) {
    const auto found = analysis::measure_emf(request);
    return found ? std::string("measured") : to_string(found.problems()[0]);
  };
  analysis::EmfRequest request = drawn_record(clean(false));
  const analysis::EmfRequest good = request;
  request.record.channels[0].u_V.assign(request.record.t_s.size(), 0.3);
  EXPECT_THAT(told(request), HasSubstr("ch1 = 0.3 V in every row: the motor was at rest"));
  Draw draw(3);
  for (double& u : request.record.channels[0].u_V) u = normal(draw);
  EXPECT_THAT(told(request),
              ::testing::AnyOf(HasSubstr("half waves of very different lengths"), HasSubstr("ch1 is noise")));
  EmfTruth brief = clean(false);
  brief.periods = 1.2;
  EXPECT_THAT(told(drawn_record(brief)),
              ::testing::AnyOf(HasSubstr("contains 1.2 periods of the voltage; 1.5 are needed"),
                               HasSubstr("one and a half periods are needed")));
  brief = clean(false);
  brief.rows_per_period = 5.0;
  EXPECT_THAT(told(drawn_record(brief)), HasSubstr("rows in a period"));
  request = good;
  request.record.channels.push_back(request.record.channels[0]);
  request.record.channels[1].name = "ch2";
  EXPECT_THAT(told(request), HasSubstr("ch2 = 0 deg behind ch1 is neither 120 nor 240"));
  request = good;
  request.record.t_s[100] = request.record.t_s[99];
  EXPECT_THAT(told(request), HasSubstr("in row 101 does not rise"));
  request = good;
  request.record.channels[0].u_V[7] = NAN;
  EXPECT_THAT(told(request), HasSubstr("ch1 = nan in row 8 is not a number"));
  request.record.channels[0].u_V.pop_back();
  EXPECT_THAT(told(request), HasSubstr("must have one value for each of"));
  request.record = {};
  EXPECT_THAT(told(request), HasSubstr("channels = 0"));
}

}  // namespace SIXSTEP_TEST_FILE
