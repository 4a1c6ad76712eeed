// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/hall/hall_alike.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "sixstep/analysis/identification/symmetric.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::analysis {
namespace {

/// Peak of a voltage's fundamental divided by the electrical speed, and its standard deviation; both in V s.
struct Size {
  double Vs = 0.0, deviation_Vs = 0.0;
};

/// The voltages between two terminals, in cyclic order. Voltages from the terminals to a common point may
/// differ in size, because the common point may be one of the terminals.
std::vector<double> between_terminals(const HallLog& log, std::size_t from) {
  const std::size_t rows = log.t_s.size();
  const bool lines = log.voltages == RecordedVoltages::lines;
  std::vector<double> out(rows);
  for (std::size_t n = 0; n < rows; ++n) {
    if (!lines)
      out[n] = log.u_V[from][n] - log.u_V[(from + 1) % 3][n];
    else if (log.u_V[from].empty())
      out[n] = -log.u_V[0][n] - log.u_V[1][n];
    else
      out[n] = log.u_V[from][n];
  }
  return out;
}

/// Fits the factors of w cos(theta) and w sin(theta), and an offset; w: speed, theta: angle. The residual
/// depends on the error of each edge of the path; the number of independent values is therefore the number of
/// edges.
std::optional<Size> size_of(const HallLog& log, const std::vector<double>& u_V, const MotionPath& path,
                            std::size_t edges) {
  NormalEquations equations(3);
  double weight = 0.0;
  for (std::size_t n = 0; n < u_V.size(); ++n) {
    const std::optional<MotionPath::At> at = path.at(log.t_s[n]);
    if (!at) continue;
    const base::SinCos x = base::sin_cos(at->angle_deg * base::rad_per_deg);
    const double w = at->speed_deg_s * base::rad_per_deg;
    equations.add(std::array{w * x.cos, w * x.sin, 1.0}, u_V[n]);
    weight += 0.5 * w * w;
  }
  const std::optional<Solution> found = solution_of(equations);
  if (!found || !(weight > 0.0)) return {};
  const double a = found->unknowns[0], b = found->unknowns[1];
  return Size{std::sqrt(a * a + b * b),
              std::sqrt(std::max(found->residual_square, 0.0) / weight / static_cast<double>(edges))};
}

}  // namespace

base::Problems check_alike(const HallLog& log, const MotionPath& path, std::size_t edges) {
  // Voltages of one motor differ by a few per cent. A different divider or unit changes a voltage by a large
  // factor. In a noisy log each voltage deviates by chance.
  constexpr double most = 0.05, deviations = 4.0;
  constexpr const char* names[] = {"u_ab", "u_bc", "u_ca"};
  double least = HUGE_VAL, greatest = 0.0, deviation = 0.0;
  std::string each;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::optional<Size> size = size_of(log, between_terminals(log, k), path, edges);
    if (!size) return {};
    least = std::min(least, size->Vs);
    greatest = std::max(greatest, size->Vs);
    deviation = std::max(deviation, size->deviation_Vs);
    each +=
        (k == 0 ? "" : ", ") + std::string(names[k]) + " " + base::three_digits(1e3 * size->Vs) + " mV s/rad";
  }
  if (!(greatest - least > most * (greatest + least) + 2.0 * deviations * deviation)) return {};
  return {{.where = "voltage",
           .value = each,
           .limit = "have fundamentals that differ too much for the phases of one motor",
           .cure = "check the dividers of the probes, their polarity and the units of the columns"}};
}

}  // namespace sixstep::analysis
