// SPDX-License-Identifier: Apache-2.0
// Tests runs with a tabulated back-EMF, and the iron's part of the friction.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/elementary.hpp"
#include "sixstep/study/compile/general_plant.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using study::Scenario;

using Rows = std::vector<std::vector<double>>;

Rows rows_of(Scenario s) {
  s.record.columns = {"i_a_A", "i_b_A", "i_c_A", "speed_rad_s", "angle_rad", "torque_Nm"};
  Rows rows;
  const auto out = study::run(s, {.on_record = [&](study::Row r) { rows.emplace_back(r.begin(), r.end()); }});
  EXPECT_TRUE(out) << base::to_string(out.problems()[0]);
  return rows;
}

/// Largest difference of a column divided by the column's largest value.
double apart(const Rows& a, const Rows& b) {
  double worst = 0.0;
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t c = 1; c < a[0].size(); ++c) {
    double most = 0.0, difference = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n) {
      most = std::max(most, std::fabs(a[n][c]));
      difference = std::max(difference, std::fabs(a[n][c] - b[n][c]));
    }
    worst = std::max(worst, difference / most);
  }
  return worst;
}

void give_table(Scenario& s, std::vector<double> angle, std::vector<double> value) {
  s.sheet.back_emf = design::BackEmfShape::table;
  s.sheet.back_emf_angle_deg = std::move(angle);
  s.sheet.back_emf_shape = std::move(value);
}

TEST(TableRun, OfTheTrapezoidsFourCornersIsTheTrapezoidsRun) {
  for (const double flat : {120.0, 100.0}) {
    Scenario trapezoid = maxon_scenario(control::Mode::duty, 0.6);
    trapezoid.sheet.flat_deg = flat;
    trapezoid.load.gear = 2;  // both run in the general kernel
    Scenario table = trapezoid;
    const double first = 60 - flat / 2, last = 60 + flat / 2;
    give_table(table, {first, last, first + 180, last + 180}, {1, 1, -1, -1});
    EXPECT_LT(apart(rows_of(trapezoid), rows_of(table)), 1e-12) << flat;
  }
}

TEST(TableRun, OfSampledHarmonicsApproachesTheirs) {
  Scenario wave = maxon_scenario(control::Mode::duty, 0.6);
  wave.sheet.back_emf = design::BackEmfShape::sine;
  wave.sheet.harmonic_orders = {5};
  wave.sheet.harmonic_sizes = {0.05};
  wave.duration_s = 5e-3;
  Scenario table = wave;
  table.sheet.harmonic_orders.clear();
  table.sheet.harmonic_sizes.clear();
  std::vector<double> angle, value;
  for (int n = 0; n < 240; ++n) {
    angle.push_back(1.5 * n);
    const double x = (1.5 * n - 60) / 180 * base::pi;
    value.push_back(base::cos(x) + 0.05 * base::cos(5 * x));
  }
  give_table(table, angle, value);
  // The chords of 1.5 degrees deviate from the curve by at most 2e-4 of the curve's peak.
  EXPECT_LT(apart(rows_of(wave), rows_of(table)), 2e-3);
}

TEST(TableRun, WithoutSymmetryKeepsItsBooksInStarAndDelta) {
  for (const auto connection : {design::WindingConnection::star, design::WindingConnection::delta}) {
    Scenario s = maxon_scenario(control::Mode::duty, 0.6);
    // The mean of the table over a turn must be zero. The areas of the trapezoids between the points are 63 +
    // 52.5 - 20 - 42 - 35 - 2, so 16.5/360 is subtracted.
    const double mean = 16.5 / 360;
    give_table(s, {10, 80, 150, 200, 260, 330},
               {0.5 - mean, 1.3 - mean, 0.2 - mean, -1.0 - mean, -0.4 - mean, -0.6 - mean});
    s.sheet.connection = connection;
    const auto out = study::run(s);
    ASSERT_TRUE(out) << base::to_string(out.problems()[0]);
    EXPECT_FALSE(out->fault);
    EXPECT_GT(out->energy->supplied, 0.1);
    EXPECT_LT(std::fabs(out->energy->electrical_residual), 1e-13);
    EXPECT_LT(std::fabs(out->energy->mechanical_residual), 1e-13);
  }
}

