// SPDX-License-Identifier: Apache-2.0
// Tests the currents that the available voltage can maintain. A reachable reference is unchanged. For any
// other reference, the result is as close to the reference as possible.
#include "sixstep/control/field/reachable_current.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

template <class Scalar>
double number(Scalar x) {
  return static_cast<double>(x);
}

template <class Scalar>
class ReachableCurrent : public ::testing::Test {};
TYPED_TEST_SUITE(ReachableCurrent, SensingScalars);

/// Values relative to the bases. The resistance R and the reactance w p L are below 1.
template <class Scalar>
FieldCurrentConfig<Scalar> machine() {
  FieldCurrentConfig<Scalar> c;
  c.d_V_s_A = c.q_V_s_A = Gain<Scalar>(0.5);
  c.magnet_V_s = Gain<Scalar>(0.6);
  c.R_ohm = Gain<Scalar>(0.1);
  return c;
}

double length_of(const FieldCurrentConfig<double>& c, const Dq<double>& i, double w) {
  const Dq<double> v = holding_voltage(c, i, w);
  return std::hypot(v.d, v.q);
}

/// Each product of numbers below 1 has an error of one digit. After the division by |Z|^2 >= 0.04 and by |v|,
/// the error is at most some hundred digits.
TYPED_TEST(ReachableCurrent, ItNeedsNoMoreVoltageThanThereIs) {
  const auto c = machine<TypeParam>();
  const auto exact = machine<double>();
  const double most = 0.5 / std::numbers::sqrt3;
  for (const double w : {-0.9, -0.6, -0.2, 0.4, 0.7, 0.9})
    for (const double d : {-0.3, 0.0})
      for (const double q : {-0.5, -0.1, 0.0, 0.2, 0.6}) {
        const Dq<TypeParam> i =
            reachable_current(c, Dq<TypeParam>{TypeParam(d), TypeParam(q)}, TypeParam(w), TypeParam(0.5));
        if (length_of(exact, {d, q}, w) < most * (1 - 1e-3)) {
          EXPECT_EQ(i.d, TypeParam(d)) << w;
          EXPECT_EQ(i.q, TypeParam(q)) << w;
        } else {
          EXPECT_LE(length_of(exact, {number(i.d), number(i.q)}, w), most + 100 * digit<TypeParam>())
              << w << ' ' << d << ' ' << q;
        }
      }
}

/// A back-EMF E above the voltage limit V causes a current of at least (|E| - V)/|Z| in the impedance Z. With
/// a zero reference, the current is equal to this value.
TYPED_TEST(ReachableCurrent, BeyondTheBusTheLeastCurrentFlows) {
  for (const double w : {-0.9, 0.7}) {
    const Dq<TypeParam> i =
        reachable_current(machine<TypeParam>(), Dq<TypeParam>{}, TypeParam(w), TypeParam(0.5));
    const double least = (0.6 * std::fabs(w) - 0.5 / std::numbers::sqrt3) / std::hypot(0.1, 0.5 * w);
    EXPECT_NEAR(std::hypot(number(i.d), number(i.q)), least, 100 * digit<TypeParam>());
    EXPECT_LT(number(i.d), 0.0) << "against the magnet";
  }
}

struct Drawn {
  FieldCurrentConfig<double> c;
  Dq<double> wanted;
  double w = 0.0, bus = 1.0, most = 0.0;
};

Drawn drawn(std::mt19937& random) {
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  const auto decades = [&](double a, double b) { return a * std::pow(b / a, between(0, 1)); };
  Drawn x;
  x.c.magnet_V_s = decades(1e-3, 1);
  x.most = x.bus / std::numbers::sqrt3;
  const double w_0 = x.most / x.c.magnet_V_s, ratio = decades(0.1, 50);
  x.w = w_0 * between(-2, 2);
  x.c.R_ohm = decades(1e-3, 1);
  x.c.d_V_s_A = x.c.q_V_s_A = ratio * x.c.R_ohm / w_0;
  const double I = x.c.magnet_V_s / x.c.d_V_s_A;
  x.wanted = {between(-0.9, 0) * I, between(-1.5, 1.5) * I};
  return x;
}

/// A projection does not increase the distance between two points. Therefore the resulting current i' obeys
/// |i'| <= |i| + the least possible current. If i_d is unchanged, the torque-producing current becomes
/// smaller but never changes its sign.
TEST(ReachableCurrentLaw, ItIsNoLongerThanTheReferenceAndTheLeastCurrentTogether) {
  const unsigned seed = 20261127;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  int moved = 0, beyond = 0;
  for (int n = 0; n < 20000; ++n) {
    const Drawn x = drawn(random);
    const Dq<double> i = reachable_current(x.c, x.wanted, x.w, x.bus);
    const double E = std::fabs(x.w) * x.c.magnet_V_s,
                 least = std::max(0.0, (E - x.most) / std::hypot(x.c.R_ohm, x.w * x.c.d_V_s_A)),
                 asked = std::hypot(x.wanted.d, x.wanted.q);
    ASSERT_LE(length_of(x.c, i, x.w), x.most * (1 + 1e-9) + 1e-12);
    ASSERT_LE(std::hypot(i.d, i.q), (asked + least) * (1 + 1e-9));
    if (i.d == x.wanted.d) {
      ASSERT_GE(i.q * x.wanted.q, 0.0);
    }
    moved += i.q != x.wanted.q;
    beyond += least > 0;
  }
  EXPECT_GT(moved, 1000);
  EXPECT_GT(beyond, 1000);
}

/// For a braked round rotor, the resulting current is the closest possible one: no point of a fine polar grid
/// over the disc of possible currents is closer.
TEST(ReachableCurrentLaw, ABrakedRotorGetsTheNearestCurrent) {
  std::mt19937 random(7);
  int tried = 0;
  while (tried < 200) {
    Drawn x = drawn(random);
    x.wanted.q = std::copysign(x.wanted.q, -x.w);
    if (length_of(x.c, x.wanted, x.w) <= x.most) continue;
    ++tried;
    const Dq<double> i = reachable_current(x.c, x.wanted, x.w, x.bus);
    const double R = x.c.R_ohm, X = x.w * x.c.d_V_s_A, E = x.w * x.c.magnet_V_s, square = R * R + X * X;
    const double off = std::hypot(i.d - x.wanted.d, i.q - x.wanted.q);
    for (int n = 0; n < 3600; ++n) {
      const double angle = n * std::numbers::pi / 1800, v_d = x.most * std::cos(angle),
                   v_q = x.most * std::sin(angle) - E;
      const double d = (R * v_d + X * v_q) / square, q = (R * v_q - X * v_d) / square;
      ASSERT_LE(off, std::hypot(d - x.wanted.d, q - x.wanted.q) * (1 + 1e-9) + 1e-12);
    }
  }
}

}  // namespace SIXSTEP_TEST_FILE
