// SPDX-License-Identifier: Apache-2.0
// Numbers at the nodes of a quadrature rule, two per instruction. A file that is compiled for AVX can define
// SIXSTEP_FOUR_LANES. The rule with four nodes then uses four numbers per instruction. The sums of different
// nodes are computed in parallel. For each node the operations and their order are the same as in scalar
// code, so that the bits are the same.
#pragma once

// Code for two and for four lanes is in different namespaces, so that a program can contain both.
#ifdef SIXSTEP_FOUR_LANES
#define SIXSTEP_LANES four_lanes
#else
#define SIXSTEP_LANES two_lanes
#endif

namespace sixstep::series {

/// Two numbers of any scalar type. For double a pair is one register, by the vector extension of GCC and
/// clang. On processors without such registers the compiler splits the pair.
template <class Real>
struct PlainPair {
  Real lane[2];
  Real& operator[](int k) { return lane[k]; }
  Real operator[](int k) const { return lane[k]; }
  friend PlainPair operator+(const PlainPair& a, const PlainPair& b) {
    return {{a.lane[0] + b.lane[0], a.lane[1] + b.lane[1]}};
  }
  friend PlainPair operator-(const PlainPair& a, const PlainPair& b) {
    return {{a.lane[0] - b.lane[0], a.lane[1] - b.lane[1]}};
  }
  friend PlainPair operator*(const PlainPair& a, const PlainPair& b) {
    return {{a.lane[0] * b.lane[0], a.lane[1] * b.lane[1]}};
  }
  friend PlainPair operator-(const PlainPair& a) { return {{-a.lane[0], -a.lane[1]}}; }
};

namespace detail {

typedef double TwoDoubles __attribute__((vector_size(16)));

template <class Real>
struct PairOf {
  using Type = PlainPair<Real>;
};
template <>
struct PairOf<double> {
  using Type = TwoDoubles;
};

}  // namespace detail

template <class Real>
using Pair = typename detail::PairOf<Real>::Type;

template <class Real>
[[gnu::always_inline]] inline Pair<Real> both(Real v) {
  return Pair<Real>{v, v};
}

inline namespace SIXSTEP_LANES {

/// One number per node. With an odd number of nodes the last lane is unused; weighted() sets it to zero
/// before a sum.
template <int points, class Real>
struct Nodes {
  static constexpr int pairs = (points + 1) / 2;
  Pair<Real> pair[pairs];

  [[gnu::always_inline]] Real operator[](int k) const { return pair[k / 2][k % 2]; }
  [[gnu::always_inline]] void set(int k, Real v) { pair[k / 2][k % 2] = v; }

  [[gnu::always_inline]] friend Nodes operator+(const Nodes& a, const Nodes& b) {
    return each([&](int k) { return a.pair[k] + b.pair[k]; });
  }
  [[gnu::always_inline]] friend Nodes operator-(const Nodes& a, const Nodes& b) {
    return each([&](int k) { return a.pair[k] - b.pair[k]; });
  }
  [[gnu::always_inline]] friend Nodes operator*(const Nodes& a, const Nodes& b) {
    return each([&](int k) { return a.pair[k] * b.pair[k]; });
  }
  [[gnu::always_inline]] friend Nodes operator-(const Nodes& a) {
    return each([&](int k) { return -a.pair[k]; });
  }
  [[gnu::always_inline]] friend Nodes operator+(const Nodes& a, Real b) { return a + everywhere(b); }
  [[gnu::always_inline]] friend Nodes operator+(Real a, const Nodes& b) { return everywhere(a) + b; }
  [[gnu::always_inline]] friend Nodes operator-(const Nodes& a, Real b) { return a - everywhere(b); }
  [[gnu::always_inline]] friend Nodes operator-(Real a, const Nodes& b) { return everywhere(a) - b; }
  [[gnu::always_inline]] friend Nodes operator*(Real a, const Nodes& b) { return everywhere(a) * b; }

  [[gnu::always_inline]] static Nodes everywhere(Real v) {
    const Pair<Real> two = both(v);
    return each([&](int) { return two; });
  }
  /// Nodes whose pair k is `of(k)`.
  template <class Of>
  [[gnu::always_inline]] static Nodes each(Of of) {
    Nodes out;
#pragma GCC unroll 8
    for (int k = 0; k < pairs; ++k) out.pair[k] = of(k);
    return out;
  }
};

/// Sum over all lanes, including an unused lane. Even and odd nodes are summed separately, then the two sums
/// are added.
template <int points, class Real>
[[gnu::always_inline]] inline Real total(const Nodes<points, Real>& v) {
  Pair<Real> sum = v.pair[0];
#pragma GCC unroll 8
  for (int k = 1; k < Nodes<points, Real>::pairs; ++k) sum = sum + v.pair[k];
  return sum[0] + sum[1];
}

/// total() of a and of b, computed in parallel.
template <int points, class Real>
[[gnu::always_inline]] inline Pair<Real> totals(const Nodes<points, Real>& a, const Nodes<points, Real>& b) {
  Pair<Real> sum_a = a.pair[0], sum_b = b.pair[0];
#pragma GCC unroll 8
  for (int k = 1; k < Nodes<points, Real>::pairs; ++k) {
    sum_a = sum_a + a.pair[k];
    sum_b = sum_b + b.pair[k];
  }
  return Pair<Real>{sum_a[0], sum_b[0]} + Pair<Real>{sum_a[1], sum_b[1]};
}

/// Four sums, computed like total().
template <class Real>
struct Four {
  Real of[4];
};
template <int points, class Real>
[[gnu::always_inline]] inline Four<Real> totals(const Nodes<points, Real>& a, const Nodes<points, Real>& b,
                                                const Nodes<points, Real>& c, const Nodes<points, Real>& d) {
  const Pair<Real> first = totals(a, b), second = totals(c, d);
  return {{first[0], first[1], second[0], second[1]}};
}

#ifdef SIXSTEP_FOUR_LANES

/// Four nodes, the most frequent number, in one register.
template <>
struct Nodes<4, double> {
  typedef double Row __attribute__((vector_size(32)));
  Row row;

  [[gnu::always_inline]] double operator[](int k) const { return row[k]; }
  [[gnu::always_inline]] friend Nodes operator+(const Nodes& a, const Nodes& b) { return {a.row + b.row}; }
  [[gnu::always_inline]] friend Nodes operator-(const Nodes& a, const Nodes& b) { return {a.row - b.row}; }
  [[gnu::always_inline]] friend Nodes operator*(const Nodes& a, const Nodes& b) { return {a.row * b.row}; }
  [[gnu::always_inline]] friend Nodes operator-(const Nodes& a) { return {-a.row}; }
  [[gnu::always_inline]] friend Nodes operator+(const Nodes& a, double b) { return a + everywhere(b); }
  [[gnu::always_inline]] friend Nodes operator*(double a, const Nodes& b) { return everywhere(a) * b; }
  [[gnu::always_inline]] static Nodes everywhere(double v) { return {Row{v, v, v, v}}; }
};

template <>
[[gnu::always_inline]] inline double total(const Nodes<4, double>& v) {
  const Pair<double> sum =
      __builtin_shufflevector(v.row, v.row, 0, 1) + __builtin_shufflevector(v.row, v.row, 2, 3);
  return sum[0] + sum[1];
}

template <>
[[gnu::always_inline]] inline Pair<double> totals(const Nodes<4, double>& a, const Nodes<4, double>& b) {
  const auto halves_of = [](const Nodes<4, double>& n) __attribute__((always_inline)) {
    return __builtin_shufflevector(n.row, n.row, 0, 1) + __builtin_shufflevector(n.row, n.row, 2, 3);
  };
  const Pair<double> sum_a = halves_of(a), sum_b = halves_of(b);
  return Pair<double>{sum_a[0], sum_b[0]} + Pair<double>{sum_a[1], sum_b[1]};
}
template <>
[[gnu::always_inline]] inline Four<double> totals(const Nodes<4, double>& a, const Nodes<4, double>& b,
                                                  const Nodes<4, double>& c, const Nodes<4, double>& d) {
  using Row = Nodes<4, double>::Row;
  const Row low_ac = __builtin_shufflevector(a.row, c.row, 0, 1, 4, 5);
  const Row low_bd = __builtin_shufflevector(b.row, d.row, 0, 1, 4, 5);
  const Row ac = low_ac + __builtin_shufflevector(a.row, c.row, 2, 3, 6, 7);
  const Row bd = low_bd + __builtin_shufflevector(b.row, d.row, 2, 3, 6, 7);
  const Row sums = __builtin_shufflevector(ac, bd, 0, 4, 2, 6) + __builtin_shufflevector(ac, bd, 1, 5, 3, 7);
  return {{sums[0], sums[1], sums[2], sums[3]}};
}

#endif

}  // namespace SIXSTEP_LANES

}  // namespace sixstep::series
