// SPDX-License-Identifier: Apache-2.0
// Counts how often intervals contain the true value.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace sixstep::testing {

/// Number of random cases: the value of the environment variable SIXSTEP_BENCH_LOGS, else `usual`.
inline int drawn_count(int usual) {
  const char* const wanted = std::getenv("SIXSTEP_BENCH_LOGS");
  return wanted ? std::atoi(wanted) : usual;
}
inline bool in_full() { return std::getenv("SIXSTEP_BENCH_LOGS") != nullptr; }

class HeldOften {
 public:
  explicit HeldOften(std::string what) : what_(std::move(what)) {}
  void count(bool held, std::uint64_t seed) {
    ++all_;
    if (held)
      ++held_;
    else if (missed_.size() < 400)
      missed_ += " " + std::to_string(seed);
  }
  double part() const { return held_ / all_; }

  /// Expects that 95 % of the intervals contain the true value. Tolerance: 93 to 97 % for a thousand cases or
  /// more, else four standard deviations of the binomial distribution. `cases` is the number of independent
  /// cases, if one case gives several intervals.
  void expect_95(double cases = 0.0) const {
    const double n = cases > 0.0 ? cases : all_;
    const double width = width_of(n);
    std::printf("%s: %.0f of %.0f held, %.1f %%; seeds of those missed:%s\n", what_.c_str(), held_, all_,
                100.0 * part(), missed_.c_str());
    EXPECT_NEAR(part(), 0.95, width) << what_;
  }
  /// Expects that at least 95 % of the intervals contain the true value, with the same tolerance.
  void expect_at_least_95(double cases = 0.0) const {
    const double n = cases > 0.0 ? cases : all_;
    const double width = width_of(n);
    std::printf("%s: %.0f of %.0f held, %.1f %%\n", what_.c_str(), held_, all_, 100.0 * part());
    EXPECT_GE(part(), 0.95 - width) << what_ << "; seeds of those missed:" << missed_;
  }

 private:
  /// Tolerance of the counted part. Full test: 2.9 standard deviations of a binomial count, but at least 2 %,
  /// the narrowest stated accuracy. Short test: four standard deviations.
  static double width_of(double n) {
    const double deviation = std::sqrt(0.05 * 0.95 / n);
    return in_full() ? std::fmax(2.9 * deviation, 0.02) : 4.0 * deviation;
  }

  std::string what_, missed_;
  double held_ = 0, all_ = 0;
};

}  // namespace sixstep::testing
