// SPDX-License-Identifier: Apache-2.0
#include "files/store/sqlite.hpp"

namespace files {

base::Result<Database> Database::open(const std::string& path) {
  if (!sqlite_calls())
    return base::Problem{path.empty() ? "the rows of the runs" : path + ":", "",
                         "needs SQLite, and libsqlite3.so.0 cannot be loaded",
                         "install the library: apt install libsqlite3-0"};
  Database db;
  db.path_ = path;
  sqlite3* handle = nullptr;
  const int code = sqlite().open_v2(
      path.c_str(), &handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
  db.handle_.reset(handle);
  if (code != SQLITE_OK) return db.problem();
  return db;
}

base::Problems Database::run(const std::string& sql) {
  if (sqlite().exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK) return {};
  return {problem()};
}

base::Result<Statement> Database::prepare(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite().prepare_v2(handle_.get(), sql.c_str(), static_cast<int>(sql.size()), &statement, nullptr) !=
      SQLITE_OK)
    return problem();
  return Statement(statement);
}

base::Problem Database::problem() const {
  const int code = handle_ ? sqlite().errcode(handle_.get()) : SQLITE_NOMEM;
  if ((code & 0xff) == SQLITE_NOMEM)
    return {path_.empty() ? "the rows of the runs" : path_ + ":", "", "has not enough memory",
            "free memory, or reduce the work: fewer --jobs, fewer runs"};
  base::Problem problem{.where = path_ + ":", .limit = "cannot be used as a store"};
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {path_ + ":", "", "is in use by another program",
              "wait until the other program has closed the store, or name another store"};
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
      return damaged(path_, std::string("SQLite says: ") + sqlite().errmsg(handle_.get()));
    case SQLITE_FULL:
      return {path_ + ":", "", "cannot grow: the disk is full", "free disk space, and resume"};
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return {path_ + ":", "", "cannot be opened for writing", "name a file in a folder that can be written"};
    default:
      problem.limit += std::string(": ") + sqlite().errmsg(handle_.get());
      problem.cure = "name another file";
      return problem;
  }
}

base::Problem damaged(const std::string& path, const std::string& how) {
  return {path + ":", "", "is damaged: " + how, "use an older copy of the store, or start again (force)"};
}

std::string sql_name(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

}  // namespace files
