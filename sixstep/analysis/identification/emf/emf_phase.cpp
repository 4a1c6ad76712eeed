// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/emf/emf_phase.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/identification/emf/emf_doubts.hpp"
#include "sixstep/analysis/identification/symmetric.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::analysis {
namespace {

struct Level {
  double mean = 0.0, rms = 0.0;  ///< rms about the mean
};
Level level_of(const std::vector<double>& u) {
  Level out;
  for (const double x : u) out.mean += x;
  out.mean /= static_cast<double>(u.size());
  for (const double x : u) out.rms += (x - out.mean) * (x - out.mean);
  out.rms = std::sqrt(out.rms / static_cast<double>(u.size()));
  return out;
}

struct Curve {
  std::vector<double> t_s, u_V;
};

/// Averages `rows` rows into one.
Curve averaged(const std::vector<double>& t, const std::vector<double>& u, std::size_t rows) {
  Curve out;
  for (std::size_t n = 0; n + rows <= u.size(); n += rows) {
    double t_sum = 0.0, u_sum = 0.0;
    for (std::size_t k = n; k < n + rows; ++k) t_sum += t[k] - t[n], u_sum += u[k];
    out.t_s.push_back(t[n] + t_sum / static_cast<double>(rows));
    out.u_V.push_back(u_sum / static_cast<double>(rows));
  }
  return out;
}

/// Times at which the voltage crosses its mean, alternately up and down. Between two crossings the voltage
/// must exceed a fraction of its rms, so that noise adds no crossing.
std::vector<double> crossings(const Curve& curve, const Level& level) {
  constexpr double beyond = 0.5;
  std::vector<double> out;
  int side = 0;
  std::size_t last_inside = 0;  // the last row on the side of the mean where the voltage was
  for (std::size_t n = 0; n < curve.u_V.size(); ++n) {
    const double x = curve.u_V[n] - level.mean;
    if (side != 0 && x * side > 0.0) last_inside = n;
    const int now = x > beyond * level.rms ? 1 : x < -beyond * level.rms ? -1 : 0;
    if (now == 0 || now == side) continue;
    if (side != 0) out.push_back(0.5 * (curve.t_s[last_inside] + curve.t_s[std::min(last_inside + 1, n)]));
    side = now;
    last_inside = n;
  }
  return out;
}

/// True if successive half waves have similar lengths. Spikes cause half waves of very different lengths.
bool are_regular(const std::vector<double>& passed) {
  constexpr double alike = 3.0;
  for (std::size_t n = 2; n < passed.size(); ++n) {
    const double before = passed[n - 1] - passed[n - 2], here = passed[n] - passed[n - 1];
    if (before > alike * here || here > alike * before) return false;
  }
  return true;
}

/// Averages over an increasing number of rows, until noise causes no crossings.
std::vector<double> regular_crossings(const std::vector<double>& t, const std::vector<double>& u,
                                      const Level& level) {
  constexpr std::size_t fewest_points = 24;
  std::vector<double> passed;
  for (std::size_t rows = 1; rows == 1 || u.size() / rows >= fewest_points; rows *= 2) {
    passed = crossings(averaged(t, u, rows), level);
    if (are_regular(passed)) return passed;
  }
  return {};
}

}  // namespace

double EmfPhase::at(double t_s) const {
  const double tau = t_s - middle_s;
  double term = 1.0, sum = 0.0;
  for (std::size_t k = 0; k < terms; ++k) {
    term *= tau / static_cast<double>(k + 1);
    sum += rate[k] * term;
  }
  return sum;
}

double EmfPhase::speed(double t_s) const {
  const double tau = t_s - middle_s;
  double term = 1.0, sum = rate[0];
  for (std::size_t k = 1; k < terms; ++k) {
    term *= tau / static_cast<double>(k);
    sum += rate[k] * term;
  }
  return sum;
}

std::size_t phase_terms(double periods) { return periods < 4.0 ? 1 : periods < 10.0 ? 2 : 3; }

base::Result<EmfPhase> rough_phase(const EmfRecord& record) {
  const EmfChannel* strongest = nullptr;
  Level level;
  for (const EmfChannel& c : record.channels) {
    const Level of_this = level_of(c.u_V);
    if (strongest && of_this.rms <= level.rms) continue;
    strongest = &c;
    level = of_this;
  }
  const std::string name = strongest->name;
  if (!(level.rms > 1e-9 * std::fabs(level.mean) && level.rms > 0.0))
    return base::Problem{.where = name,
                         .value = base::rounded(level.mean, 4) + " V",
                         .limit = "in every row: the motor was at rest, or the probe was not connected",
                         .cure = "turn the motor during the recording"};
  const std::vector<double> passed = regular_crossings(record.t_s, strongest->u_V, level);
  if (passed.size() < 3) {
    const std::size_t in_all = crossings({record.t_s, strongest->u_V}, level).size();
    // A mean over many rows may still have one or two crossings by noise.
    constexpr std::size_t few = 16;
    return no_period(record.t_s, name, in_all, passed.empty() ? in_all < 3 : in_all < few);
  }
  EmfPhase out;
  out.middle_s = 0.5 * (record.t_s.front() + record.t_s.back());
  out.terms = std::min(phase_terms(0.5 * static_cast<double>(passed.size() - 1)), passed.size() - 1);
  const double half_s = 0.5 * (record.t_s.back() - record.t_s.front());
  NormalEquations equations(out.terms + 1);
  std::vector<double> row(out.terms + 1);
  for (std::size_t k = 0; k < passed.size(); ++k) {
    row[0] = 1.0;
    for (std::size_t n = 1; n < row.size(); ++n) row[n] = row[n - 1] * (passed[k] - out.middle_s) / half_s;
    equations.add(row, base::pi * static_cast<double>(k));
  }
  const std::optional<Solution> found = solution_of(equations);
  double scale = 1.0;
  for (std::size_t n = 0; found && n < out.terms; ++n) {
    scale *= static_cast<double>(n + 1) / half_s;
    out.rate[n] = found->unknowns[n + 1] * scale;
  }
  if (!(out.rate[0] > 0.0) || !(out.speed(record.t_s.front()) > 0.0) || !(out.speed(record.t_s.back()) > 0.0))
    return base::Problem{.where = name,
                         .limit = "has no steady frequency: the motor stopped or turned back",
                         .cure = "use a part of the recording in which the motor turns in one direction"};
  return out;
}

}  // namespace sixstep::analysis
