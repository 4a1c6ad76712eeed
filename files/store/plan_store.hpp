// SPDX-License-Identifier: Apache-2.0
// Stores the finished runs of a plan in one SQLite file. A row is stored completely or not at all, even if
// the program is killed. docs/howto/run-many.md describes the tables.
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

/// The description of a store. To continue a store, the first three members and the columns must be equal to
/// those in the file.
struct StoredPlan {
  std::string sixstep{};  ///< version that made all rows of the store; empty: the running version
  std::string plan;       ///< the plan in one line (text::plan_identity)
  std::string
      inputs;  ///< digest of all files read for the scenario and of the values that the command line set
  std::string title, motor, scenario, command;
  std::string scenario_text;  ///< the complete scenario, as a file
  analysis::TableColumns columns;
};

class PlanStore {
 public:
  /// Creates a store. `path` must not exist, unless `force` is set and the file is a store. An empty path
  /// creates an unnamed store that is removed at the program's end.
  static base::Result<PlanStore> create(const std::string& path, StoredPlan plan, bool force);
  /// Opens a store to continue it. Problems: the store is damaged, or it belongs to another plan or version.
  static base::Result<PlanStore> resume(const std::string& path, StoredPlan plan);
  /// Opens a store to read it, and compares every row with its checksum. Problems: the store is damaged.
  static base::Result<PlanStore> read(const std::string& path);

  PlanStore(PlanStore&&) noexcept;
  PlanStore& operator=(PlanStore&&) noexcept;
  ~PlanStore();

  const StoredPlan& plan() const;
  const std::string& path() const;
  /// Number of rows in the file.
  std::size_t rows() const;
  bool has(std::size_t number) const;

  /// Queues a row, from any thread. As soon as the row is in the file, rows() counts it. A row with other
  /// columns is not written, and failed() then returns true.
  void add(analysis::RunRecord&& record);
  /// Whether a row could not be written. Then no further rows are written.
  bool failed() const;
  /// Waits until all rows are in the file. Problems: the reason why a row is missing.
  base::Problems finish();

  /// Calls `visit` for the rows in the order of the runs' numbers. Problems: the reason why a row could not
  /// be read. The member `point` of a row contains numbers as given, and words without quotes.
  base::Problems each(const std::function<void(const analysis::RunRecord&)>& visit);

 private:
  struct Inside;
  explicit PlanStore(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

}  // namespace files
