// SPDX-License-Identifier: Apache-2.0
// Computes the Taylor coefficients of a segment, order by order, until they are below rounding level.
#pragma once
#include <type_traits>
#include <utility>

#include "sixstep/base/elementary.hpp"
#include "sixstep/plant/recurrences.hpp"
#include "sixstep/plant/state.hpp"

namespace sixstep::plant {

namespace detail {

/// Bound of the number of halvings. Each halving divides the last two terms by at least 2^15, so that for
/// finite terms the loop ends before the bound.
inline constexpr int most_halvings = 2000;

/// Halves the segment until the last two terms of its series are below rounding level. Halving is exact in
/// binary arithmetic.
template <class Real>
void shorten(Expansion<Real>& out, Real excess_last, Real excess_before) {
  int halvings = 0;
  const int n = out.degree;
  // An infinite term is still infinite after a halving: the length then becomes 0, and the run stops because
  // the time does not advance.
  for (Real a = excess_last, b = excess_before; (a > 1 || b > 1) && halvings < most_halvings; ++halvings) {
    for (int j = 0; j < n; ++j) a /= 2;
    // mutant: n - 1 => n
    for (int j = 0; j < n - 1; ++j) b /= 2;
  }
  Real factor = 1, half = 1;
  for (int j = 0; j < halvings; ++j) half /= 2;
  for (int j = 0; j <= n; ++j, factor *= half) {
    for (int k = 0; k < 3; ++k) out.i[k][j] *= factor;
    for (series::Coefficients<Real>* c : {&out.w, &out.x, &out.bus, &out.torque, &out.phi0, &out.phi1})
      (*c)[j] *= factor;
  }
  out.h *= half;
}

/// Increments of currents, speed and angle from the segment's start to the fraction s. The loop sums the four
/// series of these quantities. It sums even and odd powers separately, which shortens the chain of dependent
/// additions.
template <class Real>
Increments<Real> increments(const Expansion<Real>& y, const LegsLaw<Real>& law, Real s) {
  const std::array<const Real*, 4> c{y.i[law.leg[0]].data(), y.i[law.leg[1]].data(), y.w.data(), y.x.data()};
  std::array<Real, 4> near, far;  // near: sum of the powers with the parity of the loop's last power
  const int n = y.degree;
  for (int k = 0; k < 4; ++k) far[k] = c[k][n], near[k] = c[k][n - 1];
  for (int j = n - 2; j >= 2; j -= 2)
    for (int k = 0; k < 4; ++k) {
      far[k] = far[k] * (s * s) + c[k][j];
      near[k] = near[k] * (s * s) + c[k][j - 1];
    }
  std::array<Real, 4> sum;
  for (int k = 0; k < 4; ++k) {
    if (n % 2 == 0)
      sum[k] = (far[k] * s + near[k]) * s;
    else
      sum[k] = ((far[k] * s + near[k]) * s + c[k][1]) * s;
  }
  return {sum[0], sum[1], sum[2], sum[3]};
}

/// Size of the last two terms relative to the rounding level of their states: a size of 1 is the rounding
/// level.
template <class Real>
struct Convergence {
  Real amp_limit, speed_limit, volt_limit;
  Real before = 0, last = 0;
  /// True at rest and without current. Then possibly only the terms 1, 4, 7, 10 are nonzero, so that a zero
  /// term does not show convergence. All orders are computed.
  bool from_nothing;

  Convergence(const Constants<Real>& c, const Expansion<Real>& y)
      : amp_limit(c.amp_limit),
        speed_limit(c.speed_limit),
        volt_limit(c.volt_limit),
        from_nothing(y.w[0] == 0 && y.i[0][0] == 0 && y.i[1][0] == 0) {}

  /// For a sinusoidal back-EMF the terms of its shape count too: without current only they determine the
  /// error of a floating terminal's voltage.
  template <bool sine, bool bus>
  void look(const SeriesBuilder<Real>& y, int n, Real currents, Real speed) {
    before = last;
    last = currents * amp_limit + speed * speed_limit;
    if constexpr (bus) last += abs(y.bus[n]) * volt_limit;
    if constexpr (sine) last += (abs(y.phi0[n]) + abs(y.phi1[n])) * terms_per_scale<Real>;
  }
  /// For a linear system y' = A y, term n + 1 is at most h |A|/(n + 1) of term n, and useful_length() limits
  /// h |A| to 1/2. After a term of 8 rounding levels, the sum of all later terms is therefore below one
  /// level. A single term may be zero by symmetry. A small term therefore shows convergence only if the
  /// previous term (`before`) was small too.
  // mutant: !from_nothing => true
  bool reached() const { return last < 8 && before < 4096 && !from_nothing; }
};

/// Working data of one segment's recurrence, all in registers or on the stack.
template <bool bus, class Currents, class Real>
struct Recurrence {
  Rotor<Real> rotor;
  Currents currents;
  BusLaw<Real> bus_law;
  Convergence<Real> convergence;
  SeriesBuilder<Real> y;

