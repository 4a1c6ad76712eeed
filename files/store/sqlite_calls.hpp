// SPDX-License-Identifier: Apache-2.0
// SQLite's functions. The library is loaded when the first store is opened, because loading it takes a quarter of
// the program's start.
#pragma once
#include <sqlite3.h>

namespace files {

// The functions that stores use, without the prefix sqlite3_.
// clang-format off
#define SIXSTEP_SQLITE_CALLS(X) \
  X(open_v2) X(close_v2) X(exec) X(prepare_v2) X(step) X(reset) X(finalize) X(bind_int64) \
  X(bind_double) X(bind_text) X(bind_null) X(column_count) X(column_type) X(column_int64) \
  X(column_double) X(column_text) X(column_bytes) X(errcode) X(errmsg)
// clang-format on

struct SqliteCalls {
// A declaration cannot be in parentheses.
// NOLINTNEXTLINE(bugprone-macro-parentheses)
#define SIXSTEP_SQLITE_MEMBER(name) decltype(&sqlite3_##name) name = nullptr;
  SIXSTEP_SQLITE_CALLS(SIXSTEP_SQLITE_MEMBER)
#undef SIXSTEP_SQLITE_MEMBER
};

/// The functions of the loaded library; null if it cannot be loaded. Any number of threads may call this
/// function.
const SqliteCalls* sqlite_calls();

/// Requires that sqlite_calls() was not null before: a handle of a database exists.
inline const SqliteCalls& sqlite() { return *sqlite_calls(); }

}  // namespace files
