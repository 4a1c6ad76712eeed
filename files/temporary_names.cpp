// SPDX-License-Identifier: Apache-2.0
#include "files/temporary_names.hpp"

#include <unistd.h>

#include <atomic>

namespace files {
namespace {

// A fixed array, because a signal handler must not lock or allocate.
constexpr int most_temporaries = 512;
std::atomic<const char*> being_written[most_temporaries];
static_assert(std::atomic<const char*>::is_always_lock_free);

void change(const char* from, const char* to) {
  for (std::atomic<const char*>& name : being_written)
    if (const char* is = from; name.compare_exchange_strong(is, to)) return;
}

}  // namespace

void note_temporary(const char* name) { change(nullptr, name); }
void forget_temporary(const char* name) { change(name, nullptr); }

void remove_temporary_files() {
  for (const std::atomic<const char*>& name : being_written)
    if (const char* is = name.load(); is != nullptr && *is != '\0') ::unlink(is);
}

}  // namespace files
