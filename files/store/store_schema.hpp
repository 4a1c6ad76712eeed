// SPDX-License-Identifier: Apache-2.0
// Defines the tables of a store (docs/howto/run-many.md), also those with the store's description.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/store/plan_store.hpp"

namespace files {

/// The application mark in SQLite's header.
inline constexpr std::string_view store_mark = "SIXS";
/// Format 1 had no checksums, format 2 no remarks.
inline constexpr int store_format = 3;

/// Returns the plan with control characters in texts made visible (text/escape/escape.hpp), as a store
/// contains it.
StoredPlan as_stored(StoredPlan plan);

// The following functions expect a plan as_stored().

/// Creates all tables and the view `runs`, one statement each.
std::vector<std::string> schema_of(const StoredPlan& plan);
/// The INSERT for a row, with a placeholder for each cell (stored_row.hpp) and for the row's checksum.
std::string insert_sql(const StoredPlan& plan);
/// The SELECT of the same cells, in the order of the runs' numbers.
std::string select_sql(const StoredPlan& plan);
/// The initial value of the rows' checksums. It depends on the plan, so that a row of another plan does not
/// match.
std::uint64_t checksum_begin(const StoredPlan& plan);

/// Writes the tables `about` and `columns`.
base::Problems write_plan(Database& db, const StoredPlan& plan);
/// Reads a plan. Problems: another format; marks, words, columns or tables that write_plan() cannot have
/// written.
base::Result<StoredPlan> read_plan(Database& db);

}  // namespace files
