// SPDX-License-Identifier: Apache-2.0
// Integrals over a segment without divisions. Products are integrated from a few values of their factors by
// Gauss-Legendre, which is exact for polynomials of degree 2 points - 1 (Abramowitz and Stegun 25.4.29).
//
// Products of two series of degree n have degree 2 n, but fewer points suffice. Let x be the fastest rate
// times the segment's length, M the magnitude of the solution, and u = 2^-53.
// - Taylor coefficients of a solution are at most M x^j/j!. A series ends at the degree n with x^n/n! = u.
// - The derivatives of a product f of two series are therefore bounded: |f^(j)| <= M^2 (2 x)^j e^(2 x).
// - The rule's error is E f^(2 points)/(2 points)!. E is the rule's error for s^(2 points),
//   E = (points!)^4/((2 points + 1) ((2 points)!)^2) < (pi/2) 4^-(2 points).
// - For 2 points = n the error is at most (pi/2) e^(2 x) 2^-n u M^2. This is u M^2/128 at n = 8 with x =
//   0.04, and less at all other degrees that the engine uses (7 to 16).
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "sixstep/series/nodes.hpp"
#include "sixstep/series/polynomial.hpp"

namespace sixstep::series {

/// 1/(n + 1), rounded once. A multiplication by this number is five times as fast as a division.
template <class Real>
inline constexpr Coefficients<Real> reciprocals = [] {
  Coefficients<Real> out{};
  for (int n = 0; n <= max_degree; ++n) out[n] = Real(1) / static_cast<Real>(n + 1);
  return out;
}();

/// Integral of y over the whole of [0, 1], in units of h.
template <class Real>
inline Real whole_integral(const Coefficients<Real>& c, int degree) {
  Real sum = 0;
  for (int j = degree; j >= 1; --j) sum += c[j] * reciprocals<Real>[j];
  return c[0] + sum;
}

/// Number of points for products of two series of this degree, according to the error above.
constexpr int points_for(int degree) { return degree < 5 ? 3 : (degree + 1) / 2; }

/// Nodes and weights over [0, 1]: roots of the Legendre polynomial, with more digits than a double has.
template <int points>
struct Gauss {
  std::array<long double, points> node, weight;
};
template <int points>
inline constexpr Gauss<points> gauss = {};
template <>
inline constexpr Gauss<3> gauss<3> = {
    .node = {0.112701665379258311482L, 0.5L, 0.887298334620741688518L},
    .weight = {0.277777777777777777778L, 0.444444444444444444444L, 0.277777777777777777778L}};
template <>
inline constexpr Gauss<4> gauss<4> = {.node = {0.069431844202973712388L, 0.330009478207571867599L,
                                               0.669990521792428132401L, 0.930568155797026287612L},
                                      .weight = {0.173927422568726928687L, 0.326072577431273071313L,
                                                 0.326072577431273071313L, 0.173927422568726928687L}};
template <>
inline constexpr Gauss<5> gauss<5> = {
    .node = {0.0469100770306680036012L, 0.230765344947158454482L, 0.5L, 0.769234655052841545518L,
             0.953089922969331996399L},
    .weight = {0.118463442528094543757L, 0.239314335249683234021L, 0.284444444444444444444L,
               0.239314335249683234021L, 0.118463442528094543757L}};
template <>
inline constexpr Gauss<6> gauss<6> = {
    .node = {0.0337652428984239860938L, 0.169395306766867743169L, 0.380690406958401545685L,
             0.619309593041598454315L, 0.830604693233132256831L, 0.966234757101576013906L},
    .weight = {0.0856622461895851725201L, 0.180380786524069303785L, 0.233956967286345523695L,
               0.233956967286345523695L, 0.180380786524069303785L, 0.0856622461895851725201L}};
template <>
inline constexpr Gauss<7> gauss<7> = {
    .node = {0.0254460438286207377369L, 0.129234407200302780068L, 0.297077424311301416547L, 0.5L,
             0.702922575688698583453L, 0.870765592799697219932L, 0.974553956171379262263L},
    .weight = {0.0647424830844348466353L, 0.139852695744638333951L, 0.190915025252559472475L,
               0.208979591836734693878L, 0.190915025252559472475L, 0.139852695744638333951L,
               0.0647424830844348466353L}};
template <>
inline constexpr Gauss<8> gauss<8> = {
    .node = {0.0198550717512318841582L, 0.101666761293186630204L, 0.237233795041835507091L,
             0.40828267875217509753L, 0.59171732124782490247L, 0.762766204958164492909L,
             0.898333238706813369796L, 0.980144928248768115842L},
    .weight = {0.0506142681451881295763L, 0.111190517226687235272L, 0.156853322938943643669L,
               0.181341891689180991483L, 0.181341891689180991483L, 0.156853322938943643669L,
               0.111190517226687235272L, 0.0506142681451881295763L}};

inline namespace SIXSTEP_LANES {

/// The nodes or weights of a rule, converted to Nodes.
template <int points, class Real>
[[gnu::always_inline]] inline Nodes<points, Real> as_nodes(const std::array<long double, points>& of) {
  if constexpr (requires(Nodes<points, Real> all) { all.row; })
    return {typename Nodes<points, Real>::Row{static_cast<Real>(of[0]), static_cast<Real>(of[1]),
                                              static_cast<Real>(of[2]), static_cast<Real>(of[3])}};
  else
    return Nodes<points, Real>::each([&](int k) {
      const int first = 2 * k, second = 2 * k + 1 < points ? 2 * k + 1 : points - 1;
      return Pair<Real>{static_cast<Real>(of[first]), static_cast<Real>(of[second])};
    });
}

/// The nodes of the rule for the interval [0, to].
template <int points, class Real>
[[gnu::always_inline]] inline Nodes<points, Real> nodes_up_to(Real to) {
  return to * as_nodes<points, Real>(gauss<points>.node);
}

/// Values of a series at all nodes; the sums of different nodes are computed in parallel.
template <int points, class Real>
[[gnu::always_inline]] inline Nodes<points, Real> values_at(const Coefficients<Real>& c, int degree,
                                                            const Nodes<points, Real>& s) {
  auto v = Nodes<points, Real>::everywhere(c[degree]);
  for (int j = degree - 1; j >= 0; --j) v = v * s + c[j];
  return v;
}

/// Returns v if `wanted` is true, else zero, also for a NaN. The function avoids a branch, because the
/// processor would often mispredict it.
template <class Real>
[[gnu::always_inline]] inline Real only_if(bool wanted, Real v) {
  if constexpr (std::is_same_v<Real, double>)
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(v) & (std::uint64_t{0} - wanted));
  else
    return wanted ? v : Real(0);
}

/// Values of a series for whose degree points_for() is `points`. Even and odd powers are summed separately,
/// which halves the latency. The loop always has the same number of terms, if necessary with a zero term,
/// because the processor would mispredict a varying number. Call the function separately for each series. If
/// all series were summed together order by order, the compiler would store and load all coefficients.
template <int points, class Real>
[[gnu::always_inline]] inline Nodes<points, Real> values_of_fitting(const Coefficients<Real>& c, int degree,
                                                                    const Nodes<points, Real>& s) {
  constexpr int most = 2 * points;
  if (degree < most - 1) return values_at<points>(c, degree, s);
  const auto t = s * s;
  auto even = Nodes<points, Real>::everywhere(only_if(degree == most, c[most])) * t + c[most - 2];
  auto odd = c[most - 1] * t + c[most - 3];
#pragma GCC unroll 16
  for (int j = most - 4; j >= 2; j -= 2) {
    even = even * t + c[j];
    odd = odd * t + c[j - 1];
  }
  const auto v = (even * t + c[0]) + odd * s;
  return v;
}

/// Integral over [0, 1] from the values at the nodes. For [0, to], use the nodes of [0, to] and multiply the
/// result by `to`.
template <int points, class Real>
[[gnu::always_inline]] inline Real weighted_sum(const Nodes<points, Real>& v) {
  const auto weighted = as_nodes<points, Real>(gauss<points>.weight) * v;
  Real sum = weighted[0];
#pragma GCC unroll 8
  for (int k = 1; k < points; ++k) sum += weighted[k];
  return sum;
}
template <int points, class Real>
[[gnu::always_inline]] inline Real weighted_sum(const Nodes<points, Real>& a, const Nodes<points, Real>& b) {
  return weighted_sum<points>(a * b);
}

/// Values times the rule's weights, to be summed by totals(). An unused lane is zero.
template <int points, class Real>
[[gnu::always_inline]] inline Nodes<points, Real> weighted(const Nodes<points, Real>& v) {
  auto weight = as_nodes<points, Real>(gauss<points>.weight);
  if constexpr (points % 2 != 0) weight.set(points, Real(0));
  return weight * v;
}

}  // namespace SIXSTEP_LANES

/// Calls visit.template operator()<points>() with the number of points that `degree` needs.
template <class Visit>
[[gnu::always_inline]] inline auto with_points_for(int degree, Visit&& visit) {
  if (degree == 8 || degree == 7) return visit.template operator()<4>();  // the most frequent degrees
  switch (points_for(degree)) {
    case 3:
      return visit.template operator()<3>();
    case 5:
      return visit.template operator()<5>();
    case 6:
      return visit.template operator()<6>();
    case 7:
      return visit.template operator()<7>();
    default:
      return visit.template operator()<8>();
  }
}

}  // namespace sixstep::series
