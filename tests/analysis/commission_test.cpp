// SPDX-License-Identifier: Apache-2.0
// Motors are commissioned on the bench that commission_bench() makes from a data sheet. The library's motors
// are identified within the stated bounds. Unsuitable motors are refused with the reason.
#include "sixstep/analysis/commission/commission_study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "sixstep/analysis/commission/commission_truth.hpp"
#include "sixstep/base/angle.hpp"
#include "tests/support/in_part.hpp"
#include "text/results/commission_text.hpp"
#include "text/scenario/scenario_file.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::CommissionStudy;
using analysis::CommissionSubject;
using control::CommissioningPhase;
using rig::WireOrder;

CommissionSubject subject_of(const char* motor) {
  const auto sheet = text::read_sheet(motor);
  EXPECT_TRUE(sheet) << motor;
  return {.motor = motor, .sheet = *sheet};
}

struct OnBench {
  const char* motor;
  double voltage_V;        ///< 0: nominal voltage
  double current_A = 0.0;  ///< 0: the default test current
};
constexpr OnBench benches[] = {
    {"anaheim-bly172s", 0}, {"baldor-bsm90n-175", 0}, {"dji-2212-920kv", 0, 19}, {"maxon-200142", 0},
    {"maxon-251601", 0},    {"maxon-339285", 0},      {"maxon-339286", 0},       {"maxon-397172", 0},
    {"maxon-488607", 0},    {"maxon-651607", 0},      {"maxon-651609", 0},       {"maxon-651614", 0},
    {"teknic-m2310p", 0},   {"hoverboard-hub", 36},   {"mjbots-mj5208", 24},     {"gmcc-ksk89d53u", 100}};

/// With SIXSTEP_ALL_MOTORS (ctest --preset long) every motor is tested, otherwise every fourth motor.
bool in_full() { return std::getenv("SIXSTEP_ALL_MOTORS") != nullptr; }

TEST(Commission, FindsTheMotorsOfTheLibraryWithinItsBounds) {
  InPart some;
  double offset_deg = -25.0;
  int seed = 0;
  for (const OnBench& on : benches) {
    CommissionSubject subject = subject_of(on.motor);
    if (on.voltage_V > 0) subject.voltage_V = on.voltage_V;
    if (on.current_A > 0) subject.current_A = on.current_A;
    subject.hall_offset_deg = offset_deg;
    subject.seed = ++seed;
    offset_deg += 3.5;
    if (some.leaves_out() || (!in_full() && seed % 4 != 1)) continue;
    const auto s = analysis::study_commission({.subject = subject});
    ASSERT_TRUE(s) << on.motor << ": " << to_string(s.problems()[0]);
    const analysis::CommissionTruth& is = s->bench.truth;
    EXPECT_EQ(s->state.phase, CommissioningPhase::done) << on.motor;
    EXPECT_NEAR(s->found.R_ohm, is.R_ohm, s->bounds.R_part * s->found.R_ohm) << on.motor;
    EXPECT_NEAR(s->found.L_H, is.L_H, s->bounds.L_part * s->found.L_H) << on.motor;
    EXPECT_NEAR(s->found.flux_linkage_Vs, is.flux_linkage_Vs, s->bounds.flux_part * s->found.flux_linkage_Vs)
        << on.motor;
    ASSERT_TRUE(s->lines_found()) << on.motor;
    EXPECT_NEAR(s->shown_offset_deg, subject.hall_offset_deg, 1e-9) << on.motor;
    EXPECT_LE(s->worst_edge_deg(), s->bounds.edge_deg) << on.motor;
    EXPECT_TRUE(s->holds()) << on.motor;
    // The bounds must also be small, because an infinite bound would always contain the true value.
    EXPECT_LT(s->bounds.R_part, 0.01) << on.motor;
    EXPECT_LT(s->bounds.L_part, 0.05) << on.motor;
    // For a salient rotor, the effects of the currents along and across the magnet are not separable. The
    // bound is wide, but the value is accurate.
    EXPECT_LT(is.beyond_L_H > 0 ? std::fabs(s->found.flux_linkage_Vs / is.flux_linkage_Vs - 1)
                                : s->bounds.flux_part,
              is.beyond_L_H > 0 ? 0.02 : 0.08)
        << on.motor;
    EXPECT_LT(s->bounds.edge_deg, 10.0) << on.motor;
  }
}

