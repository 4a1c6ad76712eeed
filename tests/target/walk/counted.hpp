// SPDX-License-Identifier: Apache-2.0
// The call of a block in a walk. With TARGET_COUNTED, nothing is inlined around the call, which is between
// two marks of platform/marks.S. At its end, the walk prints the names of the counted functions, at most
// three per walk.
#pragma once
#include "tests/target/platform/print.hpp"

namespace target {

#ifdef TARGET_COUNTED
extern "C" {
void count_begins_0();
void count_begins_1();
void count_begins_2();
void count_ends();
void count_next();  ///< starts the counts of the next block
}

inline const char* counted_names[3];

template <class Call>
__attribute__((noinline)) auto called(const Call& call) {
  asm volatile("" ::: "memory");
  return call();
}

template <int slot, class Call>
__attribute__((always_inline)) inline auto counted(const char* name, const Call& call) {
  static_assert(slot >= 0 && slot < 3);
  counted_names[slot] = name;
  if constexpr (slot == 0) count_begins_0();
  if constexpr (slot == 1) count_begins_1();
  if constexpr (slot == 2) count_begins_2();
  if constexpr (__is_same(decltype(call()), void)) {
    called(call);
    count_ends();
  } else {
    const auto result = called(call);
    count_ends();
    return result;
  }
}

/// Prints `counted BLOCK SLOT NAME` for each counted function.
inline void tell_counted(const char* block) {
  count_next();
  for (std::uint8_t slot = 0; slot < 3; ++slot) {
    if (counted_names[slot] == nullptr) continue;
    print("counted ");
    print(block);
    print(" ");
    print_number(slot);
    print(" ");
    print(counted_names[slot]);
    print("\n");
    counted_names[slot] = nullptr;
  }
}
#else
template <int slot, class Call>
__attribute__((always_inline)) inline auto counted(const char*, const Call& call) {
  return call();
}
inline void tell_counted(const char*) {}
#endif

}  // namespace target
