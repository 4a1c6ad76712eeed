// SPDX-License-Identifier: Apache-2.0
// The simulated values of a bench's recording.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "batch/fit/fit_parameters.hpp"
#include "sixstep/study/measure/columns.hpp"

namespace batch {

/// One cell of a recording that the fit uses.
struct FitCell {
  std::size_t column = 0;  ///< index in the log
  std::size_t row = 0;
  double value = 0.0;
};

/// A bench with its cells, ordered by row. The cells stay the same during the fit.
class FitModel {
 public:
  /// Largest move of the recording's times during a fit: the rows nearer to the run's ends are left out.
  static double margin_s(const FitBench& bench);

  /// Problems: a column that the scenario does not have, fewer than ten rows within the simulated time.
  static base::Result<FitModel> of(const FitBench& bench, std::size_t index);

  const std::vector<FitCell>& cells() const { return cells_; }
  const FitBench& bench() const { return *bench_; }

  /// The model's value of each cell: the simulated column at the row's instant, times gain, plus offset.
  /// Problems: values out of range, a simulated drive that stops before the last row.
  base::Result<std::vector<double>> values(std::span<const FitParameter> parameters,
                                           std::span<const double> u) const {
    return values(parameters, u, cells_.size());
  }
  /// The values of the first `count` cells; the simulation ends after these cells.
  base::Result<std::vector<double>> values(std::span<const FitParameter> parameters,
                                           std::span<const double> u, std::size_t count) const;
  /// Number of cells in the first part of the recording's time, 0 to 1.
  std::size_t cells_until(double part) const;

 private:
  const FitBench* bench_ = nullptr;
  std::size_t index_ = 0;
  std::vector<FitCell> cells_;
  std::vector<std::size_t> signal_;  ///< for each column of the log: its index in a full row
  std::vector<double>
      factor_;  ///< factor from the full row's unit to the column's unit, which differ for a linear motor
};

}  // namespace batch