  template <class Shape>
  Recurrence(const Constants<Real>& c, const Mode& mode, const LegsLaw<Real>& law, const Shape& shape,
             const Expansion<Real>& out)
      : rotor(c, mode.motion), currents(rotor, c, law, shape), bus_law(c, mode, law), convergence(c, out) {
    y.h = out.h;
    y.w[0] = out.w[0];
    y.x[0] = out.x[0];
    y.bus[0] = out.bus[0];
    if constexpr (Currents::sine_shape) {
      y.phi0[0] = out.phi0[0];
      y.phi1[0] = out.phi1[0];
    }
    currents.start(out, y);
  }

  /// Increments over the whole segment. The first terms are added last, because they are the largest.
  void add_up(Expansion<Real>& out) const {
    // mutant: y.later_i => Real(0)
    out.end = {y.i[1] + y.later_i, y.i_2[1] + y.later_i_2, y.w[1] + y.later_w, y.x[1] + y.later_x};
  }
  /// Computes terms n + 1 of all series from terms n; true if the series has converged.
  template <int n>
  [[gnu::always_inline]] inline bool take_order(Expansion<Real>& out) {
    const Real f = y.h * Real(1.0L / (n + 1));
    currents.template step<n, bus>(rotor, y, f);
    if constexpr (bus) bus_law.template step<n>(y, f, y.i[n], y.i_2[n]);
    write<n>(out);
    const Real size = currents.reached(y, n + 1), size_w = abs(y.w[n + 1]);
    y.reach_w += size_w;
    if constexpr (n > 0) {
      y.later_w += y.w[n + 1];
      y.later_x += y.x[n + 1];
    }
    if constexpr (n < 4)
      return false;  // nearly every segment needs more terms; the check would only cost
                     // time
    convergence.template look<Currents::sine_shape, bus>(y, n + 1, size, size_w);
    if (n < 5 || !convergence.reached()) return false;
    out.degree = n + 1;
    return true;
  }
  template <int n>
  [[gnu::always_inline]] inline void write(Expansion<Real>& out) const {
    currents.write(out, n + 1, y);
    out.w[n + 1] = y.w[n + 1];
    out.x[n + 1] = y.x[n + 1];
    out.torque[n] = y.torque[n];
    if constexpr (bus) out.bus[n + 1] = y.bus[n + 1];  // for a stiff bus the terms after the first are zero
    if constexpr (Currents::sine_shape) {
      out.phi0[n + 1] = y.phi0[n + 1];
      out.phi1[n + 1] = y.phi1[n + 1];
    }
  }
};

/// Computes the terms order by order, until the last two terms are below rounding level or the highest degree
/// is reached.
template <bool bus, class Currents, class Shape, class Real>
[[gnu::always_inline]] inline void recurrence_with(const Constants<Real>& c, const Mode& mode,
                                                   const LegsLaw<Real>& law, const Shape& shape,
                                                   Expansion<Real>& out) {
  Recurrence<bus, Currents, Real> r(c, mode, law, shape, out);
  out.degree = series::max_degree;
  [&]<int... n>(std::integer_sequence<int, n...>) __attribute__((always_inline)) {
    static_cast<void>((r.template take_order<n>(out) || ...));
  }
  (std::make_integer_sequence<int, series::max_degree>{});
  out.torque[out.degree] = 0;
  r.currents.reach(r.y, out.reach_i);
  out.reach_w = r.y.reach_w;
  r.add_up(out);
  // mutant: c.pole_pairs * out.h * r.y.reach_w / 2 => Real(0)
  out.later_x = c.pole_pairs * out.h * r.y.reach_w / 2;  // x_(n+1) = p h w_n/(n + 1)
  out.reach_x = abs(out.x[1]) + out.later_x;
  if (r.convergence.reached()) return;
  shorten(out, r.convergence.last, r.convergence.before);
  out.end = increments(out, law, Real(1));
}

/// Processors for which a recurrence is compiled: any processor, or x86-64 with AVX. The three-operand
/// instructions of AVX save a fifth of the move instructions. Both builds execute the same operations in the
/// same order, so that the results have the same bits.
enum class Build : std::uint8_t { any, avx };

template <Build build, bool bus, class Currents, class Shape, class Real>
struct Compiled {
  static void recurrence(const Constants<Real>& c, const Mode& mode, const LegsLaw<Real>& law,
                         const Shape& shape, Expansion<Real>& y) {
    recurrence_with<bus, Currents>(c, mode, law, shape, y);
  }
};
#ifdef __x86_64__
template <bool bus, class Currents, class Shape, class Real>
struct Compiled<Build::avx, bus, Currents, Shape, Real> {
  [[gnu::target("avx")]] static void recurrence(const Constants<Real>& c, const Mode& mode,
                                                const LegsLaw<Real>& law, const Shape& shape,
                                                Expansion<Real>& y) {
    recurrence_with<bus, Currents>(c, mode, law, shape, y);
  }
};
#endif

template <Build build, class Currents, class Shape, class Real>
void recurrence(const Constants<Real>& c, const Mode& mode, const LegsLaw<Real>& law, const Shape& shape,
                Expansion<Real>& y) {
  if (c.inv_C > 0)
    Compiled<build, true, Currents, Shape, Real>::recurrence(c, mode, law, shape, y);
  else
    Compiled<build, false, Currents, Shape, Real>::recurrence(c, mode, law, shape, y);
}

template <bool sine, Build build, class Real>
void expand_shape(const Constants<Real>& c, const Mode& mode, Expansion<Real>& y) {
  const EmfPiece<Real>& piece = c.emf[mode.sector].piece[mode.piece];
  const LegsLaw<Real>& law = c.legs[legs_index(mode.legs)];
  const ShapeLine<sine, Real> shape(piece, y.x[0]);
  if (law.connected == 3) return recurrence<build, TwoCurrents<sine, Real>>(c, mode, law, shape, y);
  if (law.connected < 2) return recurrence<build, NoCurrent<sine, Real>>(c, mode, law, shape, y);
  if constexpr (!sine) {
    // mutant: piece.beta[law.leg[0]] == piece.beta[law.leg[1]] => piece.beta[law.leg[0]] == 0
    const bool flat = piece.beta[law.leg[0]] == piece.beta[law.leg[1]];
    if (flat && is_line_over_speed(torques(c, mode.motion)))
      return recurrence<build, FlatPair<Real>>(c, mode, law, shape, y);
  }
  recurrence<build, OneCurrent<sine, Real>>(c, mode, law, shape, y);
}

template <class Real>
void expand_trapezoid(const Constants<Real>& c, const Mode& mode, Expansion<Real>& y) {
  expand_shape<false, Build::any>(c, mode, y);
}
template <class Real>
void expand_sine(const Constants<Real>& c, const Mode& mode, Expansion<Real>& y) {
  expand_shape<true, Build::any>(c, mode, y);
}

// The unrolled code needs most of the compile time of a plant. For double it is therefore compiled once, in
// expand.cpp. expand.cpp also selects the build at run time.
void expand_trapezoid(const Constants<double>& c, const Mode& mode, Expansion<double>& y);
void expand_sine(const Constants<double>& c, const Mode& mode, Expansion<double>& y);
extern template void expand_shape<false, Build::any>(const Constants<double>&, const Mode&,
                                                     Expansion<double>&);
extern template void expand_shape<true, Build::any>(const Constants<double>&, const Mode&,
                                                    Expansion<double>&);
#ifdef __x86_64__
/// True if this processor has AVX; checked once at program start.
extern const bool has_avx;
extern template void expand_shape<false, Build::avx>(const Constants<double>&, const Mode&,
                                                     Expansion<double>&);
extern template void expand_shape<true, Build::avx>(const Constants<double>&, const Mode&,
                                                    Expansion<double>&);
#endif

}  // namespace detail

/// Expands the state in the given mode over the time `wanted`, s, or over less if the accuracy requires it.
template <class Real>
void expand(const Constants<Real>& c, const State<Real>& state, const Mode& mode, Real wanted,
            Expansion<Real>& y) {
  y.h = wanted;
  for (int k = 0; k < 3; ++k) y.i[k][0] = state.i[k];
  y.w[0] = turns(mode.motion) ? state.w : Real(0);
  y.x[0] = state.x;
  y.bus[0] = state.bus;
  if (c.sine) {
    const base::SinCos shape = base::sin_cos(static_cast<double>(state.x));
    y.phi0[0] = static_cast<Real>(shape.cos);
    y.phi1[0] = static_cast<Real>(shape.sin);
    detail::expand_sine(c, mode, y);
  } else {
    detail::expand_trapezoid(c, mode, y);
  }
}

/// The length, s, for which one series suffices: `wanted`, but at most half of the fastest time constant.
/// Nearly all segments are short enough, and the function needs no division.
template <class Real>
Real useful_length(const Constants<Real>& c, const State<Real>& state, Real wanted) {
  const Real rate = c.steady_rate + c.pole_pairs * detail::abs(state.w);
  return wanted * rate <= Real(0.5) ? wanted : Real(0.5) / rate;
}

}  // namespace sixstep::plant
