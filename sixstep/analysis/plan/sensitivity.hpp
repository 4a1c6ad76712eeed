// SPDX-License-Identifier: Apache-2.0
// Which key a figure hangs on: Sobol indices of a plan laid out for them (Sampling::saltelli).
//
//   f_A, f_B   the figure at the two independent points of a row; f_i the one at A with key i as in B
//   first      S_i = mean(f_B (f_i - f_A)) / V    what key i explains alone (A. Saltelli et al., Comput. Phys. Commun. 181,
//              2010, table 2 b), f about its mean
//   total      T_i = mean((f_A - f_i)^2) / (2 V)  what it explains with all others (M. J. W. Jansen, 1999)
//   V          variance over f_A and f_B
//
// Over all keys the first ones add up to 1 where no two act together; T_i = 0 is a key that does not matter.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sixstep::analysis {

/// A value with the middle 95 % of what it is over the rows drawn again with replacement (bootstrap).
struct Estimated {
  double value = 0.0, low = 0.0, high = 0.0;
};

struct SensitivityIndex {
  Estimated first, total;
};

/// `figures`: of all runs in the plan's order, (keys + 2) a row; NaN where a run has none, and then its row is left out.
/// Empty where fewer than two rows are whole or the figure does not vary.
std::optional<std::vector<SensitivityIndex>> sensitivity(std::span<const double> figures, std::size_t keys,
                                                         std::uint64_t seed);

}  // namespace sixstep::analysis
