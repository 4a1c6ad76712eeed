// SPDX-License-Identifier: Apache-2.0
// Wraps SQLite's handles as values that close themselves and report failures as Problems. Reasons for SQLite:
// a database is one file, its transactions survive a kill at any instant, and its query language is available
// everywhere.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "files/rooms.hpp"
#include "files/store/sqlite_calls.hpp"
#include "sixstep/base/result.hpp"

namespace files {

/// A value of SQLite: null, whole number, number, or text. BLOBs are not used.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

/// A statement that is executed repeatedly. As in SQLite, parameters are counted from 1, columns from 0.
class Statement {
 public:
  explicit Statement(sqlite3_stmt* statement) : statement_(statement) {}

  void bind(int place, std::int64_t x) { sqlite().bind_int64(statement_.get(), place, x); }
  void bind(int place, std::string_view text) {
    sqlite().bind_text(statement_.get(), place, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }
  /// Binds a number. NaN becomes NULL; infinity is stored.
  void bind(int place, double x) { sqlite().bind_double(statement_.get(), place, x); }
  void bind_cell(int place, const Cell& cell) {
    sqlite().bind_null(statement_.get(), place);
    if (const auto* whole = std::get_if<std::int64_t>(&cell)) bind(place, *whole);
    if (const auto* number = std::get_if<double>(&cell)) bind(place, *number);
    if (const auto* text = std::get_if<std::string>(&cell)) bind(place, std::string_view(*text));
  }

  /// Advances to the next row; false if there is none. Then the statement can be bound and executed again.
  bool step() {
    code_ = sqlite().step(statement_.get());
    if (code_ == SQLITE_ROW) return true;
    sqlite().reset(statement_.get());
    return false;
  }
  bool failed() const { return code_ != SQLITE_ROW && code_ != SQLITE_DONE; }
  int code() const { return code_; }

  std::int64_t whole(int column) const { return sqlite().column_int64(statement_.get(), column); }
  std::optional<double> number(int column) const {
    if (sqlite().column_type(statement_.get(), column) == SQLITE_NULL) return {};
    return sqlite().column_double(statement_.get(), column);
  }
  Cell cell(int column) const {
    switch (sqlite().column_type(statement_.get(), column)) {
      case SQLITE_INTEGER:
        return whole(column);
      case SQLITE_FLOAT:
        return sqlite().column_double(statement_.get(), column);
      case SQLITE_TEXT:
        return text(column);
      default:
        return std::monostate{};
    }
  }
  int columns() const { return sqlite().column_count(statement_.get()); }
  std::string text(int column) const {
    const auto* chars = reinterpret_cast<const char*>(sqlite().column_text(statement_.get(), column));
    return chars
               ? std::string(chars, static_cast<std::size_t>(sqlite().column_bytes(statement_.get(), column)))
               : std::string();
  }

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* s) const { sqlite().finalize(s); }
  };
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  int code_ = SQLITE_DONE;
};

class Database {
 public:
  /// Opens a database. An empty path opens an unnamed file that is removed when it is closed.
  static base::Result<Database> open(const std::string& path);

  /// Executes any number of statements that have no results.
  base::Problems run(const std::string& sql);
  base::Result<Statement> prepare(const std::string& sql);

  const std::string& path() const { return path_; }
  /// The Problem of a database that cannot be read or written, with SQLite's reason.
  base::Problem problem() const;

 private:
  struct Close {
    void operator()(sqlite3* db) const { sqlite().close_v2(db); }
  };
  std::unique_ptr<sqlite3, Close> handle_;
  std::string path_;
};

/// The Problem of a damaged store. `how` is a clause that says what is damaged, such as "its tables do not match
/// its columns".
base::Problem damaged(const std::string& path, const std::string& how);

/// A name for SQL, including the quotes: "a name".
std::string sql_name(std::string_view name);

}  // namespace files
