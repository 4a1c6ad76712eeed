// SPDX-License-Identifier: Apache-2.0
// A row of a store: its cells, and the checksum that tells whether they are those that were written.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "files/store/sqlite.hpp"
#include "sixstep/analysis/plan/plan_table.hpp"

namespace files {

/// 64 bits of values, their kinds and their order. No cryptography: it finds accidents, not forgers.
std::uint64_t checksum_of(const std::vector<Cell>& cells, std::uint64_t before);

/// A row as it is stored: run, end, passed, problem, digest, keys, strayed values, figures. A number that is none is nothing, and -0
/// is 0; what acts in a text is shown (text/escape/escape.hpp).
std::vector<Cell> cells_of(const analysis::RunRecord& record);

/// How many cells a row of these columns has.
std::size_t cells_in_row(const analysis::PlanColumns& columns);

/// The row of these cells. Problems where they are not what cells_of() makes of one; `limit` says how, as a clause.
base::Result<analysis::RunRecord> record_of_cells(const std::vector<Cell>& cells,
                                                  const analysis::TableColumns& columns);

}  // namespace files