/// Without a nominal current in the sheet, the default test current is low: a fifth of the current at full
/// duty through two phases.
TEST(Commission, ASheetWithoutNominalCurrentIsTestedWithTheStandIn) {
  CommissionSubject drone = subject_of("dji-2212-920kv");
  const auto usual = analysis::commission_bench(drone);
  ASSERT_TRUE(usual);
  EXPECT_EQ(usual->from, analysis::TestCurrent::twice_tenth_of_stall);
  EXPECT_FALSE(usual->nominal_printed);
  EXPECT_EQ(usual->wish.test_A, 10);  // 12 V/(2 0.1153 ohm)/5 = 10.4 A, to two digits
  EXPECT_EQ(text::stand_in_words(*usual),
            ", a fifth of the current at full duty: the sheet names no nominal current");
  drone.current_A = 19;
  EXPECT_EQ(text::stand_in_words(*analysis::commission_bench(drone)), "");
  const auto printed = analysis::commission_bench(subject_of("maxon-251601"));
  ASSERT_TRUE(printed);
  EXPECT_EQ(printed->from, analysis::TestCurrent::twice_nominal);
  EXPECT_EQ(text::stand_in_words(*printed), "");
}

/// An even permutation of the phases keeps the motor's direction; an odd permutation reverses it. In both
/// cases the edges are found at the board's angles.
TEST(Commission, FindsTheLinesOfCrossedWires) {
  InPart some;
  constexpr WireOrder orders[] = {WireOrder::abc, WireOrder::bca, WireOrder::cab,
                                  WireOrder::acb, WireOrder::cba, WireOrder::bac};
  std::uint8_t n = 0;
  for (const WireOrder phases : orders) {
    const WireOrder probes = orders[5 - n];
    CommissionSubject subject = subject_of("maxon-251601");
    subject.wires = {phases, probes, static_cast<std::uint8_t>(n++)};
    subject.hall_offset_deg = 9.0;
    if (some.leaves_out()) continue;
    const auto s = analysis::study_commission({.subject = subject});
    ASSERT_TRUE(s);
    EXPECT_TRUE(s->holds()) << int(phases) << int(probes) << int(n);
    EXPECT_NEAR(s->shown_offset_deg, phases < WireOrder::acb ? 9.0 : -9.0, 1e-9) << int(phases);
  }
}

/// Different noise gives different results within the same bounds. Equal noise gives results that are equal
/// to the last bit.
TEST(Commission, HoldsWhateverTheNoiseAndIsTheSameForOne) {
  InPart some;
  double first = 0.0;
  for (int seed = 1; seed <= 2; ++seed) {
    CommissionSubject subject = subject_of("maxon-251601");
    subject.seed = seed;
    if (some.leaves_out()) continue;
    const auto s = analysis::study_commission({.subject = subject});
    ASSERT_TRUE(s);
    EXPECT_TRUE(s->holds()) << seed;
    if (first == 0.0) {
      first = s->found.R_ohm;
      EXPECT_EQ(analysis::study_commission({.subject = subject})->found.R_ohm, first);
    } else {
      EXPECT_NE(s->found.R_ohm, first) << seed;
    }
  }
}

/// With a larger current, the levels differ by more counts, so rounding and dead time have less effect.
TEST(Commission, BoundsShrinkWithTheCurrentOverOneRange) {
  CommissionSubject subject = subject_of("maxon-251601");
  subject.current_A = 3.0;
  const auto less = analysis::study_commission({.subject = subject});
  subject.current_A = 9.0;
  const auto more = analysis::study_commission({.subject = subject});
  ASSERT_TRUE(less && more);
  EXPECT_TRUE(less->holds() && more->holds());
  EXPECT_LT(more->bounds.edge_deg, less->bounds.edge_deg);
}

