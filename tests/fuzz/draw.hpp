// SPDX-License-Identifier: Apache-2.0
// The random numbers of one case. Only the seed determines them.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

namespace sixstep::testing {

/// A seed must always give the same numbers. The distributions of standard libraries differ, so the project's
/// own code maps the random bits to intervals.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// A number from `low` to `high`; every decade is equally likely.
  double decades(double low, double high) { return low * std::pow(high / low, unit()); }
  bool chance(double p) { return unit() < p; }
  int one_of(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  std::uint64_t bits() { return random_(); }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }

 private:
  std::mt19937_64 random_;
};

inline std::uint64_t environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text && *text ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// The seeds of a test. SIXSTEP_FUZZ_SEED=n selects only the seed n. SIXSTEP_FUZZ_COUNT sets the number of
/// seeds.
struct Seeds {
  std::uint64_t first, count;
};
inline Seeds seeds(std::uint64_t usual_count) {
  const bool one = std::getenv("SIXSTEP_FUZZ_SEED") != nullptr;
  return {environment("SIXSTEP_FUZZ_SEED", 1), environment("SIXSTEP_FUZZ_COUNT", one ? 1 : usual_count)};
}

}  // namespace sixstep::testing
