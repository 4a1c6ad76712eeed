// SPDX-License-Identifier: Apache-2.0
// The thermal model of two bodies is compared with a numerical integration of its differential equations, and
// with the two exponentials of the textbook.
#include "sixstep/design/sheet/thermal_ranges.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using base::Quantity;
using design::Heating;
using design::Temperatures;
using design::ThermalModel;

constexpr ThermalModel flat{4.5, 4.25, 16.6, 212.0, 125.0};

/// Fourth-order Runge-Kutta for the equations in the header.
Temperatures integrated(const ThermalModel& m, const Heating& h, Temperatures at, double seconds, int steps) {
  const double C_w = m.winding_s / m.winding_housing_K_W, C_h = m.motor_s / m.housing_ambient_K_W;
  using Pair = std::array<double, 2>;
  const auto slope = [&](const Pair& T) {
    const double across = (T[0] - T[1]) / m.winding_housing_K_W;
    return Pair{(h.copper_W * (1 + 0.00393 * (T[0] - 25)) - across) / C_w,
                (across - (T[1] - h.ambient_degC) / m.housing_ambient_K_W + h.housing_W) / C_h};
  };
  const auto ahead = [](const Pair& T, const Pair& k, double dt) {
    return Pair{T[0] + dt * k[0], T[1] + dt * k[1]};
  };
  Pair T{at.winding_degC, at.housing_degC};
  const double dt = seconds / steps;
  for (int n = 0; n < steps; ++n) {
    const Pair k1 = slope(T), k2 = slope(ahead(T, k1, dt / 2)), k3 = slope(ahead(T, k2, dt / 2)),
               k4 = slope(ahead(T, k3, dt));
    for (std::size_t j = 0; j < 2; ++j) T[j] += dt / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]);
  }
  return {T[0], T[1]};
}

TEST(Thermal, ClosedFormIsTheEquationsSolution) {
  // with 400 W the temperature grows without bound
  for (const double copper_W : {0.0, 3.0, 11.0, 40.0, 400.0})
    for (const double seconds : {0.1, 5.0, 60.0, 900.0}) {
      if (copper_W == 400.0 && seconds > 60) continue;  // 1e40 degrees
      const Heating h{copper_W, 1.5, 30.0};
      const Temperatures start{55.0, 40.0};
      const Temperatures exact = design::temperatures_after(flat, h, start, seconds);
      // The error is of fourth order. With steps of at most 1/40 of the fastest time constant, it is
      // (1/40)^4/120 of the change.
      const int steps = 200 + static_cast<int>(seconds * 40 * (1 + copper_W / 100) / 8.0);
      const Temperatures rk4 = integrated(flat, h, start, seconds, steps);
      const double change = std::fabs(exact.winding_degC - 55) + std::fabs(exact.housing_degC - 40) + 1;
      EXPECT_NEAR(exact.winding_degC, rk4.winding_degC, 1e-6 * change) << copper_W << " W " << seconds;
      EXPECT_NEAR(exact.housing_degC, rk4.housing_degC, 1e-6 * change) << copper_W << " W " << seconds;
    }
}

Quantity ranged(double value, double low, double high) {
  Quantity q;
  q.value = value;
  q.range = base::Interval{low, high};
  return q;
}

design::Sheet ranged_sheet() {
  design::Sheet s;
  s.thermal_resistance_winding_housing_K_W = ranged(4.5, 4.0, 5.3);
  s.thermal_resistance_housing_ambient_K_W = ranged(4.25, 3.9, 4.4);
  s.thermal_time_constant_winding_s = ranged(16.6, 11.7, 17.7);
  s.thermal_time_constant_motor_s = ranged(212, 200, 240);
  s.max_winding_temperature_degC = ranged(125, 120, 155);
  return s;
}

