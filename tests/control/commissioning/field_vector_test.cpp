// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/commissioning/field_vector.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/control/commissioning/vector_angle.hpp"
#include "tests/control/sensing/drawn.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

constexpr double pi = 3.14159265358979323846;

/// The voltages between the legs are equal to the commanded vector in every direction. The error is at most
/// six roundings of 2^-20 of the bus voltage.
template <class Scalar>
void expect_vector(double digit) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Drawn drawn{seed};
    const auto v = static_cast<std::int32_t>(drawn.below(longest_vector + 1));
    const BinaryAngle angle = drawn.word();
    const LegCommands<Scalar> legs = legs_of_vector<Scalar>(v, angle);
    double d[3];
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ(legs.leg[k].state, LegState::pwm);
      d[k] = static_cast<double>(legs.leg[k].duty);
      EXPECT_GE(d[k], 0.0);
      EXPECT_LE(d[k], 1.0);
    }
    const double rad = angle * (2 * pi / 4294967296.0), size = v / 1048576.0;
    EXPECT_NEAR((2 * d[0] - d[1] - d[2]) / 3, size * std::cos(rad), 6.0 / 1048576 + 2 * digit) << seed;
    EXPECT_NEAR((d[1] - d[2]) / std::sqrt(3.0), size * std::sin(rad), 6.0 / 1048576 + 2 * digit) << seed;
  }
}

TEST(FieldVector, TheLegsMakeTheVector) {
  expect_vector<double>(0.0);
  expect_vector<float>(0x1p-24);
  expect_vector<Q31>(0x1p-31);
  expect_vector<Q15>(0x1p-15);  // the largest duty of Q15 is a digit below 1
}

TEST(FieldVector, ACurrentIsSeenAlongAndAcross) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Drawn drawn{seed};
    const BinaryAngle angle = drawn.word();
    const double rad = angle * (2 * pi / 4294967296.0);
    const double along = 8 * 2000 * drawn.unit(), across = 8 * 2000 * drawn.unit();
    std::int32_t eighths[3];
    for (int k = 0; k < 3; ++k) {
      const double at = rad - 2 * pi / 3 * k;
      eighths[k] = static_cast<std::int32_t>(std::lround(along * std::cos(at) - across * std::sin(at)));
    }
    const FieldVector seen = seen_along(eighths, angle);
    // The error is half an eighth of a count in each of three currents, and half a unit in each of four
    // products.
    EXPECT_NEAR(seen.along, 3 * along, 4.0) << seed;
    EXPECT_NEAR(seen.across, 3 * across, 4.0) << seed;
  }
}

TEST(FieldVector, RootsAreWhole) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Drawn drawn{seed};
    const std::uint64_t n = drawn.word();
    EXPECT_EQ(whole_root(n * n), n);
    EXPECT_EQ(whole_root(n * n + n), n);
    EXPECT_EQ(whole_root(n * n + 2 * n), n);
  }
}

TEST(VectorAngle, IsTheArcTangent) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Drawn drawn{seed};
    const double size = std::pow(2.0, 4 + 50 * drawn.unit()), rad = 2 * pi * drawn.unit();
    const auto x = static_cast<std::int64_t>(size * std::cos(rad)),
               y = static_cast<std::int64_t>(size * std::sin(rad));
    const double due = std::atan2(static_cast<double>(y), static_cast<double>(x)) * (2147483648.0 / pi);
    // The error is half a unit in each of 24 steps, plus the angle of the last step.
    EXPECT_NEAR(way_between(static_cast<BinaryAngle>(static_cast<std::int64_t>(due)), vector_angle(x, y)), 0,
                12 + 81 + 1)
        << seed;
  }
  EXPECT_EQ(vector_angle(0, 0), 0u);
}

}  // namespace SIXSTEP_TEST_FILE
