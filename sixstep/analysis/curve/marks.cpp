// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/curve/marks.hpp"

#include <array>
#include <cmath>
#include <functional>

namespace sixstep::analysis {
namespace {

using Sweep = std::vector<OperatingPoint>;
using Value = std::function<double(const OperatingPoint&)>;

/// Computes the points of a search. A point that cannot be computed ends the search.
struct Search {
  const Bench& bench;
  base::Problems problems{};

  bool take(double speed, OperatingPoint& into) {
    base::Result<OperatingPoint> point = operating_point(bench, speed);
    if (!point) {
      problems = point.problems();
      return false;
    }
    into = *point;
    return true;
  }
  /// Precision of a speed, as a fraction of the no-load speed.
  double near(double full_on, double chopped) const {
    const bool full = bench.duty == 1 || bench.duty == -1;
    return full ? full_on : chopped;
  }
};

/// Golden-section search between the neighbours of the sweep's best point.
std::optional<OperatingPoint> greatest(Search& search, const Sweep& sweep, const Value& value) {
  std::size_t top = 0;
  for (std::size_t n = 1; n < sweep.size(); ++n)
    if (value(sweep[n]) > value(sweep[top])) top = n;
  if (!(value(sweep[top]) > 0)) return {};
  constexpr double golden = 0.6180339887498949;
  const double whole = sweep.back().speed_rad_s;
  double low = sweep[top > 0 ? top - 1 : 0].speed_rad_s,
         high = sweep[std::min(top + 1, sweep.size() - 1)].speed_rad_s;
  OperatingPoint best = sweep[top], left, right;
  if (!search.take(high - golden * (high - low), left) || !search.take(low + golden * (high - low), right))
    return {};
  const double goal = std::fabs(whole) * search.near(1e-6, 2e-3);
  while (std::fabs(high - low) > goal) {
    if (value(left) > value(right)) {
      high = right.speed_rad_s;
      right = left;
      if (!search.take(high - golden * (high - low), left)) return {};
    } else {
      low = left.speed_rad_s;
      left = right;
      if (!search.take(low + golden * (high - low), right)) return {};
    }
  }
  for (const OperatingPoint& p : {left, right})
    if (value(p) > value(best)) best = p;
  return best;
}

/// Root between two neighbours of different sign by false position. The value of the retained end is halved
/// (Illinois method).
std::optional<OperatingPoint> root(Search& search, const OperatingPoint& a, const OperatingPoint& b,
                                   const Value& value, double goal) {
  double low = a.speed_rad_s, high = b.speed_rad_s, f_low = value(a), f_high = value(b);
  constexpr int most = 100;
  OperatingPoint found = b;
  int kept = 0;  // the end that was retained: -1 low, 1 high
  for (int n = 0; n < most; ++n) {
    const double speed = (low * f_high - high * f_low) / (f_high - f_low), before = found.speed_rad_s;
    if (!search.take(speed, found)) return {};
    const double f = value(found);
    if (f == 0 || std::fabs(speed - before) <= goal) return found;
    if ((f > 0) == (f_high > 0)) {
      high = speed;
      f_high = f;
      if (kept == -1) f_low /= 2;
      kept = -1;
    } else {
      low = speed;
      f_low = f;
      if (kept == 1) f_high /= 2;
      kept = 1;
    }
  }
  return found;
}

/// The root nearest to no load, above which `value` is positive; standstill if no root exists.
std::optional<OperatingPoint> crossing(Search& search, const Sweep& sweep, const Value& value) {
  const double goal = std::fabs(sweep.back().speed_rad_s) * search.near(1e-9, 1e-4);
  for (std::size_t n = sweep.size() - 1; n > 0; --n)
    if (value(sweep[n - 1]) < 0) return root(search, sweep[n - 1], sweep[n], value, goal);
  return sweep.front();
}

std::optional<OperatingPoint> at_torque(Search& search, const Sweep& sweep, double torque_Nm) {
  if (!(sweep.front().shaft_torque_Nm > torque_Nm) || !(torque_Nm > 0)) return {};
  return crossing(search, sweep, [=](const OperatingPoint& p) { return torque_Nm - p.shaft_torque_Nm; });
}

std::optional<OperatingPoint> for_ever(Search& search, const Sweep& sweep, const MarksWanted& wanted) {
  const auto left_W = [&](const OperatingPoint& p) {
    return design::continuous_copper_W(*wanted.thermal, p.friction_W, wanted.ambient_degC) -
           p.copper_W / wanted.on_R;
  };
  if (!(left_W(sweep.back()) > 0)) return {};
  return crossing(search, sweep, left_W);
}

}  // namespace

std::vector<double> sweep_speeds(double no_load_rad_s) {
  std::vector<double> speeds;
  speeds.reserve(speeds.size() + sweep_steps);
  for (int n = 0; n < sweep_steps; ++n) speeds.push_back(n * no_load_rad_s / sweep_steps);
  speeds.push_back(no_load_rad_s);
  return speeds;
}

base::Result<Marks> find_marks(const Bench& bench, const MarksWanted& wanted, const Sweep& sweep,
                               const ForEach& for_each) {
  Marks out;
  std::array<Search, 3> searches = {Search{bench}, Search{bench}, Search{bench}};
  for_each(searches.size(), [&](std::size_t n) {
    if (n == 0)
      out.best_efficiency =
          greatest(searches[n], sweep, [](const OperatingPoint& p) { return p.efficiency.value_or(0.0); });
    else if (n == 1 && wanted.thermal)
      out.for_ever = for_ever(searches[n], sweep, wanted);
    else if (n == 2 && wanted.torque_Nm)
      out.nominal = at_torque(searches[n], sweep, *wanted.torque_Nm);
  });
  for (const Search& search : searches)
    if (!search.problems.empty()) return search.problems;
  return out;
}

}  // namespace sixstep::analysis
