// SPDX-License-Identifier: Apache-2.0
// Converts a row to the cells of a store, and computes the checksum that detects damaged cells.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "files/store/sqlite.hpp"
#include "sixstep/analysis/plan/plan_table.hpp"

namespace files {

/// A 64-bit checksum over the values, their kinds and their order. It is not cryptographic: it detects only
/// accidental changes.
std::uint64_t checksum_of(const std::vector<Cell>& cells, std::uint64_t before);

/// The cells of a row: run, end, passed, problem, remarks, digest, keys, values of the spread, figures. NaN
/// becomes null, -0 becomes 0, and control characters in texts are made visible (text/escape/escape.hpp).
std::vector<Cell> cells_of(const analysis::RunRecord& record);

/// The number of cells in a row with these columns.
std::size_t cells_in_row(const analysis::PlanColumns& columns);

/// Returns the row with these cells. Problem: cells_of() cannot have written the cells; `limit` states the
/// difference as a clause.
base::Result<analysis::RunRecord> record_of_cells(const std::vector<Cell>& cells,
                                                  const analysis::TableColumns& columns);

}  // namespace files
