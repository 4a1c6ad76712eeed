// SPDX-License-Identifier: Apache-2.0
// The blocks of the field-oriented drive are compared with their equations, in floating point and in fixed
// point.
#include "sixstep/control/field/field_current.hpp"

#include <cmath>
#include <numbers>

#include "sixstep/control/field/field_direction.hpp"
#include "sixstep/control/field/field_weakening.hpp"
#include "sixstep/control/field/torque_per_ampere.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<FieldCurrentState<Q15>> &&
              std::is_aggregate_v<FieldCurrentConfig<double>>);

template <class Scalar>
double number(Scalar x) {
  return static_cast<double>(x);
}

template <class Scalar>
class FieldBlocks : public ::testing::Test {};
TYPED_TEST_SUITE(FieldBlocks, SensingScalars);

/// Gains of order 1 relative to the bases, as in the scaled drive of a chip.
template <class Scalar>
FieldCurrentConfig<Scalar> decoupled(VoltageLimit limit) {
  FieldCurrentConfig<Scalar> c;
  c.d = pi<Scalar>(0.4, 0.1, 0.3);
  c.q = pi<Scalar>(0.5, 0.1, 0.2);
  c.limit = limit;
  c.decouples = true;
  c.d_V_s_A = Gain<Scalar>(0.3);
  c.q_V_s_A = Gain<Scalar>(0.5);
  c.magnet_V_s = Gain<Scalar>(0.25);
  return c;
}

TYPED_TEST(FieldBlocks, TurningMakesTheVoltagesOfTheEquations) {
  const FieldCurrentConfig<TypeParam> c = decoupled<TypeParam>(VoltageLimit::circle);
  for (const double w : {-0.8, 0.0, 0.4})
    for (const double i_d : {-0.5, 0.3})
      for (const double i_q : {-0.7, 0.6}) {
        const Dq<TypeParam> e =
            turning_voltage(c, Dq<TypeParam>{TypeParam(i_d), TypeParam(i_q)}, TypeParam(w));
        EXPECT_NEAR(number(e.d), -w * 0.5 * i_q, 4 * digit<TypeParam>());
        EXPECT_NEAR(number(e.q), w * (0.3 * i_d + 0.25), 4 * digit<TypeParam>());
      }
}

/// Without a current error, the output is only the feed-forward voltage e.
TYPED_TEST(FieldBlocks, WithoutAnErrorTheAnswerIsWhatTurningMakes) {
  const FieldCurrentConfig<TypeParam> c = decoupled<TypeParam>(VoltageLimit::circle);
  FieldCurrentState<TypeParam> state;
  const Dq<TypeParam> i{TypeParam(-0.2), TypeParam(0.4)};
  const Dq<TypeParam> v = field_current_step(c, state, i, i, TypeParam(0.5), TypeParam(0.9));
  const Dq<TypeParam> e = turning_voltage(c, i, TypeParam(0.5));
  EXPECT_NEAR(number(v.d), number(e.d), digit<TypeParam>());
  EXPECT_NEAR(number(v.q), number(e.q), digit<TypeParam>());
}

TYPED_TEST(FieldBlocks, TheVectorStaysWithinTheCircleAndDComesFirst) {
  const FieldCurrentConfig<TypeParam> c = decoupled<TypeParam>(VoltageLimit::circle);
  FieldCurrentState<TypeParam> state;
  const double circle = 0.9 / std::numbers::sqrt3;
  for (int n = 0; n < 200; ++n) {
    const double side = n / 50 % 2 == 0 ? 0.45 : -0.45;
    const Dq<TypeParam> v = field_current_step(c, state, Dq<TypeParam>{TypeParam(-0.45), TypeParam(side)},
                                               Dq<TypeParam>{}, TypeParam(0.6), TypeParam(0.9));
    EXPECT_LE(std::hypot(number(v.d), number(v.q)), circle + 4 * digit<TypeParam>());
  }
  EXPECT_NEAR(number(state.voltage.d), -circle, 4 * digit<TypeParam>()) << "all of it holds the field down";
  // At q = 0, the voltage circle is parallel to the q axis. An error of one digit in d therefore causes an
  // error of about sqrt(2 digits) in q.
  EXPECT_NEAR(number(state.voltage.q), 0.0, 3 * std::sqrt(digit<TypeParam>()));
}