/// Peak of the fundamental, relative to K_e (model.md 1):
/// - trapezoid with ramps of width 2 g: 4 sin g/(pi g)
/// - given harmonics: the first harmonic
/// - table: the Fourier integral, for a triangle 8/pi^2
TEST(Commission, KnowsTheFundamentalOfEachShape) {
  plant::general::Machine m{.R_ohm = {1, 1, 1}, .K_e_V_s = {0.02, 0.02, 0.02}, .L_H = 1e-3, .pole_pairs = 4};
  for (const double flat_deg : {60.0, 100.0, 120.0, 150.0}) {
    m.shape = {.flat_deg = flat_deg};
    const double g = (180 - flat_deg) / 2 * base::pi / 180;
    EXPECT_NEAR(analysis::flux_linkage_of(m), 4 * std::sin(g) / (base::pi * g) * 0.02 / 4, 1e-12) << flat_deg;
  }
  m.shape = {.harmonics = {{1, 1.0}, {5, 0.1}}};
  EXPECT_DOUBLE_EQ(analysis::flux_linkage_of(m), 0.02 / 4);
  m.shape = {.table = {{0, 0}, {90, 1}, {270, -1}}};
  EXPECT_NEAR(analysis::flux_linkage_of(m), 8 / (base::pi * base::pi) * 0.02 / 4, 1e-12);
}

void expect_refused(const CommissionSubject& subject, const char* where, const char* words) {
  const auto bench = analysis::commission_bench(subject);
  ASSERT_FALSE(bench) << where;
  EXPECT_EQ(bench.problems()[0].where, where);
  EXPECT_NE(bench.problems()[0].limit.find(words), std::string::npos) << bench.problems()[0].limit;
  EXPECT_FALSE(bench.problems()[0].cure.empty());
}

TEST(Commission, SaysWhichMotorsItCannotBeMadeWith) {
  expect_refused(subject_of("example-linear"), "kind", "track");
  CommissionSubject delta = subject_of("maxon-251601");
  delta.sheet.connection = design::WindingConnection::delta;
  expect_refused(delta, "connection", "star");
  expect_refused(subject_of("hoverboard-hub"), "voltage_V", "is missing");
  for (const double A : {0.0, -1.0, 1e9, double(NAN), double(INFINITY)}) {
    CommissionSubject subject = subject_of("maxon-251601");
    subject.current_A = A;
    expect_refused(subject, "current_A", "must be above 0");
  }
  CommissionSubject weak = subject_of("maxon-251601");
  weak.current_A = 1e-5;
  expect_refused(weak, "current_A", "the rotor takes too long to come to rest");
  CommissionSubject beside = subject_of("maxon-251601");
  beside.hall_offset_deg = 181.0;
  expect_refused(beside, "hall_offset_deg", "");
}

TEST(Commission, WhatIsNotFoundIsNoProblemAndNotHeld) {
  CommissionSubject subject = subject_of("dji-2212-920kv");
  subject.current_A = 4.0;  // half of the voltage vector is lost to dead time and diodes
  const auto s = analysis::study_commission({.subject = subject});
  ASSERT_TRUE(s);
  EXPECT_FALSE(s->lines_found());
  EXPECT_FALSE(s->holds());
  EXPECT_NEAR(s->found.R_ohm, s->bench.truth.R_ohm, s->bounds.R_part * s->found.R_ohm);
}

TEST(Commission, EndsEarlyWhereNobodyWantsIt) {
  int asked = 0;
  const auto s = analysis::study_commission(
      {.subject = subject_of("maxon-251601"), .keep_going = [&] { return ++asked < 5; }});
  ASSERT_FALSE(s);
  EXPECT_EQ(asked, 5);
}

TEST(Commission, PhasesFollowEachOtherWithoutAGap) {
  const auto s = analysis::study_commission({.subject = subject_of("maxon-251601")});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->phases.front().from_s, 0.0);
  for (std::size_t n = 1; n < s->phases.size(); ++n) EXPECT_EQ(s->phases[n].from_s, s->phases[n - 1].to_s);
  EXPECT_EQ(s->phases.back().phase, CommissioningPhase::done);
  EXPECT_EQ(s->phases.back().from_s, s->seconds);
}

}  // namespace SIXSTEP_TEST_FILE
