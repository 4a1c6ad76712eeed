// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/plan/sensitivity.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/random.hpp"

namespace sixstep::analysis {
namespace {

constexpr std::size_t resamples = 400;
constexpr std::size_t outside = 40;  ///< bootstrap values beyond each end of the 95 % interval: one in 40

/// The figures of one row of runs, minus the mean of f_A and f_B over all rows.
struct Row {
  double a, b;
  std::vector<double> f;
};

struct IndexSums {
  double a = 0.0, squares = 0.0;
  std::vector<double> first, total;
  std::size_t rows = 0;

  explicit IndexSums(std::size_t keys) : first(keys), total(keys) {}
  void add(const Row& row) {
    a += row.a + row.b;
    squares += row.a * row.a + row.b * row.b;
    for (std::size_t k = 0; k < first.size(); ++k) {
      first[k] += row.b * (row.f[k] - row.a);
      total[k] += (row.a - row.f[k]) * (row.a - row.f[k]) / 2;
    }
    ++rows;
  }
  double variance() const {
    const double n = 2 * static_cast<double>(rows), mean = a / n;
    return squares / n - mean * mean;
  }
  double first_of(std::size_t k) const { return first[k] / static_cast<double>(rows) / variance(); }
  double total_of(std::size_t k) const { return total[k] / static_cast<double>(rows) / variance(); }
};

std::vector<Row> whole_rows(std::span<const double> figures, std::size_t keys) {
  std::vector<Row> rows;
  for (std::size_t n = 0; n + keys + 2 <= figures.size(); n += keys + 2) {
    const auto row = figures.subspan(n, keys + 2);
    if (!std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); })) continue;
    rows.push_back({row[0], row[1], {row.begin() + 2, row.end()}});
  }
  double mean = 0.0;
  for (const Row& r : rows) mean += (r.a + r.b) / 2 / static_cast<double>(rows.size());
  for (Row& r : rows) {
    r.a -= mean;
    r.b -= mean;
    for (double& f : r.f) f -= mean;
  }
  return rows;
}

Estimated estimated(double value, std::vector<double>& again) {
  std::sort(again.begin(), again.end());
  const std::size_t beyond = again.size() / outside;
  return {value, again[beyond], again[again.size() - 1 - beyond]};
}

}  // namespace

std::optional<std::vector<SensitivityIndex>> sensitivity(std::span<const double> figures, std::size_t keys,
                                                         std::uint64_t seed) {
  const std::vector<Row> rows = whole_rows(figures, keys);
  IndexSums all(keys);
  for (const Row& row : rows) all.add(row);
  if (rows.size() < 2 || !(all.variance() > 0.0)) return {};

  std::vector<std::vector<double>> first(keys), total(keys);
  for (std::size_t again = 0; again < resamples; ++again) {
    IndexSums drawn(keys);
    for (std::size_t n = 0; n < rows.size(); ++n)
      drawn.add(rows[base::random_bits({seed, again, n})[0] % rows.size()]);
    if (!(drawn.variance() > 0.0)) continue;
    for (std::size_t k = 0; k < keys; ++k) {
      first[k].push_back(drawn.first_of(k));
      total[k].push_back(drawn.total_of(k));
    }
  }
  std::vector<SensitivityIndex> out(keys);
  for (std::size_t k = 0; k < keys; ++k) {
    if (first[k].empty()) return {};
    out[k] = {estimated(all.first_of(k), first[k]), estimated(all.total_of(k), total[k])};
  }
  return out;
}

bool too_few_rows(std::span<const SensitivityIndex> indices) {
  constexpr double slack = 0.01;
  double sum = 0.0;
  for (const SensitivityIndex& key : indices) sum += key.first.value;
  return sum > 1.0 + slack || std::any_of(indices.begin(), indices.end(), [](const SensitivityIndex& key) {
           return key.first.value < -slack || key.first.value > key.total.value + slack;
         });
}

}  // namespace sixstep::analysis
