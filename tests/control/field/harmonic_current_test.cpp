// SPDX-License-Identifier: Apache-2.0
// Currents that follow the shape of a back-EMF are compared with the closed form for a trapezoid with a flat
// top of 120 degrees.
#include "sixstep/control/field/harmonic_current.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sixstep/control/field/field_drive.hpp"
#include "sixstep/control/frames.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

constexpr double pi = std::numbers::pi;
/// Peak of the trapezoid's fundamental: 4/pi sin(h)/h. The ramp from the top to zero is h = pi/6.
const double fundamental = 4 / pi * std::sin(pi / 6) / (pi / 6);

/// Back-EMF shape of one phase at x, in rad from the middle of its flat top.
double trapezoid(double x) {
  x = std::fabs(std::remainder(x, 2 * pi));
  return std::clamp((pi / 2 - x) / (pi / 6), -1.0, 1.0);
}

/// The shape vector g of the three phases in the magnet's frame, if the magnet is in the direction `magnet`,
/// in rad. The top of phase a is a quarter turn before the magnet's axis.
Dq<double> exact(double magnet) {
  const Abc<double> f{trapezoid(magnet + pi / 2), trapezoid(magnet + pi / 2 - 2 * pi / 3),
                      trapezoid(magnet + pi / 2 - 4 * pi / 3)};
  const Dq<double> g = park(clarke(f), Direction<double>{std::cos(magnet), std::sin(magnet)});
  return {g.d / fundamental, g.q / fundamental};
}

template <class Scalar>
HarmonicCurrentConfig<Scalar> of_the_trapezoid() {
  HarmonicCurrentConfig<Scalar> c;
  c.on = true;
  // The end of the shape vector moves along the sides of a hexagon. The least length of the vector is the
  // radius of the inscribed circle.
  c.least = static_cast<Scalar>(2 / std::numbers::sqrt3 / fundamental);
  for (int n = 0; n < shape_points; ++n) {
    const Dq<double> g = exact(n * pi / 3 / shape_points);
    c.shape[n] = {static_cast<Scalar>(g.d), static_cast<Scalar>(g.q)};
  }
  return c;
}

template <class Scalar>
class HarmonicCurrent : public ::testing::Test {};
using Floats = ::testing::Types<double, float>;
TYPED_TEST_SUITE(HarmonicCurrent, Floats);

/// Straight lines between points at the distance D differ from g by at most D^2/8 times the largest |g''|.
/// For this shape, the largest |g''| is 1.6.
constexpr double met = 1.6 * (pi / 96) * (pi / 96) / 8;

template <class Scalar>
constexpr double eps = std::numeric_limits<Scalar>::epsilon();

constexpr int angles = 7 * 1024;
BinaryAngle angle_of(int n) {
  return static_cast<BinaryAngle>(std::int64_t{n} * (std::int64_t{1} << 32) / angles);
}

TYPED_TEST(HarmonicCurrent, TheTableMeetsTheShapeEverywhere) {
  const auto c = of_the_trapezoid<TypeParam>();
  for (int n = 0; n < angles; ++n) {
    const Dq<double> g = exact(2 * pi * n / angles);
    const Dq<TypeParam> table = shape_at(c, angle_of(n));
    EXPECT_NEAR(static_cast<double>(table.d), g.d, met + 4 * eps<TypeParam>);
    EXPECT_NEAR(static_cast<double>(table.q), g.q, met + 4 * eps<TypeParam>);
  }
}

/// The torque T = 3/2 p psi (g . i) is equal to the torque of I at every angle (symbols of model.md). An
/// error of the table changes the torque by the relative error of |g|. A rotation of g has no effect of first
/// order.
TYPED_TEST(HarmonicCurrent, TheTorqueIsTheSameAtEveryAngleAndTheCurrentTheShortest) {
  const auto c = of_the_trapezoid<TypeParam>();
  const double I = 4.0;
  double square = 0.0;
  for (int n = 0; n < angles; ++n) {
    const Dq<double> g = exact(2 * pi * n / angles);
    const Dq<TypeParam> i =
        harmonic_current(c, angle_of(n), TypeParam{}, static_cast<TypeParam>(I), TypeParam{});
    const double d = static_cast<double>(i.d), q = static_cast<double>(i.q);
    EXPECT_NEAR(g.d * d + g.q * q, I, I * (2 * met + 8 * eps<TypeParam>));
    const double shortest = I / std::hypot(g.d, g.q);
    EXPECT_NEAR(std::hypot(d, q), shortest, shortest * (2 * met + 8 * eps<TypeParam>));
    square += (d * d + q * q) / angles;
  }
  // The copper loss, relative to a sine current, is f_1^2 times the mean of 1/|f|^2 over x = -1..1, with
  // |f|^2 = 4/3 + 4 x^2/9 and the fundamental f_1. The mean gives f_1^2 sqrt 3 pi/8. This is 0.55 % more than
  // the loss of the constant i_q with the same mean torque.
  const double copper = fundamental * fundamental * std::numbers::sqrt3 * pi / 8;
  EXPECT_NEAR(copper, 1.0055, 1e-4);
  EXPECT_NEAR(square / (I * I), copper, 4 * met + 8 * eps<TypeParam>);
}

