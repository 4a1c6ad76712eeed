// SPDX-License-Identifier: Apache-2.0
// Checks a back-EMF given as a table (model.md 7) and computes its factors, exactly for its straight lines.
#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/design/sheet/sheet_reader.hpp"
#include "sixstep/design/sheet/winding_description.hpp"

namespace sixstep::design {
namespace {

/// A periodic table with straight lines between its points.
class Table {
 public:
  Table(std::span<const double> angle_deg, std::span<const double> value)
      : angle_(angle_deg), value_(value) {}

  std::size_t size() const { return angle_.size(); }
  double from(std::size_t n) const { return angle_[n]; }
  double to(std::size_t n) const { return n + 1 < size() ? angle_[n + 1] : angle_[0] + 360.0; }
  double first(std::size_t n) const { return value_[n]; }
  double last(std::size_t n) const { return value_[n + 1 < size() ? n + 1 : 0]; }
  double slope(std::size_t n) const { return (last(n) - first(n)) / (to(n) - from(n)); }

  double at(double deg) const {
    double x = deg - 360.0 * std::floor(deg / 360.0);
    if (x < angle_[0]) x += 360.0;
    std::size_t n = size() - 1;
    while (n > 0 && angle_[n] > x) --n;
    return first(n) + slope(n) * (x - from(n));
  }
  /// Integral over [begin, end], degrees, within the turn from 0 to 360.
  double integral(double begin, double end) const {
    double sum = 0.0;
    for (const double turn : {-360.0, 0.0})
      for (std::size_t n = 0; n < size(); ++n) {
        const double a = std::max(from(n) + turn, begin), b = std::min(to(n) + turn, end);
        if (b > a) sum += (first(n) + slope(n) * ((a + b) / 2.0 - from(n) - turn)) * (b - a);
      }
    return sum;
  }

