// SPDX-License-Identifier: Apache-2.0
// Computes the keys on which a figure depends: Sobol indices of a plan designed for them
// (Sampling::saltelli).
//
//   f_A, f_B   the figure at the two independent points A and B of a row of runs
//   f_i        the figure at point A with key i as in B
//   first      S_i = mean(f_B (f_i - f_A)) / V    the effect of key i by itself, with f about its mean
//              (A. Saltelli et al., Comput. Phys. Commun. 181, 2010, table 2 b)
//   total      T_i = mean((f_A - f_i)^2) / (2 V)  the effect of key i with all others (M. J. W. Jansen, 1999)
//   V          variance over f_A and f_B
//
// The sum of all first indices is 1 if no two keys interact. T_i = 0: the key has no influence.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sixstep::analysis {

/// A value, and the central 95 % of its values over rows that are resampled with replacement (bootstrap).
struct Estimated {
  double value = 0.0, low = 0.0, high = 0.0;
};

struct SensitivityIndex {
  Estimated first, total;
};

/// `figures`: figures of all runs in the plan's order, keys + 2 per row. A row with a value that is not
/// finite is skipped. Empty if fewer than two rows remain or the figure does not vary.
std::optional<std::vector<SensitivityIndex>> sensitivity(std::span<const double> figures, std::size_t keys,
                                                         std::uint64_t seed);

/// True if the values contradict the indices' laws by more than 0.01, because there are too few rows. The
/// laws: 0 <= S_i <= T_i, and the sum of the first indices is at most 1.
bool too_few_rows(std::span<const SensitivityIndex> indices);

}  // namespace sixstep::analysis
