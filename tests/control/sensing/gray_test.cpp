// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensing/gray.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <type_traits>

#include "tests/control/scalars.hpp"
#include "tests/control/sensing/drawn.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<GrayState>);

/// The code by its definition as a reflected list. The list has the codes of n-1 bits, followed by the same
/// codes in reverse order with bit n-1 set.
std::uint32_t reflected(std::uint32_t place, std::uint8_t bits) {
  if (bits == 0) return 0;
  const std::uint32_t half = 1u << (bits - 1);
  return place < half ? reflected(place, static_cast<std::uint8_t>(bits - 1))
                      : half | reflected(2 * half - 1 - place, static_cast<std::uint8_t>(bits - 1));
}

TEST(Gray, EveryCodeOfEveryWidthIsItsPlace) {
  for (std::uint8_t bits = 1; bits <= 20; ++bits)
    for (std::uint32_t place = 0; place < 1u << bits; ++place) {
      const std::uint32_t code = reflected(place, bits);
      ASSERT_EQ(binary_of_gray(code, bits), place) << int{bits};
      ASSERT_EQ(gray_of_binary(place), code) << int{bits};
      ASSERT_EQ(angle_of_gray(code | 0xffffffffu << bits, bits), std::uint64_t{place} << (32 - bits))
          << "higher bits are none of its";
    }
  EXPECT_EQ(angle_of_gray(5, 0), 0u);
  EXPECT_EQ(angle_of_gray(5, 21), 0u);
}

constexpr double period = 1e-4;

template <class S>
GrayConfig<S> config(std::uint8_t bits, std::uint8_t span, double base = 1.0) {
  return {.bits = bits,
          .tolerance = BinaryAngle{3} << (32 - bits),
          .patience = 2,
          .span = span,
          .speed_per_unit = per_count<S>(2 * std::numbers::pi / 4294967296.0 / (span * period) / base)};
}
std::uint32_t code_at(double turns, std::uint8_t bits) {
  return gray_of_binary(of_turns(turns - 0.5 / 4294967296.0) >> (32 - bits));
}

template <class Scalar>
class GrayIn : public ::testing::Test {};
TYPED_TEST_SUITE(GrayIn, SensingScalars);

/// At constant speed, turns and angle are accurate to half a step of the code. The speed is accurate to one
/// step divided by the time span.
TYPED_TEST(GrayIn, FollowsManyTurns) {
  using S = TypeParam;
  const double base = is_fixed<S> ? 2500.0 : 1.0;
  for (const std::uint8_t bits : {std::uint8_t{10}, std::uint8_t{13}, std::uint8_t{20}})
    for (const std::uint8_t span : {std::uint8_t{1}, std::uint8_t{8}})
      for (const double w : {-2000.0, -3.0, 0.0, 0.4, 77.0, 2400.0}) {
        GrayState state;
        const auto c = config<S>(bits, span, base);
        const double step = std::ldexp(1.0, -bits);
        for (int n = 0; n < 3000; ++n) {
          const double turns = w * n * period / (2 * std::numbers::pi) + 0.377;
          const GrayReading<S> r = gray_step(c, state, code_at(turns, bits));
          ASSERT_FALSE(r.jump);
          ASSERT_NEAR(r.position.turns + r.position.angle / 4294967296.0, turns - step / 2, step / 2 + 1e-9);
          if (n < span) {
            ASSERT_EQ(static_cast<double>(r.speed), 0.0);
          } else {
            // The error is one step of the code, plus the rounding of the format. Gain and angle have a
            // relative error of 2^-15, of 2^-31, or of one digit.
            const double own = is_fixed<S> ? std::ldexp(1.0, sizeof(S) == 2 ? -14 : -30) : 2 * digit<S>();
            const double bound = 2 * std::numbers::pi * step / (span * period) * (1 + own) +
                                 std::fabs(w) * own + (is_fixed<S> ? digit<S>() * base / 2 : 0.0);
            const double most = is_fixed<S> ? base : 1e9;
            ASSERT_NEAR(static_cast<double>(r.speed) * base, std::fmin(w, most), bound * (1 + 1e-6))
                << w << " " << int{bits};
          }
        }
      }
}

