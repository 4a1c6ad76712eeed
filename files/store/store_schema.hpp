// SPDX-License-Identifier: Apache-2.0
// Defines the tables of a store (docs/howto/run-many.md) and its description in them.
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

/// The plan as a store has it: control characters in texts are made visible (text/escape/escape.hpp).
StoredPlan as_stored(StoredPlan plan);

// These functions take a plan as_stored():

/// Creates all tables and the view `runs`, one statement each.
std::vector<std::string> schema_of(const StoredPlan& plan);
/// Has a place for each cell of a row (stored_row.hpp) and one for its checksum.
std::string insert_sql(const StoredPlan& plan);
/// Selects the same cells in the order of the runs' numbers.
std::string select_sql(const StoredPlan& plan);
/// The initial value of the rows' checksums, so that a row of another plan does not match.
std::uint64_t checksum_begin(const StoredPlan& plan);

/// Writes the tables `about` and `columns`.
base::Problems write_plan(Database& db, const StoredPlan& plan);
/// Problems: another format, or marks, words, columns or tables that differ from those written.
base::Result<StoredPlan> read_plan(Database& db);

}  // namespace files