/// The bound of an axis depends on the voltage of the other axis. The PI stores the limited value, so the
/// first error of the opposite sign leaves the limit at once.
TYPED_TEST(FieldBlocks, NoAxisWindsUp) {
  for (const VoltageLimit limit : {VoltageLimit::axes, VoltageLimit::circle}) {
    const FieldCurrentConfig<TypeParam> c = decoupled<TypeParam>(limit);
    FieldCurrentState<TypeParam> state;
    const auto step = [&](double q) {
      return field_current_step(c, state, Dq<TypeParam>{TypeParam{}, TypeParam(q)}, Dq<TypeParam>{},
                                TypeParam{}, TypeParam(0.9));
    };
    for (int n = 0; n < 1000; ++n) step(0.45);
    const double end = number(state.voltage.q);
    const Dq<TypeParam> v = step(-0.05);
    EXPECT_NEAR(number(v.q), end + 0.5 * (-0.5) + 0.1 * 0.45, 8 * digit<TypeParam>());
  }
}

TYPED_TEST(FieldBlocks, EachAxisStaysWithinItsOwnLimit) {
  const FieldCurrentConfig<TypeParam> c = decoupled<TypeParam>(VoltageLimit::axes);
  FieldCurrentState<TypeParam> state;
  for (int n = 0; n < 100; ++n)
    field_current_step(c, state, Dq<TypeParam>{TypeParam(-0.45), TypeParam(0.45)}, Dq<TypeParam>{},
                       TypeParam(-0.6), TypeParam(0.9));
  EXPECT_EQ(state.voltage.d, -c.d.limit);
  EXPECT_EQ(state.voltage.q, c.q.limit);
}

/// If the voltage |v| exceeds the fraction m of the voltage circle, i_d decreases in each period by K times
/// the excess. If |v| is smaller, i_d increases to 0 with the same gain.
TYPED_TEST(FieldBlocks, WeakeningFallsByWhatTheVoltageLacks) {
  const FieldWeakeningConfig<TypeParam> c{Gain<TypeParam>(0.1), Gain<TypeParam>(0.9), TypeParam(0.5)};
  FieldWeakeningState<TypeParam> state;
  const double room = 0.9 * 0.9 / std::numbers::sqrt3 - 0.5;
  ASSERT_LT(room, 0.0);
  const Dq<TypeParam> v{TypeParam(-0.3), TypeParam(0.4)};
  for (int n = 1; n <= 20; ++n)
    EXPECT_NEAR(number(field_weakening_step(c, state, v, TypeParam(0.9))), 0.1 * n * room,
                (n + 3) * digit<TypeParam>());
  for (int n = 0; n < 2000; ++n) field_weakening_step(c, state, v, TypeParam(0.9));
  EXPECT_EQ(field_weakening_step(c, state, v, TypeParam(0.9)), -c.most_A);
  for (int n = 0; n < 2000; ++n) field_weakening_step(c, state, Dq<TypeParam>{}, TypeParam(0.9));
  EXPECT_EQ(field_weakening_step(c, state, Dq<TypeParam>{}, TypeParam(0.9)), TypeParam{});
  EXPECT_EQ(field_weakening_step(FieldWeakeningConfig<TypeParam>{}, state, v, TypeParam(0.9)), TypeParam{});
}

