// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/scaling/product_scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::control;

/// The product drive of docs/reference/fixed-point.md, in double precision.
ProtectedConfig<double> product() {
  ProtectedConfig<double> c;
  c.drive.mode = Mode::speed;
  c.drive.current = {4.0956, -3.6940, 24.0};
  c.drive.nominal_bus_V = 24.0;
  c.drive.speed = {0.0158299, -0.0156961, 1.0};
  c.drive.current_at_full_torque_A = 0.78 / 0.0335;
  c.drive.current_limit_A = 10.0;
  c.setpoint_limit = 700.0;
  for (AdcConfig<double>& adc : c.current_adc) adc = {40.0 / 4096 / 8, 2048, 40, 6};
  c.bus_adc = {40.0 / 4096 / 8, 0, 0, 0};
  c.speed = {1.0471975511965976 / 8 * 1e6, 100000, 6};
  c.faults = {15, 30, 10, 800, 8, 3000, 3};
  c.brake_current_A = 5;
  c.short_below_rad_s = 100;
  c.standing_rad_s = 5;
  return c;
}
constexpr design::OperatingRange range{.current_A = 20.1, .speed_rad_s = 850, .bus_V = 40, .setpoint = 700};

template <class Scalar>
class ProductScaling : public ::testing::Test {};
using Formats = ::testing::Types<Q15, Q31, Q14, Fixed<std::int32_t, 29>>;
TYPED_TEST_SUITE(ProductScaling, Formats);

TYPED_TEST(ProductScaling, CountsAndEdgesReadTheSameAsInDouble) {
  using S = TypeParam;
  const ProtectedConfig<double> exact = product();
  const auto scaled = design::scaled_product<S>(exact, range, 12);
  ASSERT_TRUE(scaled) << base::to_string(scaled.problems()[0]);
  const ProtectedConfig<S>& c = scaled->config;
  const design::Bases& b = scaled->bases;
  const double digit = static_cast<double>(S::from_raw(1)), gains = std::ldexp(1.0, 1 - 8 * int{sizeof(S)});
  for (int counts = 0; counts < 4096; ++counts) {
    const auto n = static_cast<std::uint16_t>(counts);
    const double i = adc_value(exact.current_adc[0], AdcState{}, n),
                 u = adc_value(exact.bus_adc, AdcState{}, n);
    // The tolerance is the value times the relative rounding of the gain, plus half a digit.
    EXPECT_NEAR(static_cast<double>(adc_value(c.current_adc[0], AdcState{}, n)) * b.current_A, i,
                gains * std::fabs(i) + digit / 2 * b.current_A * 1.0001);
    EXPECT_NEAR(static_cast<double>(adc_value(c.bus_adc, AdcState{}, n)) * b.voltage_V, u,
                gains * u + digit / 2 * b.voltage_V * 1.0001);
  }
  for (const std::uint32_t ticks : {160u, 654u, 13090u}) {
    HallSpeedState d, f;
    for (std::uint32_t k = 0; k < 9; ++k) {
      hall_speed_edge(d, k * ticks, -1);
      hall_speed_edge(f, k * ticks, -1);
    }
    EXPECT_NEAR(static_cast<double>(hall_speed(c.speed, f, 8 * ticks)) * b.speed_rad_s,
                hall_speed(exact.speed, d, 8 * ticks), digit * b.speed_rad_s);
  }
  EXPECT_NEAR(static_cast<double>(c.faults.over_current_A) * b.current_A, 15, digit * b.current_A);
  EXPECT_NEAR(static_cast<double>(c.setpoint_limit) * b.speed_rad_s, 700, digit * b.speed_rad_s);
}

bool names(const base::Problems& problems, const std::string& where) {
  for (const base::Problem& p : problems)
    if (p.where == where && !p.limit.empty() && !p.cure.empty()) return true;
  return false;
}

TYPED_TEST(ProductScaling, WhatCannotWorkIsNamed) {
  using S = TypeParam;
  const auto expect = [](const char* where, const ProtectedConfig<double>& p, const design::OperatingRange& r,
                         int bits) {
    const auto scaled = design::scaled_product<S>(p, r, bits);
    ASSERT_FALSE(scaled) << where;
    EXPECT_TRUE(names(scaled.problems(), where)) << where;
  };
  ProtectedConfig<double> p = product();
  p.faults.over_current_A = 31;  // the limits of bases_for() are 20.1 A and a reference of 10 A
  expect("faults.over_current_A", p, range, 12);
  p = product();
  p.bus_adc.per_eighth *= 2;  // reads up to 80 V
  expect("bus_adc", p, range, 12);
  if (sizeof(S) == 2) {
    p = product();
    expect("current_adc a", p, range, 16);  // 16 bits in eighths exceed the range
    p.speed.sector_rad_s_ticks *= 1000;     // a timer of 1 GHz
    expect("speed.sector_rad_s_ticks", p, range, 12);
  }
}

}  // namespace SIXSTEP_TEST_FILE
