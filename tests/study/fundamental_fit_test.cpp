// SPDX-License-Identifier: Apache-2.0
// The fit of a fundamental is compared with closed-form Fourier sums, and with a QR decomposition in long
// double.
#include "sixstep/study/measure/fundamental_fit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::study;

constexpr double eps = 0x1p-52;
constexpr std::uint64_t seed = 20260417;
constexpr long double pi = std::numbers::pi_v<long double>;
constexpr int points = 8;

/// QR decomposition of the rows 1, cos, sin, signal by plane rotations (Golub, Van Loan 5.1.8). It avoids
/// squares and differences of large numbers.
class RotatedRows {
 public:
  void add(std::array<long double, 4> row) {
    for (std::size_t j = 0; j < 4; ++j) {
      const long double length = std::hypot(r_[j][j], row[j]);
      if (row[j] == 0 || length == 0) continue;
      const long double c = r_[j][j] / length, s = row[j] / length;
      for (std::size_t k = j; k < 4; ++k) {
        const long double kept = c * r_[j][k] + s * row[k];
        row[k] = c * row[k] - s * r_[j][k];
        r_[j][k] = kept;
      }
    }
  }
  double distortion() const {
    return static_cast<double>(std::fabs(r_[3][3]) / std::hypot(r_[1][3], r_[2][3]));
  }

 private:
  std::array<std::array<long double, 4>, 4> r_{};
};

using Curve = std::function<long double(long double)>;

/// Passes the part of the signal between two phases to the fit, at the nodes of the part.
void see(FundamentalFit& fit, long double from, long double to, const Curve& signal) {
  FittedPart<points> part;
  for (int k = 0; k < points; ++k) {
    const long double turn = series::gauss<points>.node[k] * (to - from);
    part.weight.set(k, static_cast<double>(series::gauss<points>.weight[k] * (to - from)));
    part.turn.set(k, static_cast<double>(turn));
    part.signal.set(k, static_cast<double>(signal(from + turn)));
  }
  fit.add(phase_of(static_cast<double>(std::fmod(from, 2 * pi))), part);
}

/// The fit, and an independent check by the QR decomposition in long double.
struct BothWays {
  FundamentalFit fit;
  RotatedRows rows;

  void see(long double from, long double to, const Curve& signal) {
    SIXSTEP_TEST_FILE::see(fit, from, to, signal);
    for (int k = 0; k < points; ++k) {
      const long double at = from + series::gauss<points>.node[k] * (to - from);
      const long double root = std::sqrt(series::gauss<points>.weight[k] * (to - from));
      rows.add({root, root * std::cos(at), root * std::sin(at), root * signal(at)});
    }
  }
};

TEST(Phase, KeepsItsDigitsWhereItIsSmall) {
  for (double p = 1e-12; p < 7.0; p *= 1.37) {
    const Phase found = phase_of(p);
    const long double half = std::sin(static_cast<long double>(p) / 2);
    // beyond a quarter of a turn, cos has an error of one ulp of 1; below it, the quotient is rounded four
    // times
    EXPECT_NEAR(found.versine, static_cast<double>(2 * half * half), 4 * eps * found.versine) << p;
    EXPECT_NEAR(found.sin, static_cast<double>(std::sin(static_cast<long double>(p))), eps) << p;
  }
}

/// The series of a small turn has as many terms as its part has points. The test checks that these terms are
/// enough.
template <int terms>
void expect_small_turns(double largest) {
  for (double x = largest; x > 1e-9; x *= -0.61) {
    series::Nodes<terms, double> sin, versine;
    detail::small_turn<terms>(series::Nodes<terms, double>::everywhere(std::fabs(x)), sin, versine);
    const Phase found{sin[0], versine[0]};
    const long double exact = std::fabs(static_cast<long double>(x)), half = std::sin(exact / 2);
    EXPECT_NEAR(found.sin, static_cast<double>(std::sin(exact)), 2 * eps * found.sin) << terms << " " << x;
    EXPECT_NEAR(found.versine, static_cast<double>(2 * half * half), 3 * eps * found.versine)
        << terms << " " << x;
  }
}
TEST(SmallTurn, HasTermsEnough) {
  expect_small_turns<3>(0.0065);
  expect_small_turns<4>(0.038);
  expect_small_turns<5>(0.115);
  expect_small_turns<6>(0.247);
  expect_small_turns<7>(0.437);
  expect_small_turns<8>(0.5);
}