/// Each end of a range is tested separately. No end heats the winding more than the ends that are called the
/// worse ends.
TEST(ThermalRanges, TheWorseEndsWarmTheWindingMost) {
  const design::Sheet sheet = ranged_sheet();
  const auto worse = design::at_worse_ends(sheet);
  ASSERT_TRUE(worse);
  EXPECT_EQ(worse->model.max_winding_degC, 120);
  for (const double seconds : {3.0, 30.0, 300.0, 3000.0})
    for (int corner = 0; corner < 16; ++corner) {
      const auto end = [&](const std::optional<Quantity>& q, int bit) {
        return (corner >> bit) % 2 == 0 ? q->range->low : q->range->high;
      };
      const ThermalModel m{end(sheet.thermal_resistance_winding_housing_K_W, 0),
                           end(sheet.thermal_resistance_housing_ambient_K_W, 1),
                           end(sheet.thermal_time_constant_winding_s, 2),
                           end(sheet.thermal_time_constant_motor_s, 3), 125};
      const auto reached = [&](const ThermalModel& of) {
        return design::temperatures_after(of, {7.0, 0.5, 25}, {25, 25}, seconds).winding_degC;
      };
      EXPECT_LE(reached(m), reached(worse->model) + 1e-9) << corner << " after " << seconds << " s";
    }
}

/// With no combination of range ends does the winding reach its limit sooner than with the worse ends. With
/// the sheet's plain values, the winding reaches the limit later.
TEST(ThermalRanges, NoCornerEndsSoonerThanTheWorseEnds) {
  const design::Sheet sheet = ranged_sheet();
  for (const double copper_W : {12.0, 35.0, 560.0}) {
    const design::Heating heating{.copper_W = copper_W};
    const auto times = design::withstand_times(sheet, heating);
    ASSERT_TRUE(times && times->by_values && times->by_worse_ends);
    EXPECT_TRUE(times->differ());
    EXPECT_LT(*times->by_worse_ends, *times->by_values);
    for (int corner = 0; corner < 32; ++corner) {
      design::Sheet at = sheet;
      int bit = 0;
      for (auto* q : {&at.thermal_resistance_winding_housing_K_W, &at.thermal_resistance_housing_ambient_K_W,
                      &at.thermal_time_constant_winding_s, &at.thermal_time_constant_motor_s,
                      &at.max_winding_temperature_degC})
        *q = ranged((corner >> bit++) % 2 == 0 ? (*q)->range->low : (*q)->range->high, 1, 1);
      for (auto* q : {&at.thermal_resistance_winding_housing_K_W, &at.thermal_resistance_housing_ambient_K_W,
                      &at.thermal_time_constant_winding_s, &at.thermal_time_constant_motor_s,
                      &at.max_winding_temperature_degC})
        (*q)->range.reset();
      const auto there = design::withstand_times(at, heating);
      ASSERT_TRUE(there);
      EXPECT_FALSE(there->differ());
      EXPECT_GE(there->by_values.value_or(HUGE_VAL), *times->by_worse_ends * (1 - 1e-9)) << corner;
    }
  }
  design::Sheet without = sheet;
  without.thermal_time_constant_motor_s.reset();
  const auto none = design::withstand_times(without, {.copper_W = 12.0});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.problems().front().where, "thermal_time_constant_motor_s");
}

TEST(ThermalRanges, ARangeWithoutAWorseEndIsNone) {
  design::Sheet sheet = ranged_sheet();
  for (auto* q :
       {&sheet.thermal_resistance_winding_housing_K_W, &sheet.thermal_resistance_housing_ambient_K_W})
    (*q)->value = (*q)->range->high;
  for (auto* q : {&sheet.thermal_time_constant_winding_s, &sheet.thermal_time_constant_motor_s,
                  &sheet.max_winding_temperature_degC})
    (*q)->value = (*q)->range->low;
  EXPECT_FALSE(design::at_worse_ends(sheet));
  sheet.thermal_time_constant_winding_s.reset();
  EXPECT_FALSE(design::at_worse_ends(sheet));
}

