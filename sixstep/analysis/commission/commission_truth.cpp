// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/commission/commission_truth.hpp"

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/design/sheet/thermal.hpp"
#include "sixstep/plant/general/shape.hpp"

namespace sixstep::analysis {
namespace {

using plant::general::Machine;

bool is_sine(const Machine& m) { return m.shape.harmonics.size() == 1; }

/// Integral of (n + r x) e^-j(begin + x) over x, in closed form.
struct Coefficient {
  double re = 0.0, im = 0.0;
  void add(double n, double r, double begin, double from, double to) {
    const auto at = [&](double x, double sign) {
      const base::SinCos c = base::sin_cos(begin + x);
      // Integral of (n + r x) cos is (n + r x) sin + r cos, of (n + r x) sin is r sin - (n + r x) cos.
      re += sign * ((n + r * x) * c.sin + r * c.cos);
      im -= sign * (r * c.sin - (n + r * x) * c.cos);
    };
    at(to, 1.0);
    at(from, -1.0);
  }
};

}  // namespace

double flux_linkage_of(const Machine& m) {
  if (!m.shape.harmonics.empty()) {
    double size = 0.0;
    for (const plant::general::Harmonic& h : m.shape.harmonics)
      if (h.order == 1) size += h.size;
    return std::fabs(size) * m.K_e_V_s[0] / m.pole_pairs;
  }
  Coefficient c;
  const auto table = plant::general::shape_table<double>(m);
  for (std::size_t sector = 0; sector < 6; ++sector)
    for (const auto& piece : table.sector[sector])
      c.add(piece.now[0], piece.rise[0], static_cast<double>(sector) * base::sector_rad, piece.from,
            piece.to);
  return std::sqrt(c.re * c.re + c.im * c.im) / base::pi / m.pole_pairs;
}

CommissionTruth truth_of(const study::GeneralPlant& plant, double in_diode) {
  const Machine& m = plant.machine;
  CommissionTruth t;
  t.degC = design::sheet_degC;
  double R = 0.0;
  for (const double phase : m.R_ohm) R += phase / 3;
  t.R_ohm = R + plant.devices.R_on_ohm * (1 - in_diode) + plant.devices.r_d_ohm * in_diode;
  t.L_H = m.has_axes() ? m.L_d_H : m.L_H;
  t.beyond_L_H = m.has_axes() ? m.L_q_H - m.L_d_H : 0.0;
  t.flux_linkage_Vs = flux_linkage_of(m);
  t.sine = is_sine(m);
  for (const plant::general::Cogging& c : m.cogging) t.cogging_Nm += std::fabs(c.torque_Nm);
  return t;
}

}  // namespace sixstep::analysis
