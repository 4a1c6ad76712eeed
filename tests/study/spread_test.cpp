// SPDX-License-Identifier: Apache-2.0
// Tests the drives of a spread: the values that vary, the values that do not vary, and the refusals.
#include "sixstep/study/scenario/spread.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

constexpr std::uint64_t seed = 7;
// The product, sum and quotient of numbers near 1 each have an error of half a bit.
constexpr double rounding = 4 * 0x1p-52;

Spread relative(const char* key, double part, Distribution distribution = Distribution::uniform) {
  Spread s;
  s.key = key;
  s.relative = part;
  s.distribution = distribution;
  return s;
}

Scenario series() {
  Scenario s = current_square();
  s.spread = {relative("motor_override.resistance_ohm", 0.1),
              relative("motor_override.inductance_mH", 0.2, Distribution::normal),
              relative("motor_override.torque_constant_mNm_A", 0.08),
              relative("motor_override.inertia_gcm2", 0.1), relative("supply.voltage_V", 0.05)};
  return s;
}

TEST(Spread, ADriveIsAFunctionOfSeedAndNumber) {
  const Scenario s = series();
  const Scenario a = varied(s, seed, 41), b = varied(s, seed, 41), next = varied(s, seed, 42),
                 other = varied(s, seed + 1, 41);
  EXPECT_EQ(a.sheet.resistance_ohm->value, b.sheet.resistance_ohm->value);
  EXPECT_NE(a.sheet.resistance_ohm->value, next.sheet.resistance_ohm->value);
  EXPECT_NE(a.sheet.resistance_ohm->value, other.sheet.resistance_ohm->value);
  EXPECT_TRUE(a.spread.empty());
}

TEST(Spread, EachDriveHasItsOwnNoise) {
  Scenario s = series();
  s.duration_s = 2e-3;
  s.spread.clear();
  s.sensors.currents = rig::CurrentMeasurement::phases;
  s.sensors.current_range_A = 20.48;
  s.sensors.current_noise_A = 0.05;
  const auto digest = [&s](std::uint64_t of_seed, std::uint64_t number) {
    return run(varied(s, of_seed, number))->digest;
  };
  const std::uint64_t first = digest(seed, 0);
  EXPECT_EQ(digest(seed, 0), first);
  EXPECT_NE(digest(seed, 1), first);
  EXPECT_NE(digest(seed + 1, 0), first);
  s.sensors.seed = 1;
  EXPECT_NE(digest(seed, 0), first);
}

TEST(Spread, AKeysDrawsDoNotDependOnTheOtherKeys) {
  const Scenario s = series();
  Scenario alone = s, reversed = s;
  alone.spread = {s.spread[1]};
  std::reverse(reversed.spread.begin(), reversed.spread.end());
  for (std::uint64_t n = 0; n < 100; ++n) {
    const double all = varied(s, seed, n).sheet.inductance_mH->value;
    EXPECT_EQ(varied(alone, seed, n).sheet.inductance_mH->value, all);
    EXPECT_EQ(varied(reversed, seed, n).sheet.inductance_mH->value, all);
  }
}

TEST(Spread, StaysWithinItsWidthAndFillsIt) {
  constexpr int count = 4000;
  const Scenario s = series();
  double low = 2.0, high = 0.0, sum = 0.0, far = 0.0;
  for (std::uint64_t n = 0; n < count; ++n) {
    const Scenario one = varied(s, seed, n);
    const double R = one.sheet.resistance_ohm->value / 1.03;
    low = std::min(low, R);
    high = std::max(high, R);
    sum += R;
    far = std::max(far, std::fabs(one.sheet.inductance_mH->value / 0.572 - 1.0));
  }
  // The probability that no draw is in an outermost 0.5 % of the width is 0.9975^4000 = 4.5e-5.
  EXPECT_GE(low, 0.9 - rounding);
  EXPECT_LE(high, 1.1 + rounding);
  EXPECT_LT(low, 0.901);
  EXPECT_GT(high, 1.099);
  EXPECT_NEAR(sum / count, 1.0, 5 * 0.1 / std::sqrt(3.0 * count)) << "five standard errors, seed " << seed;
  EXPECT_LE(far, 3 * 0.2 + rounding) << "cut_sigma";
  EXPECT_GT(far, 2.5 * 0.2) << "1.2 % of a normal lie beyond 2.5 sigma";
}

/// A normal distribution that is cut at one sigma has the variance 1 - 2 phi(1)/(2 Phi(1) - 1) = 1 -
/// 0.4839414/0.6826895 = 0.2911251, in units of sigma^2 (density phi, distribution Phi).
TEST(Spread, ACutNormalHasItsVariance) {
  constexpr int count = 20000;
  Scenario s = current_square();
  s.spread = {relative("motor_override.resistance_ohm", 0.1, Distribution::normal)};
  s.spread[0].cut_sigma = 1.0;
  double squares = 0.0;
  for (std::uint64_t n = 0; n < count; ++n) {
    const double x = (varied(s, seed, n).sheet.resistance_ohm->value / 1.03 - 1.0) / 0.1;
    EXPECT_LE(std::fabs(x), 1.0 + rounding / 0.1);
    squares += x * x;
  }
  // x^2 is in [0, 1], so its standard deviation is at most 1/2.
  EXPECT_NEAR(squares / count, 0.2911251, 5 * 0.5 / std::sqrt(double{count})) << "seed " << seed;
}