/// The torque of a constant i_q is proportional to g_q. In the middle of a hexagon's side, g_q is 2/sqrt 3;
/// at a corner, it is 4/3.
TYPED_TEST(HarmonicCurrent, WithoutItTheTorqueSwingsAsTheShapeDoes) {
  const auto c = of_the_trapezoid<TypeParam>();
  double least = 2.0, most = 0.0;
  for (int n = 0; n < angles; ++n) {
    const double q = static_cast<double>(shape_at(c, angle_of(n)).q);
    least = std::fmin(least, q);
    most = std::fmax(most, q);
  }
  EXPECT_NEAR(least, 2 / std::numbers::sqrt3 / fundamental, met);
  EXPECT_NEAR(most, 4.0 / 3 / fundamental, met);
}

TYPED_TEST(HarmonicCurrent, ASineGetsWhatItHadWithoutIt) {
  HarmonicCurrentConfig<TypeParam> c;
  for (auto& g : c.shape) g.q = 1;
  for (int n = 0; n < 64; ++n) {
    const Dq<TypeParam> i =
        harmonic_current(c, angle_of(n * 97), TypeParam(300), TypeParam(4), TypeParam(-3));
    EXPECT_EQ(i.q, TypeParam(4));
    EXPECT_EQ(i.d, TypeParam(-3));
  }
}

/// The weakening current is perpendicular to the shape vector g and produces no torque. Its sum with the
/// torque-producing current stays within the limit, because the member `least` is a lower bound of |g|.
TYPED_TEST(HarmonicCurrent, AWeakenedFieldChangesNoTorque) {
  const auto c = of_the_trapezoid<TypeParam>();
  const double limit = 5.0, weakening = -3.0;
  const double I = static_cast<double>(c.least) * std::sqrt(limit * limit - weakening * weakening);
  double along = 0.0;
  for (int n = 0; n < angles; ++n) {
    const Dq<double> g = exact(2 * pi * n / angles);
    const Dq<TypeParam> i = harmonic_current(c, angle_of(n), TypeParam{}, static_cast<TypeParam>(I),
                                             static_cast<TypeParam>(weakening));
    const double d = static_cast<double>(i.d), q = static_cast<double>(i.q);
    EXPECT_NEAR(g.d * d + g.q * q, I, 8 * (met + eps<TypeParam>));
    EXPECT_LE(std::hypot(d, q), limit * (1 + 2 * met + 8 * eps<TypeParam>));
    along += d / angles;
  }
  EXPECT_NEAR(along, weakening, 0.01 * std::fabs(weakening)) << "the turn of g takes up to 0.6 % of it";
}

/// The drive uses the shape at a later angle of the magnet: the angle that is reached after the time `lead`.
/// The test has both directions of rotation.
TYPED_TEST(HarmonicCurrent, TheAngleIsThatOfTheCurrentToCome) {
  auto c = of_the_trapezoid<TypeParam>();
  c.lead_rad_s = static_cast<TypeParam>(2e-3);
  for (const double w : {-200.0, 60.0}) {
    const auto then = static_cast<BinaryAngle>(static_cast<std::int64_t>(w * 2e-3 / (2 * pi) * 4294967296.0));
    for (int n = 0; n < 256; ++n) {
      const Dq<TypeParam> a =
          harmonic_current(c, angle_of(n * 28), static_cast<TypeParam>(w), TypeParam(2), TypeParam{});
      const Dq<TypeParam> b =
          harmonic_current(c, angle_of(n * 28) + then, TypeParam{}, TypeParam(2), TypeParam{});
      EXPECT_NEAR(static_cast<double>(a.d), static_cast<double>(b.d), 1e-5);
      EXPECT_NEAR(static_cast<double>(a.q), static_cast<double>(b.q), 1e-5);
    }
  }
}

/// The types double and float give the same current, within the rounding of float.
TEST(HarmonicCurrents, DoubleAndFloatAgree) {
  const auto wide = of_the_trapezoid<double>();
  const auto narrow = of_the_trapezoid<float>();
  for (int n = 0; n < angles; ++n) {
    const Dq<double> a = harmonic_current(wide, angle_of(n), 0.0, 7.5, -1.5);
    const Dq<float> b = harmonic_current(narrow, angle_of(n), 0.0f, 7.5f, -1.5f);
    EXPECT_NEAR(a.d, static_cast<double>(b.d), 7.5 * 8 * eps<float>);
    EXPECT_NEAR(a.q, static_cast<double>(b.q), 7.5 * 8 * eps<float>);
  }
}

/// The feed-forward uses the back-EMF's shape at the instant at which the voltage acts. If the current is at
/// its reference, no other voltage is needed.
TYPED_TEST(HarmonicCurrent, TheDriveFeedsTheShapeForward) {
  FieldDriveConfig<TypeParam> c;
  c.drive.mode = Mode::current;
  c.current.decouples = true;
  c.current.magnet_V_s = TypeParam(0.02);
  c.harmonic = of_the_trapezoid<TypeParam>();
  c.advance.rad_s = TypeParam(6e-4);
  FieldDriveState<TypeParam> state;
  Telemetry<TypeParam> telemetry;
  const TypeParam w(100);
  for (int n = 0; n < 360; ++n) {
    FieldDriveInput<TypeParam> in;
    in.measured.bus_V = TypeParam(24);
    in.measured.speed_rad_s = w;
    in.magnet = field_directions(c.advance, binary_degrees(n), w);
    field_drive_step(c, state, in, Setpoint<TypeParam>{}, telemetry);
    const Dq<double> g = exact((n - 150) * pi / 180 + 0.06);
    EXPECT_NEAR(static_cast<double>(state.current.voltage.d), 2 * g.d, 2 * met + 1e-6);
    EXPECT_NEAR(static_cast<double>(state.current.voltage.q), 2 * g.q, 2 * met + 1e-6);
  }
}

}  // namespace SIXSTEP_TEST_FILE
