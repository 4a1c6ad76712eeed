// SPDX-License-Identifier: Apache-2.0
#include "files/store/plan_store.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

#include "files/store/store_schema.hpp"

namespace files {

/// Rows wait for the writer, which writes all that wait in one transaction: few while runs are long, many while they are short.
/// What a kill can take is what has not been counted yet.
struct PlanStore::Inside {
  static constexpr std::size_t most_waiting = 4096;

  Inside(Database database, StoredPlan stored) : db(std::move(database)), plan(std::move(stored)) {}
  ~Inside() { end(); }

  base::Problems begin() {
    base::Result<Statement> statement = db.prepare(insert_sql(plan));
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
        for (const analysis::RunRecord& row : rows) note(row.number);
      problems = std::move(wrong);
      moved.notify_all();
    }
  }
  base::Problems put(const std::vector<analysis::RunRecord>& rows) {
    if (base::Problems wrong = db.run("BEGIN IMMEDIATE"); !wrong.empty()) return wrong;
    for (const analysis::RunRecord& row : rows) {
      bind_row(*insert, row, plan.columns);
      insert->step();
      if (!insert->failed()) continue;
      base::Problems wrong{db.problem()};
      db.run("ROLLBACK");
      return wrong;
    }
    return db.run("COMMIT");
  }
  void note(std::size_t number) {
    if (number >= there.size()) there.resize(number + 1);
    count += there[number] ? 0 : 1;
    there[number] = true;
  }

  Database db;
  StoredPlan plan;
  std::optional<Statement> insert;
  mutable std::mutex guard;
  std::condition_variable_any moved;
  std::vector<analysis::RunRecord> waiting;
  std::vector<bool> there;
  std::size_t count = 0;
  base::Problems problems;
  std::jthread writer;  // last: it ends before what it works on
};

namespace {

/// One file while nobody writes, and no other program in it while somebody does. Nothing is forced to the disk at each
/// transaction: only a power cut takes the last ones back, and leaves a whole store all the same.
constexpr char modes[] = "PRAGMA locking_mode=EXCLUSIVE; PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;";

enum class Standing { nothing, store, other };

/// By SQLite's header, so that a store that somebody is writing is known as one, too.
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

/// Its tables come in one transaction: who was killed in it left none.
bool was_killed_at_birth(const std::string& path) {
  base::Result<Database> db = Database::open(path);
  base::Result<Statement> tables =
      db ? db->prepare("SELECT count(*) FROM sqlite_schema") : base::Result<Statement>(db.problems());
  return tables && tables->step() && tables->whole(0) == 0;
}

base::Problem foreign(const std::string& path) {
  return {path + ":", "", "is no store of runs", "name another file: sixstep writes over its own alone"};
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
    return base::Problem{path + ":", "", "holds runs already",
                         "go on with them (resume), name another file, or overwrite it (force)"};
  if (standing == Standing::store)
    for (const char* part : {"", "-wal", "-shm"}) ::remove((path + part).c_str());
  base::Result<Database> db = Database::open(path);
  if (!db) return db.problems();
  if (base::Problems wrong = db->run("BEGIN;" + schema_sql(plan)); !wrong.empty()) return wrong;
  if (base::Problems wrong = write_plan(*db, plan); !wrong.empty()) return wrong;
  if (base::Problems wrong = db->run(std::string("COMMIT;") + modes); !wrong.empty()) return wrong;
  auto inside = std::make_unique<Inside>(std::move(*db), std::move(plan));
  if (base::Problems wrong = inside->begin(); !wrong.empty()) return wrong;
  return PlanStore(std::move(inside));
}

base::Result<PlanStore> PlanStore::read(const std::string& path) {
  if (standing_at(path) != Standing::store) return foreign(path);
  base::Result<Database> db = Database::open(path);
  if (!db) return db.problems();
  if (base::Problems wrong = db->run(modes); !wrong.empty()) return wrong;
  base::Result<StoredPlan> plan = read_plan(*db);
  if (!plan) return plan.problems();
  auto inside = std::make_unique<Inside>(std::move(*db), std::move(*plan));
  base::Result<Statement> numbers = inside->db.prepare("SELECT number FROM run");
  if (!numbers) return numbers.problems();
  while (numbers->step()) inside->note(static_cast<std::size_t>(numbers->whole(0)));
  if (numbers->failed()) return inside->db.problem();
  return PlanStore(std::move(inside));
}

base::Result<PlanStore> PlanStore::resume(const std::string& path, StoredPlan plan) {
  if (standing_at(path) == Standing::nothing) return create(path, std::move(plan), false);
  if (standing_at(path) == Standing::store && was_killed_at_birth(path))
    return create(path, std::move(plan), true);
  base::Result<PlanStore> store = read(path);
  if (!store) return store;
  const StoredPlan& before = store->plan();
  if (before.plan != plan.plan)
    return base::Problem{path + ":", "", "holds the runs of another plan: " + before.plan,
                         "name another store for this plan: " + plan.plan};
  if (before.inputs != plan.inputs || !(before.columns == plan.columns))
    return base::Problem{
        path + ":", "",
        "holds runs of a scenario that was changed since: " + before.scenario + " or a file that it names",
        "name another store, or overwrite this one (force)"};
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
  base::Result<Statement> select = inside_->db.prepare(select_sql(inside_->plan));
  if (!select) return select.problems();
  while (select->step()) visit(row_of(*select, inside_->plan.columns));
  if (select->failed()) return {inside_->db.problem()};
  return {};
}

}  // namespace files
