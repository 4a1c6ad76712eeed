// SPDX-License-Identifier: Apache-2.0
// The tables of a store (docs/howto/run-many.md), and what it says of itself in them.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/store/plan_store.hpp"

namespace files {

/// Of SQLite's header: whose file it is.
inline constexpr std::string_view store_mark = "SIXS";
/// 1 had no checksums.
inline constexpr int store_format = 2;

/// The plan as a store has it: what acts in a text is shown (text/escape/escape.hpp).
StoredPlan as_stored(StoredPlan plan);

// Of a plan as_stored():

/// Creates all tables and the view `runs`, a statement each.
std::vector<std::string> schema_of(const StoredPlan& plan);
/// With a place for each cell of a row (stored_row.hpp) and one for its checksum.
std::string insert_sql(const StoredPlan& plan);
/// The same cells, in the order of the runs' numbers.
std::string select_sql(const StoredPlan& plan);
/// What the checksums of its rows begin with: a row of another plan does not fit.
std::uint64_t checksum_begin(const StoredPlan& plan);

/// What stands in `about` and `columns`.
base::Problems write_plan(Database& db, const StoredPlan& plan);
/// Problems where it is of another format, or is not what was written: its marks, words, columns and tables.
base::Result<StoredPlan> read_plan(Database& db);

}  // namespace files
