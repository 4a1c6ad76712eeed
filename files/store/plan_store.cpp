// SPDX-License-Identifier: Apache-2.0
#include "files/store/plan_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

#include "files/store/store_schema.hpp"
#include "files/store/stored_row.hpp"
#include "text/escape/escape.hpp"

namespace files {
namespace {

/// No other program can open the store, and it is a single file after the writer has closed it. Transactions
/// are not forced to the disk: a power failure loses only the last transactions, and the store stays intact.
constexpr char modes[] = "PRAGMA locking_mode=EXCLUSIVE; PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;";

}  // namespace

/// Rows are queued for the writer thread, which writes all queued rows in one transaction. The queue contains
/// few rows if runs are long, and many rows if runs are short. If the program is killed, it loses only the
/// rows that rows() does not yet count.
struct PlanStore::Inside {
  static constexpr std::size_t most_waiting = 4096;

  Inside(Database database, StoredPlan told)
      : db(std::move(database)),
        plan(std::move(told)),
        stored(as_stored(plan)),
        begin_of_checksums(checksum_begin(stored)) {}
  ~Inside() { end(); }

  /// Creates all tables of a new store in one transaction.
  base::Problems bear() {
    if (base::Problems wrong = db.run(fmt::format("BEGIN; PRAGMA application_id={}; PRAGMA user_version={}",
                                                  0x53495853, store_format));  // store_mark
        !wrong.empty())
      return wrong;
    for (const std::string& sql : schema_of(stored))
      if (base::Problems wrong = db.run(sql); !wrong.empty()) return wrong;
    if (base::Problems wrong = write_plan(db, stored); !wrong.empty()) return wrong;
    return db.run(std::string("COMMIT;") + modes);
  }
  base::Problems begin() {
    base::Result<Statement> statement = db.prepare(insert_sql(stored));
    if (!statement) return statement.problems();
    insert.emplace(std::move(*statement));
    writer = std::jthread([this](const std::stop_token& stop) { write(stop); });
    return {};
  }
  void end() {
    if (!writer.joinable()) return;
    writer.request_stop();
    writer.join();
  }

  void write(const std::stop_token& stop) {
    std::unique_lock lock(guard);
    for (;;) {
      moved.wait(lock, stop, [&] { return !waiting.empty(); });
      if (waiting.empty()) return;
      std::vector<analysis::RunRecord> rows = std::exchange(waiting, {});
      lock.unlock();
      base::Problems wrong = problems.empty() ? put(rows) : problems;
      lock.lock();
      if (wrong.empty())
        for (const analysis::RunRecord& row : rows) note(row->number);
      problems = std::move(wrong);
      moved.notify_all();
    }
  }
  base::Problems put(const std::vector<analysis::RunRecord>& rows) {
    if (base::Problems wrong = db.run("BEGIN IMMEDIATE"); !wrong.empty()) return wrong;
    for (const analysis::RunRecord& row : rows) {
      base::Problems wrong = put(row);
      if (wrong.empty()) continue;
      db.run("ROLLBACK");
      return wrong;
    }
    return db.run("COMMIT");
  }
  base::Problems put(const analysis::RunRecord& row) {
    if (!row.fits(plan.columns))
      return {
          {db.path() + ":", "",
           fmt::format("cannot store run {}: its columns differ from the columns of the plan", row->number),
           "this is a defect of sixstep: report this message, with the command, in the issues of the repository"}};
    std::vector<Cell> cells = cells_of(row);
    cells.emplace_back(static_cast<std::int64_t>(checksum_of(cells, begin_of_checksums)));
    for (std::size_t n = 0; n < cells.size(); ++n) insert->bind_cell(static_cast<int>(n) + 1, cells[n]);
    insert->step();
    if (insert->failed()) return {db.problem()};
    return {};
  }
  /// Reads the present row of a SELECT. Problem: its checksum is wrong.
  base::Result<analysis::RunRecord> row_at(const Statement& select) {
    std::vector<Cell> cells;
    cells.reserve(cells_in_row(*plan.columns));
    for (int n = 0; n + 1 < select.columns(); ++n) cells.push_back(select.cell(n));
    const auto told = static_cast<std::int64_t>(checksum_of(cells, begin_of_checksums));
    base::Result<analysis::RunRecord> record = record_of_cells(cells, plan.columns);
    if (record && select.cell(select.columns() - 1) == Cell(told)) return record;
    return damaged(db.path(), fmt::format("run {} differs from the written row", select.whole(0)));
  }
  base::Problems each(const std::function<void(const analysis::RunRecord&)>& visit) {
    base::Result<Statement> select = db.prepare(select_sql(stored));
    if (!select) return select.problems();
    while (select->step()) {
      const base::Result<analysis::RunRecord> row = row_at(*select);
      if (!row) return row.problems();
      visit(*row);
    }
    if (select->failed()) return {db.problem()};
    return {};
  }
  void note(std::size_t number) {
    if (number >= there.size()) there.resize(number + 1);
    count += there[number] ? 0 : 1;
    there[number] = true;
  }