TEST(FundamentalFit, LeavesNothingOfASine) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> length(1e-4, 0.5), any(-1, 1);
  for (int n = 0; n < 40; ++n) {
    const double mean = 10 * any(random), cos = any(random), sin = any(random);
    BothWays both;
    for (long double at = 0, end = 2 * pi * (1 + n % 3); at < end;) {
      const long double to = std::min(end, at + static_cast<long double>(length(random)));
      both.see(at, to, [&](long double p) { return mean + cos * std::cos(p) + sin * std::sin(p); });
      at = to;
    }
    // The signal and the fit's values are rounded at each node. The distortion is a few eps of the largest
    // value.
    EXPECT_LE(both.fit.distortion(), 8 * eps * (std::fabs(mean) + 1) / std::hypot(cos, sin))
        << "seed " << seed << " sine " << n;
  }
}

/// The first part is much shorter than the others. Its accuracy must not limit the accuracy of the fit of the
/// long parts.
TEST(FundamentalFit, LeavesNothingOfASineThatBeginsWithAnInstant) {
  for (const long double first : {1e-12L, 1e-9L, 1e-6L, 1e-3L}) {
    BothWays both;
    const auto sine = [](long double p) { return 3.0L + std::cos(p) - 2.0L * std::sin(p); };
    both.see(0, first, sine);
    both.see(first, 2 * first, sine);
    for (int n = 0; n < 16; ++n)
      both.see(2 * first + (2 * pi - 2 * first) * n / 16, 2 * first + (2 * pi - 2 * first) * (n + 1) / 16,
               sine);
    EXPECT_LE(both.fit.distortion(), 16 * eps) << static_cast<double>(first);
  }
}

TEST(FundamentalFit, KeepsASmallHarmonicBesideALargeFundamental) {
  for (const double harmonic : {1.0, 1e-3, 1e-6, 1e-9, 1e-12}) {
    FundamentalFit fit;
    for (int n = 0; n < 600; ++n)
      see(fit, 2 * pi * n / 200, 2 * pi * (n + 1) / 200, [&](long double p) {
        return std::cos(p) + static_cast<long double>(harmonic) * std::sin(5 * p + 1);
      });
    EXPECT_NEAR(fit.distortion(), harmonic, 4 * eps * (1 + harmonic)) << harmonic;
  }
}

TEST(FundamentalFit, DoesNotDriftOverTenThousandTurns) {
  FundamentalFit fit;
  for (std::int64_t n = 0; n < 200'000; ++n)
    see(fit, 2 * pi * static_cast<long double>(n) / 20, 2 * pi * static_cast<long double>(n + 1) / 20,
        [](long double p) { return std::cos(p) + 1e-3L * std::cos(3 * p); });
  EXPECT_NEAR(fit.distortion(), 1e-3, 8 * eps);
}

/// A chopped signal with jumps and pauses, over a number of turns that may be fractional. The fit is compared
/// with the QR decomposition.
TEST(FundamentalFit, AgreesWithRotatedRows) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> any(-1, 1), unit(0, 1);
  for (int run = 0; run < 60; ++run) {
    BothWays both;
    const double end = 6.0 + 20 * unit(random), ripple = std::pow(10.0, -8 * unit(random));
    for (double at = 0; at < end;) {
      const double length = std::min(0.5, std::pow(10.0, -6 * unit(random)));
      const double offset = 0.2 * ripple * any(random), slope = ripple * any(random),
                   bend = ripple * any(random);
      both.see(at, at + length, [&](long double p) {
        const long double s = (p - at) / length;
        return 2 * std::cos(p) - std::sin(p) + 1.5L + offset + slope * s + bend * s * s;
      });
      at += length;
    }
    const double expected = both.rows.distortion();
    EXPECT_NEAR(both.fit.distortion(), expected, 8 * eps + 1e-13 * expected)
        << "seed " << seed << " run " << run;
  }
}

/// The signal steps in the middle, so the fit after the step differs greatly from the fit before the step.
TEST(FundamentalFit, AgreesWithRotatedRowsAcrossASwing) {
  for (const double before : {0.0, 1e-6, 1.0, 1e6}) {
    BothWays both;
    for (int n = 0; n < 400; ++n)
      both.see(2 * pi * n / 100, 2 * pi * (n + 1) / 100, [&](long double p) {
        return n < 137 ? before * std::cos(p + 1) : std::cos(p) + 5 + 1e-3L * std::cos(4 * p);
      });
    EXPECT_NEAR(both.fit.distortion(), both.rows.distortion(), 1e-13 * both.rows.distortion()) << before;
  }
}

TEST(FundamentalFit, OfNothingIsNoNumber) {
  BothWays both;
  for (int n = 0; n < 20; ++n)
    both.see(2 * pi * n / 20, 2 * pi * (n + 1) / 20, [](long double) { return 0.0L; });
  EXPECT_TRUE(std::isnan(both.fit.distortion()));
  EXPECT_TRUE(std::isnan(FundamentalFit().distortion()));
}

}  // namespace SIXSTEP_TEST_FILE