/// A rotor that coasts with the bridge off. Friction dissipates the energy of the rotor.
Scenario coasting(double viscous, double coulomb_mNm, double iron_viscous, double iron_coulomb_mNm) {
  Scenario s = maxon_scenario(control::Mode::off, 0.0);
  s.sheet.viscous_friction_Nm_s = base::Quantity{viscous, "", ""};
  s.sheet.coulomb_friction_mNm = base::Quantity{coulomb_mNm, "", ""};
  s.sheet.iron_viscous_Nm_s = base::Quantity{iron_viscous, "", ""};
  s.sheet.iron_coulomb_mNm = base::Quantity{iron_coulomb_mNm, "", ""};
  s.initial.speed_rad_s = 300;  // below the speed at which the diodes conduct
  s.duration_s = 3.0;
  return s;
}

TEST(IronDrag, TakesItsShareOfASpinDown) {
  for (const double gear : {1.0, 3.0}) {  // in both kernels
    Scenario viscous = coasting(3e-6, 0, 2e-6, 0);
    viscous.load.gear = gear;
    const auto v = study::run(viscous);
    ASSERT_TRUE(v);
    EXPECT_NEAR(v->energy->iron, 0.4 * v->energy->friction, 1e-14) << "2 of 5";
    Scenario dry = coasting(0, 3, 0, 1);
    dry.load.gear = gear;
    const auto d = study::run(dry);
    ASSERT_TRUE(d);
    const double held = 135e-7 * 300 * 300 / 2;
    EXPECT_NEAR(d->energy->iron, held / 4, 1e-13) << "it comes to rest, and a quarter is the iron's";
    EXPECT_NEAR(d->energy->friction, held, 1e-13);
  }
}

TEST(IronDrag, OfBothKindsIsWhatTheLawsOfASpinDownSay) {
  // The equation J w' = -(B w + T) gives w = (w_0 + T/B) exp(-t B/J) - T/B until the rotor stops at t_1
  // (inertia J, friction B and T). Over this time, the iron dissipates the power B_i w^2 + T_i w.
  const double J = 135e-7, B = 5e-6, T = 2e-3, w_0 = 300, B_i = 2e-6, T_i = 0.5e-3;
  const double rate = B / J, c = T / B, t_1 = base::log((w_0 + c) / c) / rate;
  const double e = base::exp(-rate * t_1), a = w_0 + c;
  const double turned = a * (1 - e) / rate - c * t_1;
  const double square = a * a * (1 - e * e) / (2 * rate) - 2 * a * c * (1 - e) / rate + c * c * t_1;
  const auto out = study::run(coasting(B - B_i, 1e3 * (T - T_i), B_i, 1e3 * T_i));
  ASSERT_TRUE(out);
  ASSERT_LT(t_1, 3.0);
  EXPECT_NEAR(out->energy->iron, B_i * square + T_i * turned, 1e-12);
  EXPECT_NEAR(out->energy->friction, J * w_0 * w_0 / 2, 1e-12);
}

TEST(IronDrag, ChangesNoBitOfARunThatHasTheSameSum) {
  Scenario apart = coasting(3e-6, 1, 2e-6, 1), whole = coasting(3e-6 + 2e-6, 2, 0, 0);
  apart.reference.value = whole.reference.value = 0.5;
  apart.control.mode = whole.control.mode = control::Mode::duty;
  apart.duration_s = whole.duration_s = 0.02;
  const auto a = study::run(apart), w = study::run(whole);
  ASSERT_TRUE(a && w);
  EXPECT_EQ(a->digest, w->digest);
  EXPECT_EQ(w->energy->iron, 0.0);
  EXPECT_GT(a->energy->iron, 0.0);
}

}  // namespace SIXSTEP_TEST_FILE
