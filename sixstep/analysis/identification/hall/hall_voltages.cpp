// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/hall/hall_voltages.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/identification/distributions.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {
namespace {

constexpr std::size_t orders = vector_orders.size();

/// The model's basis at one angle: w exp(j h theta).
struct Basis {
  std::array<double, orders> re{}, im{};
};

Basis basis_at(const MotionPath::At& at) {
  Basis b;
  const double w = at.speed_deg_s * base::rad_per_deg;
  for (std::size_t n = 0; n < orders; ++n) {
    const base::SinCos x = base::sin_cos(vector_orders[n] * at.angle_deg * base::rad_per_deg);
    b.re[n] = w * x.cos;
    b.im[n] = w * x.sin;
  }
  return b;
}

struct Vector {
  double re = 0.0, im = 0.0;
};

/// The modelled vector at an angle, and its derivative by the angle, per rad.
struct Modelled {
  Vector value, slope;
};
Modelled modelled(const VoltageModel& m, const Basis& b) {
  Modelled out{{m.offset_alpha_V, m.offset_beta_V}, {}};
  for (std::size_t n = 0; n < orders; ++n) {
    const double re = m.re_Vs[n] * b.re[n] - m.im_Vs[n] * b.im[n],
                 im = m.re_Vs[n] * b.im[n] + m.im_Vs[n] * b.re[n];
    out.value.re += re;
    out.value.im += im;
    out.slope.re -= vector_orders[n] * im;
    out.slope.im += vector_orders[n] * re;
  }
  return out;
}

/// Computes the number of independent rows. Correlated residuals of neighbouring rows contain as much
/// information as a smaller number of independent residuals. This number follows from the correlation of two
/// neighbours, if it decays geometrically with their distance. A residual that turns with the rotor is smooth
/// instead, and its neighbours are almost equal.
class Memory {
 public:
  void take(const Vector& r) {
    square_ += r.re * r.re + r.im * r.im;
    product_ += r.re * before_.re + r.im * before_.im;
    before_ = r;
  }
  double rows() const {
    const double alike = square_ > 0.0 ? std::clamp(product_ / square_, 0.0, 0.999) : 0.0;
    return (1.0 + alike) / (1.0 - alike);
  }

 private:
  double square_ = 0.0, product_ = 0.0;
  Vector before_;
};

/// Uncertainty of the amplitude. Each half turn gives a separate amplitude, with all its errors of noise and
/// speed. A small number of half turns, or a few fast among slow half turns, shift the amplitude towards
/// their own values, so that their residuals are too small. Therefore each half turn contributes its residual
/// without its own influence, and the weights determine Student's degrees of freedom (R. M. Bell and D. F.
/// McCaffrey, "Bias reduction in standard errors for linear regression with multi-stage samples", Survey
/// Methodology 28, 2002, for one unknown).
class HalfTurns {
 public:
  void take(double angle_deg, const Vector& fundamental, const Vector& residual) {
    if (std::fabs(angle_deg - begin_deg_) > 180.0) close();
    if (part_ == 0.0) begin_deg_ = angle_deg;
    part_ += fundamental.re * fundamental.re + fundamental.im * fundamental.im;
    off_ += fundamental.re * residual.re + fundamental.im * residual.im;
  }
  std::size_t count() const { return clusters_.size() + (part_ > 0.0 ? 1 : 0); }
  /// Half width of the amplitude's interval, as a fraction of the amplitude.
  double half_width() {
    close();
    if (clusters_.size() < 2) return 1.0;
    double weight = 0.0;
    for (const Cluster& c : clusters_) weight += c.part;
    double square = 0.0, own = 0.0, pulls = 0.0, pulls2 = 0.0;
    for (const Cluster& c : clusters_) {
      const double share = c.part / weight, free = std::max(1.0 - share, 1e-6);
      square += c.off * c.off / free;
      own += share * share;
      const double pull = share * share / free;
      pulls += pull;
      pulls2 += pull * pull;
    }
    const double degrees_of_freedom = 1.0 / (own + pulls * pulls - pulls2);
    return student_95(degrees_of_freedom) * std::sqrt(square) / weight;
  }