/// A track breaks to a fixed level while the rotor turns by some counts per tick. The first detected jump
/// names this track or no track, but never another track.
TEST(Gray, ABrokenTrackIsNamed) {
  constexpr std::uint8_t bits = 12;
  int named = 0, untold = 0, never = 0, coarse = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Drawn drawn{seed};
    for (std::uint8_t track = 0; track < bits; ++track)
      for (const bool level : {false, true}) {
        const double counts = (drawn.unit() < 0.5 ? -1 : 1) * (4 + 16 * drawn.unit());
        const double start = drawn.unit();
        GrayState state;
        const auto c = config<double>(bits, 1);
        GrayReading<double> r;
        for (int n = 0; n < 3000 && !r.jump; ++n) {
          std::uint32_t code = code_at(start + 100 + n * counts / 4096, bits);
          if (n >= 50) code = level ? code | 1u << track : code & ~(1u << track);
          r = gray_step(c, state, code);
          ASSERT_TRUE(n >= 50 || !r.jump) << "seed " << seed;
        }
        coarse += track >= 4;
        if (!r.jump)
          ++never;
        else
          ++(r.track == no_track ? untold : named);
        ASSERT_TRUE(r.track == track || r.track == no_track) << int{track} << " of seed " << seed;
        // A broken track gives the code of a mirrored position. The mirrored position differs by one count
        // for track 0 and by at most three counts for track 1. These differences are within the tolerance.
        ASSERT_TRUE(r.jump || track < 2) << int{track} << " of seed " << seed;
        ASSERT_TRUE(r.track == no_track || track > 2) << "its mirror, of 7 counts, is within four tolerances";
      }
  }
  std::printf("named %d, not told %d, within the tolerance %d\n", named, untold, never);
  EXPECT_GT(named, 0.6 * coarse);
}

/// The decoder replaces a single wrong code by its prediction. The next position is the true position.
TEST(Gray, AWrongCodeIsBridged) {
  constexpr std::uint8_t bits = 12;
  GrayState state;
  const auto c = config<double>(bits, 1);
  const double step = 1.0 / 4096;
  for (int n = 0; n < 2000; ++n) {
    const double turns = 0.2 + n * 2.5 * step;
    const bool wrong = n % 50 == 40;
    const GrayReading<double> r = gray_step(c, state, code_at(turns, bits) ^ (wrong ? 0x400u : 0u));
    EXPECT_EQ(r.jump, wrong) << n;
    if (wrong) {
      EXPECT_EQ(r.track, 10) << n;
    }
    // the prediction extrapolates from two codes, each accurate to a step; the later code has twice the
    // weight
    EXPECT_NEAR(r.position.turns + r.position.angle / 4294967296.0, turns - step / 2,
                step * (wrong ? 1.5 : 0.5) + 1e-9)
        << n;
  }
  EXPECT_EQ(state.faults, 40u);
}

/// A permanent jump is accepted after `patience` codes. The turn count then changes as if the rotor had
/// turned in the shorter direction.
TEST(Gray, AJumpThatStaysIsBelieved) {
  GrayState state;
  const auto c = config<double>(12, 1);
  for (int n = 0; n < 10; ++n) gray_step(c, state, code_at(0.1, 12));
  for (int n = 0; n < 10; ++n) {
    const GrayReading<double> r = gray_step(c, state, code_at(0.4, 12));
    EXPECT_EQ(r.jump, n < 3) << n;
    EXPECT_NEAR(r.position.angle / 4294967296.0, n < 2 ? 0.1 : 0.4, 1.0 / 4096) << n;
    EXPECT_EQ(r.position.turns, 0);
  }
}

}  // namespace SIXSTEP_TEST_FILE