/// The bound of i_q keeps the voltage w p L_q i_q within the fraction m of the voltage circle (speed w, pole
/// pairs p). A smaller request for i_q is unchanged. Without weakening, every request is unchanged.
TYPED_TEST(FieldBlocks, AWeakenedFieldBoundsWhatIsAskedForByTheVoltage) {
  const FieldCurrentConfig<TypeParam> c = decoupled<TypeParam>(VoltageLimit::circle);
  const FieldWeakeningConfig<TypeParam> weakens{Gain<TypeParam>(0.1), Gain<TypeParam>(0.5), TypeParam(0.5)};
  const auto bus = TypeParam(0.5);
  const double V = 0.5 * 0.5 / std::numbers::sqrt3;
  for (const double w : {-0.9, -0.5, 0.0, 0.7})
    for (const double most : {0.1, 0.5, 0.9}) {
      const double asked_V = std::fabs(w) * most * 0.5, allowed = asked_V > V ? most * V / asked_V : most;
      // The voltage asked_V is accurate to two digits. It is at least 0.14 if it limits the current.
      EXPECT_NEAR(number(voltage_bound(weakens, c, TypeParam(w), bus, TypeParam(most))), allowed,
                  16 * digit<TypeParam>());
      EXPECT_EQ(voltage_bound({}, c, TypeParam(w), bus, TypeParam(most)), TypeParam(most));
    }
}

/// On the curve of maximum torque per ampere, the torque is the largest for its current: if the current
/// vector is rotated in either direction, the torque is smaller.
TYPED_TEST(FieldBlocks, ThereIsNoMoreTorquePerAmpere) {
  const double saliency = 1.6;  // (L_q - L_d)/psi, in 1/A
  const TorquePerAmpereConfig<TypeParam> c{Gain<TypeParam>(saliency / 2)};
  const auto torque = [&](double d, double q) { return q - saliency * d * q; };
  for (const double i_q : {-0.85, -0.3, 0.05, 0.5, 0.85}) {
    const double i_d = number(least_current_d(c, TypeParam(i_q)));
    const double a = 1 / (2 * saliency);
    EXPECT_NEAR(i_d, a - std::sqrt(a * a + i_q * i_q), 8 * digit<TypeParam>());
    const double length = std::hypot(i_d, i_q), angle = std::atan2(i_q, i_d);
    for (const double turned : {-0.05, 0.05})
      EXPECT_LT(std::fabs(torque(length * std::cos(angle + turned), length * std::sin(angle + turned))),
                std::fabs(torque(i_d, i_q)));
  }
  EXPECT_EQ(least_current_d(TorquePerAmpereConfig<TypeParam>{}, TypeParam(0.7)), TypeParam{});
}

TYPED_TEST(FieldBlocks, TheMagnetPoints150DegreesBehindAndTurnsOnWithTheSpeed) {
  const FieldAdvanceConfig<TypeParam> c{Gain<TypeParam>(0.8)};
  constexpr double pi = std::numbers::pi;
  // The tolerance is 3.1e-7 from sine.hpp, plus two digits in 16 bits. The truncation of the angle is far
  // smaller.
  const double allowed = 4e-7 + 3 * digit<TypeParam>();
  for (int n = 0; n < 24; ++n)
    for (const double w : {-0.9, 0.0, 0.6}) {
      const double theta_d = n * pi / 12 - 5 * pi / 6;
      const FieldDirections<TypeParam> at = field_directions(c, binary_degrees(15.0 * n), TypeParam(w));
      EXPECT_NEAR(number(at.sampled.cos), std::cos(theta_d), allowed);
      EXPECT_NEAR(number(at.sampled.sin), std::sin(theta_d), allowed);
      EXPECT_NEAR(number(at.answered.cos), std::cos(theta_d + 0.8 * w), allowed + digit<TypeParam>());
      EXPECT_NEAR(number(at.answered.sin), std::sin(theta_d + 0.8 * w), allowed + digit<TypeParam>());
    }
}

}  // namespace SIXSTEP_TEST_FILE
