// SPDX-License-Identifier: Apache-2.0
// Random recordings of open-circuit voltages, as an oscilloscope makes them, with their true values. The code
// follows docs/reference/notation.md and uses no function of the tested code.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "sixstep/analysis/identification/emf/emf.hpp"
#include "tests/analysis/identification/normal.hpp"

namespace sixstep::testing {

struct EmfTruth {
  std::uint64_t seed = 0;
  double frequency_Hz = 50.0;  ///< in the middle of the record
  double change_Hz_s = 0.0;
  double periods = 5.0;
  double rows_per_period = 2000.0;
  double flux_Vs = 5e-3;              ///< peak flux linkage of a phase's fundamental
  std::array<double, 26> cos_part{};  ///< amplitude by order, relative to the fundamental: of cos n (theta -
                                      ///< 60 deg)
  std::array<double, 26> sin_part{};
  int channels = 1;
  bool star = false, backward = false;
  double noise_V = 0.0, hum_V = 0.0, hum_Hz = 50.0, step_V = 0.0, wobble = 0.0;
  std::array<double, 3> offset_V{};
};

/// The voltage shape of phase a over the angle theta, with a fundamental of 1.
inline double phase_shape(const EmfTruth& t, double theta) {
  double sum = 0.0;
  for (std::size_t n = 1; n < t.cos_part.size(); ++n) {
    const double x = static_cast<double>(n) * (theta - std::numbers::pi / 3);
    sum += t.cos_part[n] * std::cos(x) + t.sin_part[n] * std::sin(x);
  }
  return sum;
}

/// Sets the Fourier series of a trapezoid with a flat top of `flat_deg`, so that the true value of each order
/// is known.
inline void make_trapezoid(EmfTruth& t, double flat_deg) {
  const double ramp = (180.0 - flat_deg) / 2.0 * std::numbers::pi / 180.0;  // from zero to the top
  const double first = std::sin(ramp);
  for (std::size_t n = 1; n < t.cos_part.size(); n += 2) {
    const auto order = static_cast<double>(n);
    // The middle of the top is at theta = 60 degrees. There, sin n x of the usual series becomes cos n y,
    // apart from the sign.
    t.cos_part[n] = std::sin(order * ramp) / (order * order) / first * (n % 4 == 1 ? 1.0 : -1.0);
  }
}

/// The largest value of a periodic function.
template <class Shape>
double largest(Shape shape) {
  double most = 0.0;
  for (int n = 0; n < 7200; ++n) most = std::max(most, std::fabs(shape(n * std::numbers::pi / 3600)));
  return most;
}
inline double true_line_peak(const EmfTruth& t) {
  return t.flux_Vs *
         largest([&](double x) { return phase_shape(t, x) - phase_shape(t, x - 2 * std::numbers::pi / 3); });
}

inline analysis::EmfRequest drawn_record(const EmfTruth& t) {
  Draw draw(t.seed ^ 0xa5a5u);
  analysis::EmfRequest out;
  out.record.between = t.star ? analysis::EmfBetween::star : analysis::EmfBetween::lines;
  const double seconds = t.periods / t.frequency_Hz, row_s = 1.0 / (t.frequency_Hz * t.rows_per_period);
  const double start = draw.between(0, 2 * std::numbers::pi), wobbled = draw.between(0, 6.28),
               hum = draw.between(0, 6.28);
  const double trigger_s = draw.between(-1.0, 1.0) * row_s - draw.between(0.0, 1.0) * seconds;
  const char* const names[] = {"ch1", "ch2", "ch3"};
  for (int c = 0; c < t.channels; ++c) out.record.channels.push_back({names[c], {}});
  const auto rows = static_cast<std::size_t>(std::floor(seconds / row_s)) + 1;
  const double last_s = static_cast<double>(rows - 1) * row_s;
  for (std::size_t n = 0; n < rows; ++n) {
    const double time = static_cast<double>(n) * row_s, tau = time - 0.5 * last_s;
    const double f = t.frequency_Hz + t.change_Hz_s * tau;
    const double wobble_Hz = 0.31 * t.frequency_Hz;
    double turns = t.frequency_Hz * tau + 0.5 * t.change_Hz_s * tau * tau;
    turns += t.wobble * std::sin(2 * std::numbers::pi * wobble_Hz * tau + wobbled) / (2 * std::numbers::pi);
    const double w = 2 * std::numbers::pi *
                     (f + t.wobble * wobble_Hz * std::cos(2 * std::numbers::pi * wobble_Hz * tau + wobbled));
    const double way = t.backward ? -1.0 : 1.0;
    const double theta = start + way * 2 * std::numbers::pi * turns;
    std::array<double, 3> e{};
    for (std::size_t k = 0; k < 3; ++k)
      e[k] = way * w * t.flux_Vs * phase_shape(t, theta - 2 * std::numbers::pi / 3 * static_cast<double>(k));
    out.record.t_s.push_back(trigger_s + time);
    for (std::size_t c = 0; c < static_cast<std::size_t>(t.channels); ++c) {
      double u = t.star ? e[c] : e[c] - e[(c + 1) % 3];
      u += t.offset_V[c] + t.noise_V * normal(draw) +
           t.hum_V * std::sin(2 * std::numbers::pi * t.hum_Hz * time + hum);
      if (t.step_V > 0.0) u = t.step_V * std::round(u / t.step_V);
      out.record.channels[c].u_V.push_back(u);
    }
  }
  return out;
}

inline EmfTruth drawn_emf(std::uint64_t seed) {
  Draw draw(seed + 77777);
  EmfTruth t;
  t.seed = seed;
  t.frequency_Hz = draw.decades(5.0, 1000.0);
  t.periods = draw.decades(1.7, 60.0);
  t.rows_per_period = draw.decades(100.0, 3000.0);
  t.rows_per_period = std::min(t.rows_per_period, 60'000.0 / t.periods);
  t.flux_Vs = draw.decades(1e-3, 5e-2);
  t.cos_part[1] = 1.0;
  const int kind = draw.one_of(3);
  if (kind == 0) make_trapezoid(t, draw.between(60.0, 140.0));
  if (kind == 1)
    for (const std::size_t n : {5, 7, 11, 13}) {
      t.cos_part[n] = 0.1 * normal(draw) / static_cast<double>(n);
      t.sin_part[n] = 0.02 * normal(draw) / static_cast<double>(n);
    }
  t.channels = 1 + draw.one_of(3);
  t.star = draw.chance(0.4);
  t.backward = t.channels > 1 && draw.chance(0.4);
  const double peak_V = 2 * std::numbers::pi * t.frequency_Hz * t.flux_Vs * 1.732;
  t.noise_V = peak_V * draw.decades(1e-3, 5e-2);
  t.step_V = draw.chance(0.7) ? peak_V * draw.decades(1.0 / 200, 1.0 / 40) : 0.0;
  if (draw.chance(0.3)) t.hum_V = peak_V * draw.decades(1e-3, 1e-2);
  if (t.periods > 4.0 && draw.chance(0.5))
    t.change_Hz_s = t.frequency_Hz * draw.between(-0.1, 0.1) * t.frequency_Hz / t.periods;
  if (t.periods > 4.0 && draw.chance(0.3)) t.wobble = draw.decades(1e-4, 3e-3);
  for (double& offset : t.offset_V) offset = peak_V * 0.1 * normal(draw);
  return t;
}

}  // namespace sixstep::testing