TEST(Spread, TheControllerStaysTheOneDesignedForTheNominalMotor) {
  for (const Mode mode : {Mode::current, Mode::speed, Mode::position}) {
    Scenario s = maxon_scenario(mode, 5.0);
    s.sheet.stall_torque_mNm.reset();  // it is derived from K_t and R, which both vary
    s.spread = series().spread;
    const auto nominal = compile(s);
    const auto one = compile(varied(s, seed, 3));
    ASSERT_TRUE(nominal && one);
    const auto& a = nominal->drive;
    const auto& b = one->drive;
    EXPECT_EQ(a.nominal_bus_V, b.nominal_bus_V);
    EXPECT_EQ(a.current.d1, b.current.d1);
    EXPECT_EQ(a.current.d0, b.current.d0);
    EXPECT_EQ(a.current.limit, b.current.limit);
    EXPECT_EQ(a.speed.d1, b.speed.d1);
    EXPECT_EQ(a.speed.d0, b.speed.d0);
    EXPECT_EQ(a.current_at_full_torque_A, b.current_at_full_torque_A);
    EXPECT_EQ(a.current_limit_A, b.current_limit_A);
    EXPECT_EQ(a.speed_limit_rad_s, b.speed_limit_rad_s);
    EXPECT_NE(nominal->motor.machine.R_ohm, one->motor.machine.R_ohm);
    EXPECT_NE(nominal->motor.machine.L_H, one->motor.machine.L_H);
    EXPECT_NE(nominal->motor.machine.K_e_V_s, one->motor.machine.K_e_V_s);
    EXPECT_NE(nominal->shaft.J_kg_m2, one->shaft.J_kg_m2);
    EXPECT_NE(nominal->supply.V_0_V, one->supply.V_0_V);
  }
}

TEST(Spread, FrictionDoesNotFollowTheTorqueConstant) {
  Scenario s = current_square();
  s.sheet.viscous_friction_Nm_s.reset();
  s.sheet.no_load_speed_rpm = base::Quantity{6710.0, "", ""};
  s.sheet.no_load_current_mA = base::Quantity{185.0, "", ""};
  s.spread = {relative("motor_override.torque_constant_mNm_A", 0.08)};
  ASSERT_EQ(check(s), base::Problems{});
  const auto nominal = compile(s), one = compile(varied(s, seed, 0));
  ASSERT_TRUE(nominal && one);
  EXPECT_GT(nominal->shaft.B_Nm_s, 0.0);
  EXPECT_EQ(nominal->shaft.B_Nm_s, one->shaft.B_Nm_s);
  // A friction that is derived from other values may also have a spread itself.
  s.spread = {relative("motor_override.viscous_friction_Nm_s", 0.4)};
  ASSERT_EQ(check(s), base::Problems{});
  EXPECT_NE(compile(varied(s, seed, 0))->shaft.B_Nm_s, nominal->shaft.B_Nm_s);
}

TEST(Spread, TorqueConstantAndBackEmfStayOneFact) {
  for (const char* key : {"motor_override.torque_constant_mNm_A", "motor_override.back_emf_mV_s"}) {
    Scenario s = current_square();
    s.sheet.back_emf_mV_s = base::Quantity{16.75, "phase", ""};
    s.spread = {relative(key, 0.08)};
    ASSERT_EQ(check(s), base::Problems{});
    for (std::uint64_t n = 0; n < 20; ++n) {
      const Scenario one = varied(s, seed, n);
      EXPECT_EQ(check(one), base::Problems{});
      EXPECT_NEAR(one.sheet.torque_constant_mNm_A->value / one.sheet.back_emf_mV_s->value, 2.0, 4 * 0x1p-52);
    }
  }
}

TEST(Spread, StandardKeysStrayWhateverTheSheetPrints) {
  // Instead of the torque constant, the sheet has a flux linkage. Instead of the inductance, it has L_d =
  // L_q.
  Scenario s = current_square();
  s.sheet.torque_constant_mNm_A.reset();
  s.sheet.flux_linkage_mWb = base::Quantity{2.1, "", ""};
  s.sheet.inductance_mH.reset();
  s.sheet.d_axis_inductance_mH = s.sheet.q_axis_inductance_mH = base::Quantity{0.286, "", ""};
  s.spread = {relative("motor_override.torque_constant_mNm_A", 0.08),
              relative("motor_override.inductance_mH", 0.2)};
  ASSERT_EQ(check(s), base::Problems{});
  const auto nominal = design::motor_model(s.sheet), one = design::motor_model(varied(s, seed, 0).sheet);
  ASSERT_TRUE(nominal && one);
  EXPECT_NE(one->K_t_Nm_A, nominal->K_t_Nm_A);
  EXPECT_NE(one->machine.L_H, nominal->machine.L_H);
  EXPECT_NEAR(one->K_t_Nm_A / nominal->K_t_Nm_A, 1.0, 0.08);
  EXPECT_NEAR(one->machine.L_H / nominal->machine.L_H, 1.0, 0.2);
}

