// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/plan/plan.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/plan/permuted.hpp"
#include "sixstep/analysis/plan/sobol_sequence.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/random.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::analysis {
namespace {

constexpr double most_runs = 1e9;

std::size_t steps_of(const Axis& axis) { return axis.values.empty() ? axis.points : axis.values.size(); }

double on_range(const Axis& axis, double u) {
  if (u <= 0.0) return axis.from;
  if (u >= 1.0) return axis.to;
  if (axis.spacing == Spacing::logarithmic) return axis.from * base::exp(u * base::log(axis.to / axis.from));
  return axis.from + u * (axis.to - axis.from);
}

/// The position of point n on each axis. The positions are the digits of n, with the number of an axis's
/// steps as the base of its digit; the last axis changes fastest.
std::vector<double> on_grid(const Plan& plan, std::size_t n) {
  std::vector<double> at(plan.axes.size());
  for (std::size_t k = plan.axes.size(); k-- > 0;) {
    const Axis& axis = plan.axes[k];
    const std::size_t steps = steps_of(axis), step = n % steps;
    n /= steps;
    at[k] = axis.values.empty() ? static_cast<double>(step) / static_cast<double>(steps - 1)
                                : (static_cast<double>(step) + 0.5) / static_cast<double>(steps);
  }
  return at;
}

/// Saltelli's points. With k axes, block n/(k + 2) contains the points A and B, then one point per axis: A
/// with this axis's coordinate of B. A and B are the halves of one point of Sobol's sequence.
double of_saltelli(const Plan& plan, std::size_t n, std::size_t axis) {
  const std::size_t k = plan.axes.size(), row = n / (k + 2), column = n % (k + 2);
  const bool of_b = column == 1 || column == axis + 2;
  return sobol(of_b ? axis + k : axis, static_cast<std::uint32_t>(row), plan.seed);
}

double coordinate(const Plan& plan, std::size_t n, std::size_t axis) {
  const double jitter = base::uniform({plan.seed, axis, n});
  switch (plan.sampling) {
    case Sampling::latin_hypercube:
      return (static_cast<double>(permuted(n, plan.points, plan.seed, axis)) + jitter) /
             static_cast<double>(plan.points);
    case Sampling::sobol:
      return sobol(axis, static_cast<std::uint32_t>(n), plan.seed);
    case Sampling::saltelli:
      return of_saltelli(plan, n, axis);
    case Sampling::grid:
    case Sampling::monte_carlo:
      break;
  }
  return jitter;
}

class Checker {
 public:
  explicit Checker(const Plan& plan) : plan_(plan) {}

  base::Problems problems() {
    for (std::size_t n = 0; n < plan_.axes.size(); ++n) axis(n);
    if (plan_.axes.empty() && plan_.drives == 0)
      add("vary", "", "is missing: without a varied key all runs would be the same",
          "name a key and its values");
    const std::size_t dimensions = plan_.axes.size() * (plan_.sampling == Sampling::saltelli ? 2 : 1);
    const bool even = plan_.sampling == Sampling::sobol || plan_.sampling == Sampling::saltelli;
    if (even && dimensions > sobol_dimensions)
      add("vary", std::to_string(plan_.axes.size()), "are more varied keys than the sequence has dimensions",
          "vary at most " + std::to_string(sobol_dimensions * plan_.axes.size() / dimensions));
    if (plan_.sampling != Sampling::grid && !plan_.axes.empty() && plan_.points == 0)
      add("points", "0", "gives a plan without points", "give the number of points");
    if (plan_.sampling == Sampling::saltelli && plan_.drives > 0)
      add("drives", std::to_string(plan_.drives), "vary at random, and Sobol indices need planned points",
          "vary these values as keys of [[vary]] over their ranges, with strays = true");
    if (problems_.empty() && too_many())
      add("points", "", "make more than a thousand million runs, the limit of a plan",
          "give fewer values, points or drives");
    return std::move(problems_);
  }

