// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/wiring/pair_torque.hpp"

#include <algorithm>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/series/quadrature.hpp"

namespace sixstep::analysis {
namespace {

/// Angle from theta_e to the magnet's axis (model.md 7).
constexpr double axis_rad = 2.5 * base::sector_rad;

/// Eight Gauss points on each eighth of a sector. The rule is exact for the lines of a trapezoid. For the
/// square of a harmonic of order 25, which turns by 6.5 rad within an eighth, the relative error is 1e-9.
constexpr int stretches = 8;

}  // namespace

PairTorque::PairTorque(const plant::general::Machine& machine, double current_A)
    : machine_(machine), table_(plant::general::shape_table<double>(machine)), current_A_(current_A) {}

double PairTorque::of_axes(double electrical_rad, std::size_t source, std::size_t sink) const {
  double i_d = 0.0, i_q = 0.0;
  for (const auto& [phase, current] : {std::pair{source, current_A_}, {sink, -current_A_}}) {
    const base::SinCos axis =
        base::sin_cos(electrical_rad - axis_rad - 2 * base::sector_rad * static_cast<double>(phase));
    i_d += 2.0 / 3 * current * axis.cos;
    i_q -= 2.0 / 3 * current * axis.sin;
  }
  const double bent = machine_.saturation_A > 0.0 ? 1 - i_d / (2 * machine_.saturation_A) : 1.0;
  const double lambda_d = machine_.L_d_H * i_d * bent, lambda_q = machine_.L_q_H * i_q;
  return 1.5 * machine_.pole_pairs * (lambda_d * i_q - lambda_q * i_d) / current_A_;
}

double PairTorque::emf_V_s(std::uint8_t sector, double x, std::size_t phase) const {
  const auto& pieces = table_.sector[sector];
  std::size_t n = 0;
  while (n + 1 < pieces.size() && x > pieces[n].to) ++n;
  double sum = pieces[n].now[phase] + pieces[n].rise[phase] * x;
  for (const auto& r : table_.rotations) {
    const base::SinCos turned = base::sin_cos(r.order * (sector * base::sector_rad + x));
    sum += r.cos[phase] * turned.cos + r.sin[phase] * turned.sin;
  }
  return sum;
}

double PairTorque::at(std::uint8_t sector, double x, std::size_t source, std::size_t sink) const {
  const double of_magnets = emf_V_s(sector, x, source) - emf_V_s(sector, x, sink);
  return machine_.has_axes() ? of_magnets + of_axes(sector * base::sector_rad + x, source, sink) : of_magnets;
}

PairTorque::Means PairTorque::means(std::uint8_t sector, double from, double to, std::size_t source,
                                    std::size_t sink) const {
  const auto& g = series::gauss<8>;
  Means out;
  for (const auto& p : table_.sector[sector]) {
    const double begin = std::max(from, p.from), length = std::min(to, p.to) - begin;
    if (!(length > 0.0)) continue;
    for (int n = 0; n < stretches; ++n)
      for (std::size_t k = 0; k < g.node.size(); ++k) {
        const double x = begin + length * (n + static_cast<double>(g.node[k])) / stretches;
        const double torque = at(sector, x, source, sink);
        const double weight = length / stretches * static_cast<double>(g.weight[k]) / (to - from);
        out.torque += weight * torque;
        out.square += weight * torque * torque;
      }
  }
  return out;
}

}  // namespace sixstep::analysis
