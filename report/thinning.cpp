// SPDX-License-Identifier: Apache-2.0
#include "report/thinning.hpp"

#include <algorithm>
#include <cmath>

namespace report {
namespace {

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// Whether row n and its two neighbours have the same values in every curve.
bool is_level(const Curves& curves, std::size_t n) {
  for (const auto& y : curves)
    if (!same(y[n - 1], y[n]) || !same(y[n], y[n + 1])) return false;
  return true;
}

/// The rows needed for drawing. A row whose neighbours have the same values in every curve is not needed,
/// because the curves are level there.
std::vector<std::size_t> changing_rows(std::size_t count, const Curves& curves) {
  std::vector<std::size_t> rows;
  rows.reserve(count);
  for (std::size_t n = 0; n < count; ++n)
    if (n == 0 || n + 1 == count || !is_level(curves, n)) rows.push_back(n);
  return rows;
}

/// Adds the first row, the last row and each curve's extremes in [begin, end), in rising order and without
/// repetition.
void keep_extremes(const std::vector<std::size_t>& rows, std::size_t begin, std::size_t end,
                   const Curves& curves, std::vector<std::size_t>& chosen, std::vector<std::size_t>& kept) {
  chosen.assign({rows[begin], rows[end - 1]});
  for (const auto& y : curves) {
    std::size_t low = rows[begin], high = low;
    double lowest = y[low], highest = lowest;
    for (std::size_t n = begin; n < end; ++n) {
      const double v = y[rows[n]];
      if (v < lowest || std::isnan(lowest)) low = rows[n], lowest = v;
      if (v > highest || std::isnan(highest)) high = rows[n], highest = v;
    }
    chosen.push_back(low);
    chosen.push_back(high);
  }
  std::ranges::sort(chosen);
  kept.insert(kept.end(), chosen.begin(), std::unique(chosen.begin(), chosen.end()));
}

}  // namespace

std::vector<std::size_t> envelope(std::span<const double> time, const std::vector<std::size_t>& rows,
                                  const Curves& curves, std::size_t buckets) {
  const double start = time[rows.front()];
  const double width = (time[rows.back()] - start) / static_cast<double>(buckets);
  std::vector<std::size_t> kept, chosen;
  std::size_t begin = 0;
  for (std::size_t bucket = 1; begin < rows.size(); ++bucket) {
    std::size_t end = begin;
    const double edge = start + width * static_cast<double>(bucket);
    while (end < rows.size() && (bucket >= buckets || time[rows[end]] < edge)) ++end;
    if (end > begin) keep_extremes(rows, begin, end, curves, chosen, kept);
    begin = end;
  }
  return kept;
}

Thinned thinned(std::span<const double> time, const Curves& curves, std::span<const Interval> keep,
                std::size_t cap, std::size_t full) {
  Thinned out;
  out.rows = changing_rows(time.size(), curves);
  if (out.rows.size() <= full) return out;
  out.complete = false;
  std::vector<std::size_t> detail;
  for (const std::size_t n : out.rows)
    if (std::ranges::any_of(keep, [&](const Interval& i) { return i.holds(time[n]); })) detail.push_back(n);
  // Extremes often coincide in one row. Therefore the loop starts with many buckets and reduces them until
  // the rows fit.
  std::size_t buckets = std::max<std::size_t>(cap / 3, 1);
  std::vector<std::size_t> coarse = envelope(time, out.rows, curves, buckets);
  while (coarse.size() > cap && buckets > 1) {
    const double ratio = static_cast<double>(cap) / static_cast<double>(coarse.size());
    buckets = std::max<std::size_t>(static_cast<std::size_t>(0.97 * ratio * static_cast<double>(buckets)), 1);
    coarse = envelope(time, out.rows, curves, buckets);
  }
  out.rows.clear();
  std::ranges::set_union(coarse, detail, std::back_inserter(out.rows));
  return out;
}

}  // namespace report
