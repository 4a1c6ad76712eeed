// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/harmonic_current.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/plant/general/shape.hpp"

namespace sixstep::design {

namespace {

using control::shape_points;

/// The magnet is 150 degrees behind the electrical angle: two whole sectors and half a sector.
constexpr double sector_middle_rad = 5 * base::pi / 6;

/// Back-EMF per speed of the three phases, V s, at the angle x, rad, after the start of a sector.
control::Abc<double> back_emf(const plant::general::ShapeTable<double>& table, std::size_t sector, double x) {
  std::array<double, 3> e{};
  const auto& pieces = table.sector[sector];
  const auto piece = std::find_if(pieces.begin(), pieces.end() - 1, [x](const auto& p) { return x < p.to; });
  for (std::size_t k = 0; k < 3; ++k) e[k] = piece->now[k] + piece->rise[k] * x;
  const double theta = static_cast<double>(sector) * base::sector_rad + x;
  for (const auto& r : table.rotations) {
    const base::SinCos at = base::sin_cos(r.order * theta);
    for (std::size_t k = 0; k < 3; ++k) e[k] += r.cos[k] * at.cos + r.sin[k] * at.sin;
  }
  return {e[0], e[1], e[2]};
}

/// Back-EMF per speed in the magnet's frame, mean over the six sectors, V s.
control::Dq<double> in_magnets_frame(const plant::general::ShapeTable<double>& table, double x) {
  control::Dq<double> mean;
  for (std::size_t s = 0; s < 6; ++s) {
    const base::SinCos at = base::sin_cos(static_cast<double>(s) * base::sector_rad + x - sector_middle_rad);
    const control::Dq<double> v =
        park(clarke(back_emf(table, s, x)), control::Direction<double>{at.cos, at.sin});
    mean.d += v.d / 6;
    mean.q += v.q / 6;
  }
  return mean;
}

double length(const control::Dq<double>& g) { return std::sqrt(g.d * g.d + g.q * g.q); }

}  // namespace

control::HarmonicCurrentConfig<double> harmonic_shape(const plant::general::Machine& machine,
                                                      double magnet_V_s) {
  const auto table = plant::general::shape_table<double>(machine);
  control::HarmonicCurrentConfig<double> c;
  c.on = true;
  for (int n = 0; n < shape_points; ++n) {
    // Magnet angle 0 is in the middle of a sector; the table therefore starts half a sector later.
    const int from = (n + shape_points / 2) % shape_points;
    control::Dq<double>& g = c.shape[n] = in_magnets_frame(table, from * base::sector_rad / shape_points);
    g.d /= magnet_V_s;
    g.q /= magnet_V_s;
    c.least = n == 0 ? length(g) : std::fmin(c.least, length(g));
  }
  return c;
}

bool is_sine(const control::HarmonicCurrentConfig<double>& config) {
  return std::all_of(std::begin(config.shape), std::end(config.shape), [](const control::Dq<double>& g) {
    return length({g.d, g.q - 1}) < 1e-12;
  });
}

double harmonic_lead_s(const FieldMachine& machine, const PiGains& across, double period_s) {
  const double K_i = across.d1 + across.d0;
  return K_i > 0 ? machine.R_ohm / K_i * period_s * machine.pole_pairs : 0.0;
}

HarmonicFigures harmonic_figures(const control::HarmonicCurrentConfig<double>& config) {
  double square = 0.0, mean = 0.0, least = config.shape[0].q, most = least;
  for (const control::Dq<double>& g : config.shape) {
    square += 1 / (g.d * g.d + g.q * g.q) / shape_points;
    mean += g.q / shape_points;
    least = std::fmin(least, g.q);
    most = std::fmax(most, g.q);
  }
  return {square * mean * mean, (most - least) / mean};
}

}  // namespace sixstep::design