 private:
  std::span<const double> angle_, value_;
};

/// Peak and mean square of f_a - f_b over a turn. The difference is linear between the corners of both terms.
void line_to_line(const Table& table, ShapeFactors& out) {
  std::vector<double> corners{0.0, 360.0};
  for (std::size_t n = 0; n < table.size(); ++n)
    for (const double shift : {0.0, 120.0}) corners.push_back(std::fmod(table.from(n) + shift, 360.0));
  std::sort(corners.begin(), corners.end());
  const auto line = [&](double x) { return table.at(x) - table.at(x - 120.0); };
  double square = 0.0;
  for (std::size_t n = 0; n + 1 < corners.size(); ++n) {
    const double a = line(corners[n]), b = line(corners[n + 1]);
    square += (a * a + a * b + b * b) / 3.0 * (corners[n + 1] - corners[n]);
    out.line_peak = std::max({out.line_peak, std::abs(a), std::abs(b)});
  }
  out.line_rms = std::sqrt(square / 360.0);
}

/// Reports errors that the ranges of the two lists do not exclude. Returns true if the lists can form a
/// table.
bool are_points(SheetReader& reader) {
  const std::vector<double>&angle = reader.sheet.back_emf_angle_deg, &value = reader.sheet.back_emf_shape;
  if (angle.size() != value.size())
    reader.problem("back_emf_shape", std::to_string(value.size()) + " values",
                   "needs one value for each of the " + std::to_string(angle.size()) + " back_emf_angle_deg",
                   "write back_emf_angle_deg = [0, 120, 180, 300] and back_emf_shape = [1, 1, -1, -1]");
  else if (angle.empty() && !reader.sheet.back_emf_file.empty())
    reader.problem("back_emf_file", "\"" + reader.sheet.back_emf_file + "\"", "has not been read",
                   "give its rows as back_emf_angle_deg and back_emf_shape");
  else if (angle.empty())
    reader.problem("back_emf", "\"table\"", "has no table",
                   "give back_emf_angle_deg and back_emf_shape, or back_emf_file");
  else if (angle.size() < 2 || angle.size() > most_shape_points)
    reader.problem("back_emf_angle_deg", std::to_string(angle.size()) + " values",
                   "must be 2 to " + std::to_string(most_shape_points) + " points of one electrical turn",
                   "give 2 points or more; one per degree is enough");
  else
    for (std::size_t n = 0; n < angle.size(); ++n) {
      const double next = n + 1 < angle.size() ? angle[n + 1] : angle[0] + 360.0;
      if (angle[n] >= 0.0 && angle[n] < 360.0 && next - angle[n] >= least_shape_step_deg) continue;
      reader.problem("back_emf_angle_deg", base::written(angle[n]),
                     "must lie in [0, 360) and at least " + base::written(least_shape_step_deg) +
                         " deg before the next angle, " + base::written(next),
                     "sort the points by angle; the table continues periodically");
      return false;
    }
  return angle.size() == value.size() && angle.size() >= 2 && angle.size() <= most_shape_points;
}

}  // namespace

ShapeFactors table_factors(std::span<const double> angle_deg, std::span<const double> values) {
  const Table table(angle_deg, values);
  ShapeFactors out;
  // Each phase is the source for two sectors, in its positive third of a turn, and the sink for two sectors,
  // in its negative third. With three phases these are all six sectors.
  out.sector_mean = (table.integral(0.0, 120.0) - table.integral(180.0, 300.0)) / 120.0;
  line_to_line(table, out);
  double square = 0.0, cos = 0.0, sin = 0.0;
  for (std::size_t n = 0; n < table.size(); ++n) {
    const double a = table.first(n), b = table.last(n);
    square += (a * a + a * b + b * b) / 3.0 * (table.to(n) - table.from(n));
    out.phase_peak = std::max(out.phase_peak, std::abs(a));
    // By parts, the integral of f cos x equals the integral of -f' sin x, and f' is constant on each line.
    const double per_rad = table.slope(n) * 180.0 / base::pi;
    const base::SinCos from = base::sin_cos(table.from(n) / 180.0 * base::pi),
                       to = base::sin_cos(table.to(n) / 180.0 * base::pi);
    cos += per_rad * (to.cos - from.cos) / base::pi;
    sin += per_rad * (to.sin - from.sin) / base::pi;
  }
  out.phase_rms = std::sqrt(square / 360.0);
  out.fundamental = std::sqrt(cos * cos + sin * sin);
  return out;
}

std::optional<ShapeFactors> read_shape_table(SheetReader& reader) {
  if (!are_points(reader)) return {};
  const std::vector<double>& value = reader.sheet.back_emf_shape;
  const double mean = Table(reader.sheet.back_emf_angle_deg, value).integral(0.0, 360.0) / 360.0;
  const auto [least, most] = std::minmax_element(value.begin(), value.end());
  const double range = *most - *least;
  if (!(range > 0.0)) {
    reader.problem("back_emf_shape", base::written(value[0]), "has the same value at all angles",
                   "give the back-EMF of one phase over an electrical turn");
    return {};
  }
  if (std::abs(mean) > most_shape_mean * range) {
    reader.problem("back_emf_shape", "",
                   "has the mean " + rounded(mean, 6) + " over the turn; at most " +
                       rounded(most_shape_mean, 1) + " times its peak-to-peak value of " + rounded(range) +
                       " is allowed",
                   "subtract " + rounded(mean, 6) + " from every value");
    return {};
  }
  const ShapeFactors factors = table_factors(reader.sheet.back_emf_angle_deg, value);
  if (factors.sector_mean > least_shape_torque * factors.line_peak) return factors;
  reader.problem("back_emf_shape", "",
                 "gives a mean torque per ampere of only " + rounded(factors.sector_mean) +
                     " over the sectors of the driven pairs, with a peak of " + rounded(factors.line_peak),
                 "count the angles so that the middle of phase a's positive half wave lies at 60 degrees");
  return {};
}

}  // namespace sixstep::design