  Database db;
  StoredPlan plan;
  StoredPlan stored;  ///< plan as stored in the file
  std::uint64_t begin_of_checksums;
  std::optional<Statement> insert;
  mutable std::mutex guard;
  std::condition_variable_any moved;
  std::vector<analysis::RunRecord> waiting;
  std::vector<bool> there;
  std::size_t count = 0;
  base::Problems problems;
  std::jthread writer;  // last member, so that it ends before the members that it uses are destroyed
};

namespace {

enum class Standing { nothing, store, other };

/// Recognises a store by SQLite's header, which exists even while another program writes the store.
Standing standing_at(const std::string& path) {
  std::error_code error;
  if (path.empty() || !std::filesystem::exists(path, error)) return Standing::nothing;
  if (!std::filesystem::is_regular_file(path, error)) return Standing::other;
  if (std::filesystem::file_size(path, error) == 0) return Standing::nothing;
  char head[72] = {};
  std::ifstream(path, std::ios::binary).read(head, sizeof head);
  const std::string_view begin(head, sizeof head), id = begin.substr(68);
  return begin.starts_with("SQLite format 3") && id == store_mark ? Standing::store : Standing::other;
}

/// Whether a program was killed while it created the store in this file. All tables are created in one
/// transaction, so such a file is empty after SQLite's recovery. A damaged store still contains pages.
bool was_killed_at_birth(const std::string& path) {
  base::Result<Database> db = Database::open(path);
  base::Result<Statement> pages =
      db ? db->prepare("PRAGMA page_count") : base::Result<Statement>(db.problems());
  return pages && pages->step() && pages->whole(0) == 0;
}

/// Runs SQLite's check of every page: whether rows exist and are in order. The checksums cover the contents
/// of rows.
base::Problems check_pages(Database& db) {
  base::Result<Statement> check = db.prepare("PRAGMA quick_check(1)");
  if (!check) return check.problems();
  const std::string said = check->step() ? check->text(0) : std::string();
  if (check->failed()) return {db.problem()};
  if (said == "ok") return {};
  return {damaged(db.path(), "SQLite says: " + text::visible(said))};
}

base::Problem foreign(const std::string& path) {
  return {path + ":", "", "is not a store of runs",
          "name another file: sixstep overwrites only its own files"};
}

}  // namespace

PlanStore::PlanStore(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
PlanStore::PlanStore(PlanStore&&) noexcept = default;
PlanStore& PlanStore::operator=(PlanStore&&) noexcept = default;
PlanStore::~PlanStore() = default;

base::Result<PlanStore> PlanStore::create(const std::string& path, StoredPlan plan, bool force) {
  const Standing standing = standing_at(path);
  if (standing == Standing::other) return foreign(path);
  if (standing == Standing::store && !force)
    return base::Problem{path + ":", "", "already contains runs",
                         "continue the runs (resume), name another file, or overwrite this file (force)"};
  if (standing == Standing::store)
    for (const char* part : {"", "-wal", "-shm"}) ::remove((path + part).c_str());
  base::Result<Database> db = Database::open(path);
  if (!db) return db.problems();
  auto inside = std::make_unique<Inside>(std::move(*db), std::move(plan));
  if (base::Problems wrong = inside->bear(); !wrong.empty()) return wrong;
  if (base::Problems wrong = inside->begin(); !wrong.empty()) return wrong;
  return PlanStore(std::move(inside));
}

base::Result<PlanStore> PlanStore::read(const std::string& path) {
  if (standing_at(path) != Standing::store) return foreign(path);
  base::Result<Database> db = Database::open(path);
  if (!db) return db.problems();
  if (base::Problems wrong = check_pages(*db); !wrong.empty()) return wrong;
  if (base::Problems wrong = db->run(modes); !wrong.empty()) return wrong;
  base::Result<StoredPlan> plan = read_plan(*db);
  if (!plan) return plan.problems();
  auto inside = std::make_unique<Inside>(std::move(*db), std::move(*plan));
  base::Problems wrong = inside->each([&](const analysis::RunRecord& row) { inside->note(row->number); });
  if (!wrong.empty()) return wrong;
  return PlanStore(std::move(inside));
}

base::Result<PlanStore> PlanStore::resume(const std::string& path, StoredPlan plan) {
  if (standing_at(path) == Standing::nothing) return create(path, std::move(plan), false);
  if (standing_at(path) == Standing::store && was_killed_at_birth(path))
    return create(path, std::move(plan), true);
  base::Result<PlanStore> store = read(path);
  if (!store) return store;
  const StoredPlan before = store->plan(), now = as_stored(plan);
  const auto refuse = [&](std::string limit, std::string cure) {
    return base::Problem{path + ":", "", std::move(limit), std::move(cure)};
  };
  if (before.sixstep != now.sixstep)
    return refuse("was begun by sixstep " + before.sixstep + ", but this is " + now.sixstep +
                      "; rows of two versions cannot be distinguished",
                  "finish the runs with the other version, or start again (force)");
  if (before.plan != now.plan)
    return refuse("contains the runs of another plan: " + before.plan,
                  "name another store for this plan: " + now.plan);
  if (before.inputs != now.inputs || *before.columns != *now.columns)
    return refuse("contains runs of a scenario that has changed since then: " + before.scenario +
                      " or a file that it names",
                  "name another store, or overwrite this store (force)");
  // Messages name columns as the plan does, not as the file does.
  store->inside_->plan = std::move(plan);
  if (base::Problems wrong = store->inside_->begin(); !wrong.empty()) return wrong;
  return store;
}

const StoredPlan& PlanStore::plan() const { return inside_->plan; }

const std::string& PlanStore::path() const { return inside_->db.path(); }

std::size_t PlanStore::rows() const {
  const std::lock_guard lock(inside_->guard);
  return inside_->count;
}

bool PlanStore::has(std::size_t number) const {
  const std::lock_guard lock(inside_->guard);
  return number < inside_->there.size() && inside_->there[number];
}

void PlanStore::add(analysis::RunRecord&& record) {
  std::unique_lock lock(inside_->guard);
  inside_->moved.wait(lock, [&] { return inside_->waiting.size() < Inside::most_waiting; });
  inside_->waiting.push_back(std::move(record));
  inside_->moved.notify_all();
}

bool PlanStore::failed() const {
  const std::lock_guard lock(inside_->guard);
  return !inside_->problems.empty();
}

base::Problems PlanStore::finish() {
  inside_->end();
  return inside_->problems;
}

base::Problems PlanStore::each(const std::function<void(const analysis::RunRecord&)>& visit) {
  return inside_->each(visit);
}

}  // namespace files
