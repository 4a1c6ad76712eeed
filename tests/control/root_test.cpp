// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/root.hpp"

#include <cmath>
#include <limits>

#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(whole_root<std::uint16_t>(65535) == 255 && whole_root<std::uint32_t>(0xffffffffu) == 65535);
static_assert(root(9.0) == 3.0 && root(0.0) == 0.0 && root(-1.0) == 0.0);

template <class Scalar>
void expect_root(Scalar x) {
  const double exact = std::sqrt(static_cast<double>(x)), eps = std::numeric_limits<Scalar>::epsilon();
  EXPECT_NEAR(static_cast<double>(root(x)), exact, 2 * eps * exact) << static_cast<double>(x);
}

TEST(Root, IsTheRootToTwoDigitsFromTheSmallestNumberToTheLargest) {
  for (double x = 1e-300; x < 1e300; x *= 1.7) expect_root(x);
  for (float x = 1e-36f; x < 1e36f; x *= 1.3f) expect_root(x);
  for (int n = 1; n <= 1000; ++n) expect_root(n / 1000.0);
}

TEST(Root, OfWhatHasNoneIsNothing) {
  for (const double x :
       {-1.0, -1e-300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(root(x), 0.0);
}

template <class Scalar>
class Circle : public ::testing::Test {};
TYPED_TEST_SUITE(Circle, SensingScalars);

/// The tolerance is a digit for the truncation in fixed point, and a few roundings in floating point.
template <class Scalar>
double allowed(double value) {
  return is_fixed<Scalar> ? digit<Scalar>() : 4 * digit<Scalar>() * value;
}

TYPED_TEST(Circle, LengthAndRestAreThoseOfTheCircle) {
  for (int k = 0; k <= 20; ++k)
    for (int n = -20; n <= 20; ++n) {
      const auto a = TypeParam(0.033 * k), b = TypeParam(0.033 * n);
      const double x = static_cast<double>(a), y = static_cast<double>(b), length = std::hypot(x, y);
      EXPECT_NEAR(static_cast<double>(vector_length(a, b)), length, allowed<TypeParam>(length));
      const double rest = x > std::fabs(y) ? std::sqrt((x - y) * (x + y)) : 0.0;
      EXPECT_NEAR(static_cast<double>(circle_rest(a, b)), rest, allowed<TypeParam>(rest));
    }
}

TYPED_TEST(Circle, NothingIsLeftOutsideOrOfNoCircle) {
  const auto half = TypeParam(0.5), more = TypeParam(0.75), none = TypeParam{};
  for (const TypeParam x : {half, more, -half, -more}) EXPECT_EQ(circle_rest(half, x), none);
  EXPECT_EQ(circle_rest(none, none), none);
  EXPECT_EQ(circle_rest(-half, none), none);
}

template <class Scalar>
class FixedCircle : public ::testing::Test {};
using FixedScalars = ::testing::Types<Q15, Q14, Q31, Q30>;
TYPED_TEST_SUITE(FixedCircle, FixedScalars);

TYPED_TEST(FixedCircle, NeitherWrapsAtTheEnds) {
  const TypeParam most = TypeParam::max(), least = TypeParam::min();
  for (const TypeParam a : {most, least})
    for (const TypeParam b : {most, least}) EXPECT_EQ(vector_length(a, b), most) << "1.41 times the range";
  EXPECT_EQ(vector_length(least, TypeParam{}), most);
  EXPECT_EQ(circle_rest(most, least), TypeParam{});
  EXPECT_EQ(circle_rest(most, TypeParam{}), most);
}

}  // namespace SIXSTEP_TEST_FILE
