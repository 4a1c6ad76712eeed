// SPDX-License-Identifier: Apache-2.0
// A number as the unevaluated sum of two doubles, about 106 bits. The elementary functions need these bits to
// round correctly. The operations are exact only without contraction and extended precision
// (-ffp-contract=off, SSE or better); the whole library is built in this way.
#pragma once

namespace sixstep::base {

struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;
};

/// a + b exactly (Knuth, The Art of Computer Programming 2, 4.2.2, theorem B).
constexpr DoubleDouble two_sum(double a, double b) {
  const double s = a + b, b_seen = s - a;
  return {s, (a - (s - b_seen)) + (b - b_seen)};
}

/// a + b exactly if |a| >= |b| or a = 0 (Dekker 1971).
constexpr DoubleDouble fast_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// Splits a into two halves of at most 26 bits (Veltkamp). Overflows above 2^996, which no caller reaches.
constexpr DoubleDouble split(double a) {
  const double scaled = 134217729.0 * a;  // 2^27 + 1
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

/// a b exactly (Dekker 1971). A fused multiply-add would compute the same two numbers, but not every target
/// has this instruction.
constexpr DoubleDouble two_prod(double a, double b) {
  const double p = a * b;
  const DoubleDouble x = split(a), y = split(b);
  return {p, ((x.high * y.high - p) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

constexpr DoubleDouble operator-(DoubleDouble a) { return {-a.high, -a.low}; }

constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble s = two_sum(a.high, b.high), t = two_sum(a.low, b.low);
  const DoubleDouble u = fast_two_sum(s.high, s.low + t.high);
  return fast_two_sum(u.high, u.low + t.low);
}

constexpr DoubleDouble operator+(DoubleDouble a, double b) {
  const DoubleDouble s = two_sum(a.high, b);
  return fast_two_sum(s.high, s.low + a.low);
}

constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = two_prod(a.high, b.high);
  return fast_two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

constexpr DoubleDouble operator*(DoubleDouble a, double b) {
  const DoubleDouble p = two_prod(a.high, b);
  return fast_two_sum(p.high, p.low + a.low * b);
}

constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double q = a.high / b.high;
  const DoubleDouble rest = a + -(b * q);
  return fast_two_sum(q, rest.high / b.high);
}

}  // namespace sixstep::base