TEST(Spread, AnAbsoluteWidthMovesAZero) {
  Scenario s = current_square();
  s.spread = {relative("initial.angle_rad", 0.1)};
  EXPECT_EQ(check_spread(s).at(0).where, "spread[0].relative");
  s.spread[0].relative.reset();
  s.spread[0].absolute = 0.1;
  ASSERT_EQ(check(s), base::Problems{});
  const double angle = varied(s, seed, 0).initial.angle_rad;
  EXPECT_NE(angle, 0.0);
  EXPECT_LE(std::fabs(angle), 0.1);
}

TEST(Spread, EachHallEdgeIsMountedByItself) {
  Scenario s = current_square();
  s.sensors.rotor = RotorSensing::hall;
  for (int n = 0; n < 6; ++n) {
    Spread edge;
    edge.key = "sensors.hall_edges_deg[" + std::to_string(n) + "]";
    edge.absolute = 3.0;
    s.spread.push_back(edge);
  }
  ASSERT_EQ(check(s), base::Problems{});
  double sum = 0, product = 0, squares = 0;
  constexpr int drives = 2000;
  for (int n = 0; n < drives; ++n) {
    const Scenario drive = varied(s, seed, static_cast<std::uint64_t>(n));
    const std::vector<double>& edges = drive.sensors.hall_edges_deg;
    ASSERT_EQ(edges.size(), 6u);
    EXPECT_EQ(strayed_values(s, drive), edges);
    for (const double x : edges) EXPECT_LE(std::fabs(x), 3.0);
    sum += edges[0] + edges[1];
    product += edges[0] * edges[1];
    squares += edges[0] * edges[0];
  }
  // A uniform value in +-3 has the mean 0 and the variance 3, and neighbouring values are not correlated. The
  // bounds are five standard deviations.
  EXPECT_NEAR(sum / drives, 0.0, 5 * std::sqrt(6.0 / drives));
  EXPECT_NEAR(squares / drives, 3.0, 5 * std::sqrt(7.2 / drives));
  EXPECT_NEAR(product / drives, 0.0, 5 * std::sqrt(9.0 / drives));
  EXPECT_EQ(strayed_to(s, "sensors.hall_edges_deg[5]", 2.0)->sensors.hall_edges_deg[5], 2.0);
  EXPECT_FALSE(strayed_to(s, "sensors.hall_edges_deg[6]", 2.0));
}

std::string refusal(const Spread& spread, Scenario s = current_square()) {
  s.spread = {spread};
  const base::Problems problems = check(s);
  return problems.size() == 1 ? to_string(problems[0]) : std::to_string(problems.size()) + " problems";
}

TEST(Spread, RefusesWhatCannotStray) {
  using ::testing::HasSubstr;
  EXPECT_THAT(refusal(relative("motor_override.resistance", 0.1)), HasSubstr("is not a number"));
  EXPECT_THAT(refusal(relative("motor_override.stall_torque_mNm", 0.1)), HasSubstr("is not a number"));
  EXPECT_THAT(refusal(relative("control.current.d1", 0.1)), HasSubstr("is not a number"));
  EXPECT_THAT(refusal(relative("load.locked", 0.1)), HasSubstr("is not a number"));
  EXPECT_THAT(refusal(relative("initial.bus_V", 0.1)), HasSubstr("give initial.bus_V its nominal value"));
  EXPECT_THAT(refusal(relative("motor_override.back_emf_mV_s", 0.1)),
              HasSubstr("spread torque_constant_mNm_A, which the sheet gives"));
  EXPECT_THAT(refusal(relative("motor_override.resistance_ohm", 1.5)),
              HasSubstr("lets motor_override.resistance_ohm reach -0.515, outside the key's range"));
  EXPECT_THAT(refusal(relative("motor_override.resistance_ohm", 0.4, Distribution::normal)),
              HasSubstr("lower this value, or lower cut_sigma"));
  Spread none;
  none.key = "supply.voltage_V";
  EXPECT_THAT(refusal(none), HasSubstr("spread[0].relative is missing"));
  none.relative = none.absolute = 0.1;
  EXPECT_THAT(refusal(none), HasSubstr("both keys give the width"));
}

TEST(Spread, RefusesOneQuantityTwice) {
  Scenario s = current_square();
  s.sheet.back_emf_mV_s = base::Quantity{16.75, "phase", ""};
  s.spread = {relative("motor_override.torque_constant_mNm_A", 0.1),
              relative("motor_override.back_emf_mV_s", 0.1)};
  ASSERT_EQ(check(s).size(), 1u);
  EXPECT_EQ(check(s)[0].where, "spread[1].key");
}

}  // namespace SIXSTEP_TEST_FILE
