// SPDX-License-Identifier: Apache-2.0
// The tables of a store (docs/many-runs.md), and what goes into their rows.
#pragma once
#include <string>
#include <string_view>

#include "files/store/plan_store.hpp"

namespace files {

/// Of SQLite's header: whose file it is.
inline constexpr std::string_view store_mark = "SIXS";
inline constexpr int store_format = 1;

/// Creates all tables and the view `runs`.
std::string schema_sql(const StoredPlan& plan);

/// With a place for each column, in the order in which bind_row() fills them.
std::string insert_sql(const StoredPlan& plan);
void bind_row(Statement& insert, const analysis::RunRecord& record, const analysis::PlanColumns& columns);

std::string select_sql(const StoredPlan& plan);
analysis::RunRecord row_of(const Statement& select, const analysis::PlanColumns& columns);

/// What stands in `about` and `columns`.
base::Problems write_plan(Database& db, const StoredPlan& plan);
base::Result<StoredPlan> read_plan(Database& db);

}  // namespace files