 private:
  void axis(std::size_t n) {
    const Axis& a = plan_.axes[n];
    const std::string where = "vary[" + std::to_string(n) + "].";
    const auto same = [&](const Axis& other) { return other.key == a.key; };
    const auto here = plan_.axes.begin() + static_cast<std::ptrdiff_t>(n);
    if (a.key.empty()) return add(where + "key", "", "is missing", "name the key as table.key");
    if (std::any_of(plan_.axes.begin(), here, same))
      return add(where + "key", a.key, "is varied already",
                 "give all values of this key in one entry of [[vary]]");
    if (!a.values.empty()) return;
    if (!std::isfinite(a.from) || !std::isfinite(a.to))
      return add(where + "from", base::written(a.from),
                 "must be a finite number, like the other end of the range", "give two finite numbers");
    if (a.spacing == Spacing::logarithmic && !(a.from > 0.0 && a.to > 0.0))
      return add(where + "from", base::written(std::min(a.from, a.to)),
                 "must be above 0, like both ends of a logarithmic range",
                 "give ends above 0, or set spacing = \"linear\"");
    if (plan_.sampling == Sampling::grid && a.points < 2)
      return add(where + "points", std::to_string(a.points), "must be at least 2, for both ends of the range",
                 "give at least 2 points");
  }

  bool too_many() const {
    double runs = plan_.sampling == Sampling::grid ? 1.0 : static_cast<double>(plan_.points);
    if (plan_.sampling == Sampling::grid)
      for (const Axis& a : plan_.axes) runs *= static_cast<double>(steps_of(a));
    if (plan_.sampling == Sampling::saltelli) runs *= static_cast<double>(plan_.axes.size() + 2);
    return runs * static_cast<double>(std::max<std::size_t>(plan_.drives, 1)) >
           static_cast<double>(most_runs);
  }

  void add(std::string where, std::string value, std::string limit, std::string cure) {
    problems_.push_back({std::move(where), std::move(value), std::move(limit), std::move(cure)});
  }

  const Plan& plan_;
  base::Problems problems_;
};

}  // namespace

std::string on_axis(const Axis& axis, double u) {
  if (axis.values.empty()) return base::written(on_range(axis, u));
  const auto count = static_cast<double>(axis.values.size());
  return axis.values[std::min(static_cast<std::size_t>(u * count), axis.values.size() - 1)];
}

std::string_view bare(std::string_view value) {
  const bool quoted = value.size() >= 2 && value.front() == '"' && value.back() == '"';
  return quoted ? value.substr(1, value.size() - 2) : value;
}

base::Problems check(const Plan& plan) { return Checker(plan).problems(); }

std::size_t points_of(const Plan& plan) {
  if (plan.axes.empty()) return 1;
  if (plan.sampling == Sampling::saltelli) return plan.points * (plan.axes.size() + 2);
  if (plan.sampling != Sampling::grid) return plan.points;
  std::size_t points = 1;
  for (const Axis& axis : plan.axes) points *= steps_of(axis);
  return points;
}

std::size_t runs_of(const Plan& plan) { return points_of(plan) * std::max<std::size_t>(plan.drives, 1); }

std::vector<double> coordinates(const Plan& plan, std::size_t point) {
  if (plan.sampling == Sampling::grid) return on_grid(plan, point);
  std::vector<double> at(plan.axes.size());
  for (std::size_t k = 0; k < at.size(); ++k) at[k] = coordinate(plan, point, k);
  return at;
}

std::vector<std::string> point_of_run(const Plan& plan, std::size_t run) {
  const std::vector<double> at = coordinates(plan, run / std::max<std::size_t>(plan.drives, 1));
  std::vector<std::string> texts;
  texts.reserve(at.size());
  for (std::size_t k = 0; k < at.size(); ++k) texts.push_back(on_axis(plan.axes[k], at[k]));
  return texts;
}

std::optional<std::size_t> drive_of_run(const Plan& plan, std::size_t run) {
  if (plan.drives == 0) return {};
  return run % plan.drives;
}

}  // namespace sixstep::analysis