/// If a network has k times the resistances and 1/k times the capacities, its time constants are the same.
/// Its temperature rise is k times as large for the same constant loss.
TEST(ThermalRanges, ANetworkScaledAllOverRisesByThatMuchMore) {
  const ThermalModel scaled{4.5 * 1.3, 4.25 * 1.3, 16.6, 212, 125};
  EXPECT_NEAR(design::greater_rise(flat, scaled), 1.3, 1e-12);
  EXPECT_NEAR(design::greater_rise(flat, {4.5, 4.25, 16.6 / 1.5, 212, 125}), 1.5, 1e-12);
}

TEST(Thermal, CoolingIsTheTextbooksTwoExponentials) {
  // Without losses, the two decay rates s are the roots of s^2 + s (1/T_w + 1/T_h + C_w/C_h/T_w) + 1/(T_w
  // T_h) = 0 (time constants T and capacities C of winding w and housing h).
  const long double T_w = 16.6L, T_h = 212.0L, ratio = (16.6L / 4.5L) / (212.0L / 4.25L);
  const long double sum = 1 / T_w + 1 / T_h + ratio / T_w, product = 1 / (T_w * T_h);
  const long double fast = sum / 2 + std::sqrt(sum * sum / 4 - product), slow = product / fast;
  // The initial values are x_w(0) = 80, x_h(0) = 20 and dx_w/dt(0) = -(80 - 20)/T_w.
  const long double slope = -60 / T_w, part = (slope + 80 * slow) / (slow - fast);
  for (const double t : {0.0, 1.0, 17.0, 100.0, 1000.0}) {
    const long double x = part * std::exp(-fast * t) + (80 - part) * std::exp(-slow * t);
    const Temperatures T = design::temperatures_after(flat, {0.0, 0.0, 20.0}, {100.0, 40.0}, t);
    EXPECT_NEAR(T.winding_degC, static_cast<double>(20 + x), 1e-12) << t;
  }
}

TEST(Thermal, RestIsWhereNothingChanges) {
  const Heating h{8.0, 2.0, 25.0};
  const Temperatures rest = *design::steady_temperatures(flat, h);
  const Temperatures later = design::temperatures_after(flat, h, rest, 100.0);
  EXPECT_NEAR(later.winding_degC, rest.winding_degC, 1e-11);
  EXPECT_NEAR(later.housing_degC, rest.housing_degC, 1e-11);
  // All heat leaves through the housing. Its temperature rise is (P hot + P_f) R_ha: copper loss P at 25
  // degC, factor hot for the warm winding, friction loss P_f, thermal resistance R_ha.
  const double hot = 8.0 * (1 + 0.00393 * (rest.winding_degC - 25));
  EXPECT_NEAR(rest.housing_degC, 25 + (hot + 2) * 4.25, 1e-11);
  EXPECT_NEAR(rest.winding_degC, rest.housing_degC + hot * 4.5, 1e-11);
}

TEST(Thermal, GrowingResistanceRunsAwayAboveOneOverAR) {
  const double edge = 1 / (0.00393 * (4.5 + 4.25));
  EXPECT_TRUE(design::steady_temperatures(flat, {edge * 0.999}));
  EXPECT_FALSE(design::steady_temperatures(flat, {edge * 1.001}));
}

TEST(Thermal, ContinuousLossTakesTheWindingToItsLimit) {
  for (const double ambient : {-20.0, 25.0, 80.0}) {
    const double copper = design::continuous_copper_W(flat, 1.0, ambient);
    EXPECT_NEAR(design::steady_temperatures(flat, {copper, 1.0, ambient})->winding_degC, 125.0, 1e-11);
  }
  // The loss satisfies maxon's formula I^2 R (1 + a (T_max - 25)) (R_wh + R_ha) = T_max - T_a.
  EXPECT_NEAR(design::continuous_copper_W(flat, 0.0, 25.0), 100 / (4.5 + 4.25) / (1 + 0.393), 1e-13);
  EXPECT_EQ(design::continuous_copper_W(flat, 0.0, 125.0), 0.0);
  EXPECT_EQ(design::continuous_copper_W(flat, 50.0, 25.0), 0.0) << "50 W of friction alone are too much";
}

