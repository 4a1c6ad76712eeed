// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/emf/harmonic_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sixstep/analysis/identification/emf/harmonic_points.hpp"
#include "sixstep/analysis/identification/emf/residual_spectrum.hpp"
#include "sixstep/analysis/identification/emf/step_errors.hpp"
#include "sixstep/analysis/identification/symmetric.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::analysis {
namespace {

/// The fit of one channel at a given phase: offset, a_1, b_1, a_2 and so on, and their cofactors.
struct Linear {
  std::vector<double> unknowns;
  Symmetric cofactors;
  double residual_square = 0.0;
};

class Fitter {
 public:
  Fitter(const HarmonicPoints& points, std::size_t harmonics)
      : points_(points), turning_(harmonics), harmonics_(harmonics) {}

  std::optional<Linear> linear(std::size_t channel, const EmfPhase& phase) {
    NormalEquations equations(2 * harmonics_ + 1);
    std::vector<double> row(2 * harmonics_ + 1);
    for (std::size_t n = 0; n < points_.t_s.size(); ++n) {
      fill(row, phase, points_.t_s[n]);
      equations.add(row, points_.u_V[channel][n]);
    }
    std::optional<Solution> found = solution_of(equations);
    if (!found) return {};
    Linear out{std::move(found->unknowns), std::move(found->cofactors), 0.0};
    each_residual(channel, phase, out, [&](double, double r) { out.residual_square += r * r; });
    return out;
  }

  /// Adds the equations of the phase's rates. They follow from the residual with free harmonics: a
  /// Gauss-Newton step with the linear unknowns eliminated.
  void add_phase_equations(std::size_t channel, const EmfPhase& phase, const Linear& linear, Symmetric& left,
                           std::vector<double>& right) {
    const std::size_t free = 2 * harmonics_ + 1, terms = phase.terms;
    std::vector<double> row(free), slope(terms), cross(free * terms), down(terms);
    Symmetric own(terms);
    const auto points = static_cast<double>(points_.t_s.size());
    const double weight = points / std::max(linear.residual_square, 1e-30 * points);
    for (std::size_t n = 0; n < points_.t_s.size(); ++n) {
      fill(row, phase, points_.t_s[n]);
      double value = 0.0;
      for (std::size_t k = 0; k < free; ++k) value += row[k] * linear.unknowns[k];
      slopes(slope, phase, linear, points_.t_s[n]);
      for (std::size_t i = 0; i < terms; ++i) {
        down[i] += slope[i] * (points_.u_V[channel][n] - value);
        for (std::size_t k = 0; k <= i; ++k) own.at(i, k) += slope[i] * slope[k];
        for (std::size_t k = 0; k < free; ++k) cross[i * free + k] += slope[i] * row[k];
      }
    }
    for (std::size_t i = 0; i < terms; ++i) {
      right[i] += weight * down[i];
      for (std::size_t k = 0; k <= i; ++k) {
        double taken = 0.0;
        for (std::size_t a = 0; a < free; ++a)
          for (std::size_t b = 0; b < free; ++b)
            taken += cross[i * free + a] * linear.cofactors.at(a, b) * cross[k * free + b];
        left.at(i, k) += weight * (own.at(i, k) - taken);
      }
    }
  }

  /// Calls `take` with the phase and the residual of each point.
  template <class Take>
  void each_residual(std::size_t channel, const EmfPhase& phase, const Linear& linear, Take take) {
    std::vector<double> row(2 * harmonics_ + 1);
    for (std::size_t n = 0; n < points_.t_s.size(); ++n) {
      fill(row, phase, points_.t_s[n]);
      double r = points_.u_V[channel][n];
      for (std::size_t k = 0; k < row.size(); ++k) r -= row[k] * linear.unknowns[k];
      take(phase.at(points_.t_s[n]), r);
    }
  }

 private:
  void fill(std::vector<double>& row, const EmfPhase& phase, double t_s) {
    turning_.at(phase.at(t_s));
    const double scale = phase.speed(t_s) / phase.rate[0];
    row[0] = 1.0;
    for (std::size_t h = 0; h < harmonics_; ++h) {
      row[2 * h + 1] = scale * turning_.cos(h);
      row[2 * h + 2] = scale * turning_.sin(h);
    }
  }

  /// d u/d rate[k], at the point of the last fill().
  void slopes(std::vector<double>& out, const EmfPhase& phase, const Linear& linear, double t_s) {
    const double w0 = phase.rate[0], tau = t_s - phase.middle_s, scale = phase.speed(t_s) / w0;
    double value = 0.0, by_phase = 0.0;
    for (std::size_t h = 0; h < harmonics_; ++h) {
      const double a = linear.unknowns[2 * h + 1], b = linear.unknowns[2 * h + 2];
      value += a * turning_.cos(h) + b * turning_.sin(h);
      by_phase += static_cast<double>(h + 1) * (b * turning_.cos(h) - a * turning_.sin(h));
    }
    double speed_term = 1.0;
    for (std::size_t k = 0; k < phase.terms; ++k) {
      const double phase_term = speed_term * tau / static_cast<double>(k + 1);
      out[k] = scale * by_phase * phase_term + value * (speed_term - (k == 0 ? scale : 0.0)) / w0;
      speed_term = phase_term;
    }
  }

