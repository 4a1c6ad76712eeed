// SPDX-License-Identifier: Apache-2.0
#include "files/store/sqlite_calls.hpp"

#include <dlfcn.h>

#include <cstring>
#include <optional>

namespace files {

namespace {

std::optional<SqliteCalls> loaded() {
  void* const library = dlopen("libsqlite3.so.0", RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) return {};
  SqliteCalls calls;
  bool whole = true;
  const auto find = [&](auto& function, const char* name) {
    void* const address = dlsym(library, name);
    whole = whole && address != nullptr;
    std::memcpy(&function, &address,
                sizeof address);  // C++ has no cast from an object's to a function's address
  };
#define SIXSTEP_SQLITE_FIND(name) find(calls.name, "sqlite3_" #name);
  SIXSTEP_SQLITE_CALLS(SIXSTEP_SQLITE_FIND)
#undef SIXSTEP_SQLITE_FIND
  return whole ? std::optional(calls) : std::nullopt;
}

}  // namespace

const SqliteCalls* sqlite_calls() {
  static const std::optional<SqliteCalls> calls = loaded();
  return calls ? &*calls : nullptr;
}

}  // namespace files