TEST(Thermal, ShortTimeLossReachesTheLimitJustThen) {
  double before = 1e9;
  for (const double seconds : {1.0, 10.0, 60.0, 1000.0}) {
    const double copper = design::short_time_copper_W(flat, 1.0, 40.0, seconds);
    EXPECT_NEAR(*design::permissible_seconds(flat, {copper, 1.0, 40.0}), seconds, 1e-9 * seconds);
    EXPECT_LT(copper, before);
    EXPECT_GT(copper, design::continuous_copper_W(flat, 1.0, 40.0));
    before = copper;
  }
  // In a very short time, only the heat capacity C_w of the winding has an effect. The temperature rise is P
  // t/C_w, with ln(1 + a dT)/a instead of dT, because the resistance of the copper rises with the
  // temperature.
  const double C_w = 16.6 / 4.5, t = 1e-3;
  EXPECT_NEAR(design::short_time_copper_W(flat, 0.0, 25.0, t) * t / C_w, std::log1p(0.00393 * 100) / 0.00393,
              0.01);
}

TEST(Thermal, PermissibleTime) {
  EXPECT_FALSE(design::permissible_seconds(flat, {1.0, 0.0, 25.0})) << "for ever";
  EXPECT_EQ(design::permissible_seconds(flat, {1.0, 0.0, 125.0}), 0.0);
  EXPECT_LT(*design::permissible_seconds(flat, {560.0, 0.0, 25.0}), 1.0) << "stall of the 251601";
}

/// From the temperatures on the way, what is left of the time is left, also after a pause that let the winding cool.
TEST(Thermal, PermissibleTimeFromAStart) {
  const design::Heating heating{40.0, 1.0, 40.0};
  const double whole = *design::permissible_seconds(flat, heating);
  for (const double part : {0.1, 0.6, 0.99}) {
    const auto there = design::temperatures_after(flat, heating, {40.0, 40.0}, part * whole);
    EXPECT_NEAR(*design::permissible_seconds(flat, heating, there), (1 - part) * whole, 1e-9 * whole) << part;
  }
  // A hot winding on a cold housing cools first, and is too hot in the end.
  const double low = 1.02 * design::continuous_copper_W(flat, 0.0, 25.0);
  const design::Temperatures hot{124.0, 25.0};
  const double late = *design::permissible_seconds(flat, {low, 0.0, 25.0}, hot);
  EXPECT_GT(late, 100.0);
  EXPECT_NEAR(design::temperatures_after(flat, {low, 0.0, 25.0}, hot, late).winding_degC, 125.0, 1e-6);
  EXPECT_EQ(design::permissible_seconds(flat, heating, {125.0, 40.0}), 0.0);
}

TEST(Thermal, ASheetWithoutItsThermalLinesSaysWhichAreMissing) {
  design::Sheet sheet = sixstep::testing::maxon_sheet();
  base::Result<ThermalModel> none = design::thermal_model(sheet);
  ASSERT_FALSE(none);
  EXPECT_NE(none.problems()[0].where.find("thermal_resistance_winding_housing_K_W"), std::string::npos);
  const auto given = [](double value) { return base::Quantity{value, "", ""}; };
  sheet.thermal_resistance_winding_housing_K_W = given(4.5);
  sheet.thermal_resistance_housing_ambient_K_W = given(4.25);
  sheet.thermal_time_constant_winding_s = given(16.6);
  sheet.max_winding_temperature_degC = given(125);
  none = design::thermal_model(sheet);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.problems()[0].where, "thermal_time_constant_motor_s");
  sheet.thermal_time_constant_motor_s = given(212);
  ASSERT_TRUE(design::thermal_model(sheet));
  EXPECT_EQ(design::thermal_model(sheet)->motor_s, 212.0);
  sheet.thermal_time_constant_motor_s = given(0);
  EXPECT_FALSE(design::thermal_model(sheet));
}

}  // namespace SIXSTEP_TEST_FILE