  const HarmonicPoints& points_;
  Turning turning_;
  std::size_t harmonics_;
};

base::Problem not_periodic(const std::string& where) {
  return {
      .where = where,
      .limit = "is not a voltage that repeats from period to period",
      .cure =
          "turn the shaft from outside during the recording, with only the probes connected to the motor"};
}

double least_step(const std::vector<double>& u) {
  double least = 0.0;
  for (std::size_t n = 1; n < u.size(); ++n) {
    const double step = std::fabs(u[n] - u[n - 1]);
    if (step > 0.0 && (least == 0.0 || step < least)) least = step;
  }
  return least;
}

/// The noise of single rows, without the rounding to the converter's steps. Uses a part of the rows if there
/// are more than `enough`.
double row_noise(const EmfRecord& record, std::size_t channel, const EmfPhase& phase, const Linear& linear,
                 double step_V) {
  constexpr std::size_t enough = 20'000;
  const std::vector<double>& u = record.channels[channel].u_V;
  const std::size_t stride = std::max<std::size_t>(1, u.size() / enough),
                    harmonics = (linear.unknowns.size() - 1) / 2;
  Turning turning(harmonics);
  double square = 0.0, rows = 0.0;
  for (std::size_t n = 0; n < u.size(); n += stride) {
    turning.at(phase.at(record.t_s[n]));
    double value = 0.0;
    for (std::size_t h = 0; h < harmonics; ++h)
      value += linear.unknowns[2 * h + 1] * turning.cos(h) + linear.unknowns[2 * h + 2] * turning.sin(h);
    const double r = u[n] - linear.unknowns[0] - value * phase.speed(record.t_s[n]) / phase.rate[0];
    square += r * r;
    rows += 1.0;
  }
  return std::sqrt(std::max(0.0, square / rows - step_V * step_V / 12.0));
}

ChannelFit channel_of(Fitter& fitter, const EmfRecord& record, const HarmonicPoints& points,
                      std::size_t channel, const HarmonicFit& fit, const Linear& linear) {
  const std::size_t harmonics = (linear.unknowns.size() - 1) / 2;
  ResidualSpectrum beside(harmonics, fit.periods);
  fitter.each_residual(channel, fit.phase, linear, [&](double phase, double r) { beside.take(phase, r); });
  ChannelFit out;
  out.offset_V = linear.unknowns[0];
  out.residual_rms_V = std::sqrt(linear.residual_square / static_cast<double>(points.t_s.size()));
  double mean = 0.0, square = 0.0;
  for (const double u : points.u_V[channel]) mean += u / static_cast<double>(points.t_s.size());
  for (const double u : points.u_V[channel]) square += (u - mean) * (u - mean);
  out.explained = 1.0 - linear.residual_square / square;
  out.step_V = least_step(record.channels[channel].u_V);
  const StepErrors steps =
      step_errors({linear.unknowns, out.step_V, row_noise(record, channel, fit.phase, linear, out.step_V)});
  out.step_at_peak_V = steps.peak_V;
  for (std::size_t h = 0; h < harmonics; ++h) {
    const double left = left_by_averaging(points, fit.phase.rate[0] * static_cast<double>(h + 1));
    const double cofactor =
        0.5 * (linear.cofactors.at(2 * h + 1, 2 * h + 1) + linear.cofactors.at(2 * h + 2, 2 * h + 2));
    out.harmonics.push_back(
        {linear.unknowns[2 * h + 1] / left, linear.unknowns[2 * h + 2] / left,
         std::sqrt(beside.variance(h) * cofactor + steps.harmonics_V[h] * steps.harmonics_V[h]) / left,
         beside.degrees_of_freedom(h)});
  }
  return out;
}

/// Fits all channels at the present phase, and corrects the phase by these fits.
class Iteration {
 public:
  Iteration(const EmfRecord& record, const HarmonicPoints& points, std::size_t harmonics)
      : record_(record), fitter_(points, harmonics), linear_(record.channels.size()) {}

