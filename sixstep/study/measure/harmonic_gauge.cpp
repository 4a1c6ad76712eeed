// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/harmonic_gauge.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/elementary.hpp"
#include "sixstep/series/quadrature.hpp"

namespace sixstep::study {

namespace {

constexpr double whole_turn = 6 * base::sector_rad;

/// Largest angle in rad by which a part of the signal turns if the frequency is given.
constexpr double largest_turn = 0.5;

/// The least even degree n after which the series of cos x and sin x have no term above rounding: x^n/n! <=
/// 2^-53. Products with cos x and sin x are integrated like products of the engine's series of degree n
/// (series/quadrature.hpp).
constexpr int degree_of_turn(double rad) {
  constexpr double largest[] = {0.0065, 0.038, 0.115, 0.247, 0.437};  // for degrees 6, 8, .. 14
  int degree = 6;
  for (const double x : largest) {
    if (rad <= x) break;
    degree += 2;
  }
  return degree;
}

}  // namespace

double whole_periods(const Window& window, double frequency_Hz) {
  return std::floor((window.to_s - window.from_s) * frequency_Hz + whole_enough);
}

HarmonicGauge::HarmonicGauge(const Window& window, Signal signal, std::optional<double> frequency_Hz)
    : window_(window), signal_(signal), frequency_Hz_(frequency_Hz) {
  if (frequency_Hz) window_.to_s = window.from_s + whole_periods(window, *frequency_Hz) / *frequency_Hz;
}

void HarmonicGauge::segment(const SegmentView& g, double s) {
  const Clip seen = clipped(window_, g.t_s, g.plant.expansion().h, s);
  if (seen.empty() || turned_back_) return;
  if (!begun_) {
    begun_ = true;
    first_sector_ = g.plant.state().sector;
    first_x_ = series::evaluate(g.plant.expansion().x, g.plant.expansion().degree, seen.from);
  }
  for_each_piece(g, signal_, seen.from, seen.to, [&](const Piece& y, double from, double to) {
    frequency_Hz_ ? time_part(g, y, from, to) : turn(g, y, from, to);
  });
}

/// Electrical angle in rad since the window's beginning.
double HarmonicGauge::swept(const SegmentView& g, double s) const {
  const plant::Expansion<double>& y = g.plant.expansion();
  return static_cast<double>(g.plant.state().sector - first_sector_) * base::sector_rad +
         (series::evaluate(y.x, y.degree, s) - first_x_);
}

/// Adds a part of the signal. If the part completes a turn, the fit up to the end of that turn is stored.
void HarmonicGauge::turn(const SegmentView& g, const Piece& y, double from, double to) {
  const plant::Expansion<double>& e = g.plant.expansion();
  const double moved = swept(g, to) - swept(g, from);
  if (moved == 0.0) return;
  if (direction_ == 0.0) direction_ = moved < 0.0 ? -1.0 : 1.0;
  if (direction_ * moved < 0.0) {
    turned_back_ = true;
    return;
  }
  Series missing = series::restricted(e.x, e.degree, from, to);  // positive until the turn is full
  for (double& v : missing) v *= -direction_;
  missing[0] = static_cast<double>(turns_ + 1) * whole_turn - direction_ * swept(g, from);
  const double root = missing[0] <= 0.0 ? 0.0 : series::first_root(missing, e.degree, 1.0, 0.0);
  if (root > 1.0) return turn_part(g, y, from, to);
  const double full = from + root * (to - from);
  const auto share = [&](double begin, double end) {
    return Piece{series::restricted(y.c, y.degree, begin, end), y.degree};
  };
  if (root > 0.0) turn_part(g, share(0.0, root), from, full);
  ++turns_;
  whole_ = fit_;
  if (root < 1.0) turn_part(g, share(root, 1.0), full, to);
}

/// Phase since the window's beginning. Whole turns are subtracted, so that the phase keeps its digits.
Phase HarmonicGauge::phase_at(const SegmentView& g, double s) const {
  const plant::Expansion<double>& y = g.plant.expansion();
  const double sectors = static_cast<double>((g.plant.state().sector - first_sector_) % 6);
  return phase_of(sectors * base::sector_rad + (series::evaluate(y.x, y.degree, s) - first_x_));
}

/// The number of points follows from a degree n: the degree of the segment's series or of the series of cos
/// and sin over this turn, whichever is higher, and at least 8. Products have three factors here, because the
/// speed is the weight. With x, M and u as in series/quadrature.hpp, the error bound is then (pi/2) (3/4)^n
/// e^(3 x) u M^3, which is below u M^3/5 for n of 8 or more.
void HarmonicGauge::turn_part(const SegmentView& g, const Piece& y, double from, double to) {
  const plant::Expansion<double>& e = g.plant.expansion();
  const double per_s = direction_ * g.plant.pole_pairs() * e.h * (to - from);
  const double up_to = swept(g, to), turn = std::fabs(up_to - swept(g, from));
  const double x_from = series::evaluate(e.x, e.degree, from);
  series::with_points_for(std::max({e.degree, 8, degree_of_turn(turn)}), [&]<int points>() {
    using series::values_at;
    const auto node = series::nodes_up_to<points>(1.0), at = from + (to - from) * node;
    auto angle = per_s * values_at<points>(e.w, e.degree, at);  // angle within this part, per unit of weight
    for (int k = 0; k < points; ++k) {
      if (angle[k] < 0.0) turned_back_ = true;
      if (!(angle[k] > 0.0)) angle.set(k, 0.0);
    }
    const FittedPart<points> part{
        .weight = series::as_nodes<points, double>(series::gauss<points>.weight) * angle,
        .turn = values_at<points>(e.x, e.degree, at) - x_from,
        .signal = values_at<points>(y.c, y.degree, node)};
    fit_.add(phase_at(g, from), part);
  });
  swept_ = direction_ * up_to;
}

void HarmonicGauge::time_part(const SegmentView& g, const Piece& y, double from, double to) {
  const double h = g.plant.expansion().h, length = h * (to - from);
  const double rate = 2 * base::pi * *frequency_Hz_;
  const std::int64_t count = 1 + static_cast<std::int64_t>(rate * length / largest_turn);
  const double share = 1.0 / static_cast<double>(count), turn = rate * length * share;
  const double begin_s = g.t_s + h * from - window_.from_s;
  series::with_points_for(std::max(y.degree, degree_of_turn(turn)), [&]<int points>() {
    const auto node = series::nodes_up_to<points>(share);
    FittedPart<points> part{
        .weight = (length * share) * series::as_nodes<points, double>(series::gauss<points>.weight),
        .turn = series::nodes_up_to<points>(turn),
        .signal = {}};
    for (std::int64_t n = 0; n < count; ++n) {
      const double done = static_cast<double>(n) * share;
      part.signal = series::values_at<points>(y.c, y.degree, node + done);
      fit_.add(phase_of(rate * (begin_s + done * length)), part);
    }
  });
  seconds_ += length;
}

std::optional<double> HarmonicGauge::thd() const {
  if (frequency_Hz_) {
    const double periods = whole_periods(window_, *frequency_Hz_);
    // false: the run ended within the window
    const bool all = seconds_ * *frequency_Hz_ >= periods - 2 * whole_enough;
    return periods >= 1.0 && all ? std::optional(fit_.distortion()) : std::nullopt;
  }
  if (turned_back_) return std::nullopt;
  const double lacking = static_cast<double>(turns_ + 1) * whole_turn - swept_;
  if (lacking <= whole_enough * whole_turn) return fit_.distortion();
  return turns_ > 0 ? std::optional(whole_.distortion()) : std::nullopt;
}

}  // namespace sixstep::study
