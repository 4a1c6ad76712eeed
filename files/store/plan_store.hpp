// SPDX-License-Identifier: Apache-2.0
// The finished runs of a plan in one SQLite file. A row is there whole or not at all, whatever kills the program; docs/howto/run-many.md
// has the tables.
#pragma once
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "files/store/sqlite.hpp"
#include "sixstep/analysis/plan/plan_table.hpp"

namespace files {

/// What a store says of itself. The first three must not change between two sittings, and neither may the columns.
struct StoredPlan {
  std::string sixstep{};  ///< the version that made all of its rows; empty: this one
  std::string plan;       ///< which runs, in one line (text::plan_identity)
  std::string
      inputs;  ///< digest of all that was read for the scenario and of what the command line set in it
  std::string title, motor, scenario, command;
  std::string scenario_text;  ///< whole, as a file
  analysis::TableColumns columns;
};

class PlanStore {
 public:
  /// A new store at a path where nothing is, or nothing but a store if `force`; at an empty path one without a name, which goes
  /// with the program.
  static base::Result<PlanStore> create(const std::string& path, StoredPlan plan, bool force);
  /// One that is there, to go on with. Problems where it is damaged, or of another plan or version.
  static base::Result<PlanStore> resume(const std::string& path, StoredPlan plan);
  /// One that is there, for whoever looks into it. Problems where it is damaged: every row is held against its checksum.
  static base::Result<PlanStore> read(const std::string& path);

  PlanStore(PlanStore&&) noexcept;
  PlanStore& operator=(PlanStore&&) noexcept;
  ~PlanStore();

  const StoredPlan& plan() const;
  const std::string& path() const;
  /// Rows that stand in the file.
  std::size_t rows() const;
  bool has(std::size_t number) const;

  /// A row to be written: it stands in the file a moment later, and `rows()` then counts it. From any thread. A row of other columns
  /// is not written, and the store has failed.
  void add(analysis::RunRecord&& record);
  /// A row could not be written, and none will be any more: there is no sense in going on.
  bool failed() const;
  /// Waits until all rows stand in the file. What kept one from it.
  base::Problems finish();

  /// In the order of the runs' numbers; what kept one from being read. Of a row's `point` numbers are as they were, words without their quotes.
  base::Problems each(const std::function<void(const analysis::RunRecord&)>& visit);

 private:
  struct Inside;
  explicit PlanStore(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

}  // namespace files