 private:
  struct Cluster {
    double part, off;
  };
  void close() {
    if (part_ > 0.0) clusters_.push_back({part_, off_});
    part_ = off_ = 0.0;
  }
  double begin_deg_ = 0.0, part_ = 0.0, off_ = 0.0;
  std::vector<Cluster> clusters_;
};

/// Computes the model's uncertainty from the residuals.
void judge(const std::vector<VoltageVector>& vectors, const MotionPath& path, VoltageModel& model) {
  Memory memory;
  HalfTurns half_turns;
  for (const VoltageVector& v : vectors) {
    const std::optional<MotionPath::At> at = path.at(v.t_s);
    if (!at) continue;
    const Basis b = basis_at(*at);
    const Modelled m = modelled(model, b);
    const Vector residual{v.alpha_V - m.value.re, v.beta_V - m.value.im};
    memory.take(residual);
    half_turns.take(at->angle_deg,
                    {model.re_Vs[0] * b.re[0] - model.im_Vs[0] * b.im[0],
                     model.re_Vs[0] * b.im[0] + model.im_Vs[0] * b.re[0]},
                    residual);
  }
  // Largest number of rows that count as one, for arbitrarily smooth residuals: each edge jitters
  // independently, and the path's error between two edges ends with the sector.
  constexpr double sectors = 3.0;  // number of sectors in half a turn
  const double most = static_cast<double>(model.rows) /
                      (sectors * static_cast<double>(std::max<std::size_t>(half_turns.count(), 1)));
  model.memory_rows = std::min(memory.rows(), std::max(most, 1.0));
  model.flux_half_width_Vs =
      half_turns.half_width() * std::sqrt(model.re_Vs[0] * model.re_Vs[0] + model.im_Vs[0] * model.im_Vs[0]);
}

}  // namespace

std::vector<VoltageVector> vectors_of(const HallLog& log) {
  const double root3 = std::sqrt(3.0);
  std::vector<VoltageVector> out;
  if (log.voltages == RecordedVoltages::none) return out;
  out.reserve(log.t_s.size());
  const bool lines = log.voltages == RecordedVoltages::lines, third = !log.u_V[2].empty();
  for (std::size_t n = 0; n < log.t_s.size(); ++n) {
    const double u = log.u_V[0][n], v = log.u_V[1][n], w = third ? log.u_V[2][n] : -u - v;
    if (lines)
      out.push_back({log.t_s[n], (u - w) / 3.0, v / root3});
    else
      out.push_back({log.t_s[n], (2.0 * u - v - w) / 3.0, (v - w) / root3});
  }
  return out;
}

std::optional<VoltageModel> fit_voltages(const std::vector<VoltageVector>& vectors, const MotionPath& path) {
  constexpr std::size_t unknowns = 2 * orders + 2;
  NormalEquations equations(unknowns);
  VoltageModel out;
  double sum_alpha = 0.0, sum_beta = 0.0;
  std::array<double, unknowns> alpha{}, beta{};
  for (const VoltageVector& v : vectors) {
    const std::optional<MotionPath::At> at = path.at(v.t_s);
    if (!at) continue;
    const Basis b = basis_at(*at);
    for (std::size_t n = 0; n < orders; ++n) {
      alpha[2 * n] = beta[2 * n + 1] = b.re[n];
      alpha[2 * n + 1] = -b.im[n];
      beta[2 * n] = b.im[n];
    }
    alpha[2 * orders] = beta[2 * orders + 1] = 1.0;
    equations.add(alpha, v.alpha_V);
    equations.add(beta, v.beta_V);
    sum_alpha += v.alpha_V;
    sum_beta += v.beta_V;
    ++out.rows;
  }
  if (2 * out.rows <= 2 * unknowns) return {};
  const std::optional<Solution> found = solution_of(equations);
  if (!found) return {};
  for (std::size_t n = 0; n < orders; ++n) {
    out.re_Vs[n] = found->unknowns[2 * n];
    out.im_Vs[n] = found->unknowns[2 * n + 1];
  }
  out.offset_alpha_V = found->unknowns[2 * orders];
  out.offset_beta_V = found->unknowns[2 * orders + 1];
  out.residual_V2 = found->residual_square;
  const auto rows = static_cast<double>(out.rows);
  out.still_V2 = equations.square() - (sum_alpha * sum_alpha + sum_beta * sum_beta) / rows;
  // Without any noise a recording still has the rounding of its last digit.
  out.variance_V2 = std::max(found->residual_square / (2.0 * rows - unknowns), 1e-24 * out.still_V2 / rows);
  judge(vectors, path, out);
  return out;
}

