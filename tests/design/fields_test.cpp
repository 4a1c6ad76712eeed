// SPDX-License-Identifier: Apache-2.0
// The lists of a configuration's fields contain every member.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>

#include "sixstep/control/fixed.hpp"
#include "sixstep/design/fields/estimator_fields.hpp"
#include "sixstep/design/fields/product_fields.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::control;

/// Sets each visited member to 0.
struct Clear {
  static constexpr bool when_run(bool) { return true; }
  static constexpr bool when_on(bool) { return true; }
  void clear(auto& kept) const { std::memset(static_cast<void*>(&kept), 0, sizeof kept); }
  void flag(const design::Field&, auto, auto& kept) const { clear(kept); }
  void choice(const design::Field&, auto, auto& kept, auto) const { clear(kept); }
  void count(const design::Field&, auto, auto& kept, auto) const { clear(kept); }
  void signal(const design::Field&, double, auto& kept, design::Base) const { clear(kept); }
  void threshold(const design::Field&, double, auto& kept, design::Base) const { clear(kept); }
  void gain(const design::Field&, double, auto& kept, design::Ratio) const { clear(kept); }
  void raw_gain(const design::Field&, double, auto& kept, design::Base) const { clear(kept); }
  void divisor(const design::Field&, double, auto& kept, design::Base) const { clear(kept); }
  void sum(const design::Field&, double, auto& kept, design::Base) const { clear(kept); }
  void ticks(const design::Field&, double, auto& kept, design::Base) const { clear(kept); }
  void part(const char*, const auto& designed, auto& kept, const auto&... told) const {
    design::fields(*this, designed, kept, told...);
  }
};

#if defined(__GNUC__) && !defined(__clang__)

/// Sets all bytes of the members to 0xff and the padding to 0.
template <class Config>
void fill(Config& config) {
  std::memset(static_cast<void*>(&config), 0xff, sizeof config);
  __builtin_clear_padding(&config);
}
/// Fills each member separately. After an array of structs, GCC 12 clears a region of the array's length at a
/// wrong address.
template <class Scalar>
void fill(FieldDriveConfig<Scalar>& config) {
  std::memset(static_cast<void*>(&config), 0, sizeof config);
  auto& [drive, current, weakening, per_ampere, advance, harmonic, finite_set] = config;
  fill(drive);
  fill(current);
  fill(weakening);
  fill(per_ampere);
  fill(advance);
  fill(harmonic);
  fill(finite_set);
}

template <class Config, class Walked>
void expect_all_walked(const Walked& walked) {
  Config config;
  fill(config);
  walked(config);
  std::byte left[sizeof config];
  std::memcpy(left, static_cast<const void*>(&config), sizeof config);
  for (std::size_t n = 0; n < sizeof config; ++n) EXPECT_EQ(left[n], std::byte{}) << "byte " << n;
}

template <class Scalar>
void expect_every_member() {
  expect_all_walked<DriveConfig<Scalar>>([](auto& c) { design::fields(Clear{}, DriveConfig<double>{}, c); });
  expect_all_walked<ProtectedConfig<Scalar>>([](auto& c) {
    design::fields(Clear{}, DriveConfig<double>{}, c.drive);
    design::fields(Clear{}, ProtectedConfig<double>{}, c);
  });
  expect_all_walked<FieldDriveConfig<Scalar>>([](auto& c) {
    design::fields(Clear{}, DriveConfig<double>{}, c.drive);
    design::fields(Clear{}, FieldDriveConfig<double>{}, c);
  });
  if constexpr (std::is_floating_point_v<Scalar>)
    expect_all_walked<EstimatorConfig<Scalar>>(
        [](auto& c) { design::fields(Clear{}, EstimatorConfig<double>{}, c); });
}

TEST(Fields, AreEveryMemberOfAConfiguration) {
  expect_every_member<double>();
  expect_every_member<float>();
  expect_every_member<Q15>();
  expect_every_member<Q31>();
}

#endif

/// All members are converted, including the values of loops that the mode does not use, and of extras that
/// are off.
TEST(Fields, AsFloatTakesThemAll) {
  DriveConfig<double> d;
  d.mode = Mode::speed;
  d.current = {4.25, -3.5, 24.0};
  d.position_gain = 0.75;
  d.extras.limits.A_per_V = 5.25;
  d.extras.speed.K_c = -0.125;
  DriveConfig<float> f;
  design::fields(design::AsFloat{}, d, f);
  EXPECT_EQ(f.mode, Mode::speed);
  EXPECT_EQ(f.current.d0, -3.5f);
  EXPECT_EQ(f.position_gain, 0.75f);
  EXPECT_EQ(f.extras.limits.A_per_V, 5.25f);
  EXPECT_EQ(f.extras.speed.K_c, -0.125f);
}

}  // namespace SIXSTEP_TEST_FILE
