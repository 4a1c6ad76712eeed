// SPDX-License-Identifier: Apache-2.0
// Records the cost of each call, and computes the statistics over all calls.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace target {

class Counts {
 public:
  void add(std::uint64_t count) { all_.push_back(count); }
  /// Prints five values: the name, the number of calls, the rounded mean, the count that 99.9 % of the calls
  /// do not exceed, and the largest count.
  void tell(std::FILE* to, const char* name) {
    if (all_.empty()) return;
    std::sort(all_.begin(), all_.end());
    std::uint64_t sum = 0;
    for (const std::uint64_t x : all_) sum += x;
    const std::size_t n = all_.size(), within = (n * 999 + 999) / 1000 - 1;
    std::fprintf(to, "cost %s %zu %llu %llu %llu\n", name, n,
                 static_cast<unsigned long long>((sum + n / 2) / n),
                 static_cast<unsigned long long>(all_[within]), static_cast<unsigned long long>(all_.back()));
  }

 private:
  std::vector<std::uint64_t> all_;
};

}  // namespace target