double turned_into_place(VoltageModel& model) {
  // z = K_h w exp(j h (path + off)) is fitted as K_h exp(j h off) over the path.
  const double off = base::atan2(model.im_Vs[0], model.re_Vs[0]) + base::sector_rad;
  for (std::size_t n = 0; n < orders; ++n) {
    const base::SinCos turn = base::sin_cos(-vector_orders[n] * off);
    const double re = model.re_Vs[n];
    model.re_Vs[n] = re * turn.cos - model.im_Vs[n] * turn.sin;
    model.im_Vs[n] = re * turn.sin + model.im_Vs[n] * turn.cos;
  }
  return off / base::rad_per_deg;
}

namespace {

/// Rows over a few degrees of the path. One Gauss-Newton step computes from them a common correction of the
/// path's angle.
class Window {
 public:
  bool holds(double angle_deg) const { return rows_ == 0 || std::fabs(angle_deg - begin_deg_) < longest_deg; }
  bool empty() const { return rows_ == 0; }

  void take(double t_s, double angle_deg, const Vector& residual, const Vector& slope) {
    if (rows_ == 0) begin_deg_ = angle_deg;
    const double weight = slope.re * slope.re + slope.im * slope.im;
    weight_ += weight;
    product_ += slope.re * residual.re + slope.im * residual.im;
    t_s_ += weight * t_s;
    ++rows_;
  }

  std::optional<Sighting> said(double variance_V2, const MotionPath& path) const {
    if (!(weight_ > 0.0)) return {};
    Sighting s;
    s.t_s = t_s_ / weight_;
    const std::optional<MotionPath::At> at = path.at(s.t_s);
    if (!at) return {};
    s.says_deg = at->angle_deg + product_ / weight_ / base::rad_per_deg;
    s.known_deg2 = variance_V2 / weight_ / (base::rad_per_deg * base::rad_per_deg);
    s.is_edge = false;
    const bool tells = s.known_deg2 < blurred_deg * blurred_deg && std::fabs(product_ / weight_) < 1.0;
    return tells ? std::optional(s) : std::nullopt;
  }

 private:
  static constexpr double longest_deg = 30.0;
  static constexpr double blurred_deg = 20.0;  ///< a sighting with a larger uncertainty is not used
  double begin_deg_ = 0.0, weight_ = 0.0, product_ = 0.0, t_s_ = 0.0;
  std::size_t rows_ = 0;
};

}  // namespace

std::vector<Sighting> voltage_sightings(const std::vector<VoltageVector>& vectors, const VoltageModel& model,
                                        const MotionPath& path) {
  std::vector<Sighting> out;
  Window window;
  const auto close = [&] {
    if (const std::optional<Sighting> s = window.said(model.variance_V2, path)) out.push_back(*s);
    window = {};
  };
  for (const VoltageVector& v : vectors) {
    const std::optional<MotionPath::At> at = path.at(v.t_s);
    if (!at || !window.holds(at->angle_deg)) close();
    if (!at) continue;
    const Modelled m = modelled(model, basis_at(*at));
    window.take(v.t_s, at->angle_deg, {v.alpha_V - m.value.re, v.beta_V - m.value.im}, m.slope);
  }
  close();
  return out;
}

}  // namespace sixstep::analysis