  /// One Gauss-Newton step. Returns the change of the phase at the recording's ends, rad. Empty if no step is
  /// possible.
  std::optional<double> step(EmfPhase& phase) {
    left_ = Symmetric(phase.terms);
    std::vector<double> right(phase.terms);
    for (std::size_t c = 0; c < linear_.size(); ++c) {
      std::optional<Linear> found = fitter_.linear(c, phase);
      if (!found) return {};
      linear_[c] = std::move(*found);
      fitter_.add_phase_equations(c, phase, linear_[c], left_, right);
    }
    left_.mirror();
    const std::optional<Cholesky> factors = Cholesky::of(left_);
    if (!factors) return {};
    const std::vector<double> change = factors->solve(right);
    const double half_s = 0.5 * (record_.t_s.back() - record_.t_s.front());
    double moved = 0.0, term = 1.0;
    for (std::size_t k = 0; k < change.size(); ++k) {
      term *= half_s / static_cast<double>(k + 1);
      moved += std::fabs(change[k]) * term;
    }
    constexpr double longest = 0.5;
    const double part = std::min(1.0, longest / std::max(moved, 1e-300));
    for (std::size_t k = 0; k < change.size(); ++k) phase.rate[k] += part * change[k];
    if (!(phase.rate[0] > 0.0)) return {};
    return moved;
  }

  const Linear& linear(std::size_t channel) const { return linear_[channel]; }
  Fitter& fitter() { return fitter_; }
  /// Standard deviation of the speed at the middle if the residual is white.
  double speed_deviation() const {
    const std::optional<Cholesky> factors = Cholesky::of(left_);
    return factors ? std::sqrt(factors->inverse().at(0, 0)) : 0.0;
  }

 private:
  const EmfRecord& record_;
  Fitter fitter_;
  std::vector<Linear> linear_;
  Symmetric left_;
};

/// Copies the channels from the last step. Computes the speed's deviation from the noise near the channels'
/// fundamentals.
base::Problems take_channels(const EmfRecord& record, const HarmonicPoints& points, Iteration& iteration,
                             HarmonicFit& out) {
  constexpr double least_explained = 0.5;
  double coloured = 0.0;  // noise near the fundamental, divided by its value for a white residual
  for (std::size_t c = 0; c < record.channels.size(); ++c) {
    out.channels.push_back(channel_of(iteration.fitter(), record, points, c, out, iteration.linear(c)));
    const ChannelFit& of_c = out.channels.back();
    if (!(of_c.explained > least_explained)) return {not_periodic(record.channels[c].name)};
    const double white = of_c.residual_rms_V * std::sqrt(2.0 / static_cast<double>(points.t_s.size()));
    coloured = std::max(coloured, white > 0.0 ? of_c.harmonics[0].deviation_V / white : 1.0);
  }
  out.degrees_of_freedom = out.channels[0].harmonics[0].degrees_of_freedom;
  out.speed_deviation = coloured * iteration.speed_deviation();
  return {};
}

}  // namespace

double fitted_V(const HarmonicFit& fit, std::size_t channel, double t_s) {
  const ChannelFit& c = fit.channels[channel];
  Turning turning(c.harmonics.size());
  turning.at(fit.phase.at(t_s));
  double value = 0.0;
  for (std::size_t h = 0; h < c.harmonics.size(); ++h)
    value += c.harmonics[h].a_V * turning.cos(h) + c.harmonics[h].b_V * turning.sin(h);
  return c.offset_V + value * fit.phase.speed(t_s) / fit.phase.rate[0];
}

base::Result<HarmonicFit> fit_harmonics(const EmfRecord& record, const EmfPhase& rough) {
  constexpr int most_steps = 30;
  constexpr double nothing_rad = 1e-9, points_per_order = 2.5;
  HarmonicFit out;
  out.phase = rough;
  const double seconds = record.t_s.back() - record.t_s.front();
  out.periods = seconds * rough.rate[0] / base::turn_rad;
  const HarmonicPoints points = harmonic_points(record, out.periods);
  const double per_period = static_cast<double>(points.t_s.size()) / out.periods;
  const auto harmonics =
      static_cast<std::size_t>(std::min(per_period / points_per_order, double{most_harmonics}));
  if (harmonics < 3 || points.t_s.size() < 4 * harmonics)
    return base::Problem{.where = "time",
                         .limit = "has " + base::rounded(per_period, 2) + " rows in a period, " +
                                  std::to_string(points.t_s.size()) + " in all",
                         .cure = "record at least a hundred rows per period"};
  Iteration iteration(record, points, harmonics);
  for (int step = 0; step < most_steps; ++step) {
    const std::optional<double> moved = iteration.step(out.phase);
    if (!moved) return not_periodic(record.channels[0].name);
    if (*moved < nothing_rad) break;
  }
  out.periods = seconds * out.phase.rate[0] / base::turn_rad;
  // There is no spectrum between the harmonics; the caller rejects such a recording.
  if (!(out.periods > 1.0)) return out;
  if (base::Problems problems = take_channels(record, points, iteration, out); !problems.empty())
    return problems;
  return out;
}

}  // namespace sixstep::analysis
