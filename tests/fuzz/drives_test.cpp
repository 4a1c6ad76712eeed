// SPDX-License-Identifier: Apache-2.0
// Whole drives at random: each run ends where it should, in numbers, by the laws of model.md 5, and without
// getting stuck.
#include <gtest/gtest.h>

#include "tests/fuzz/drawn_drive.hpp"
#include "tests/support/laws.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

/// Laws, and a count that no honest run of these lengths reaches: time that crawls is a hang too.
class Watchdog {
 public:
  template <class System>
  void segment(const System& system, double s) {
    laws.segment(system, s);
    ++segments_;
  }
  template <class System>
  bool done(const System&) const {
    return segments_ > 1'000'000;
  }
  LawChecker<> laws;

 private:
  std::int64_t segments_ = 0;
};

bool finite(const plant::State<double>& s) {
  return std::isfinite(s.i[0]) && std::isfinite(s.i[1]) && std::isfinite(s.i[2]) && std::isfinite(s.w) &&
         std::isfinite(s.x) && std::isfinite(s.bus);
}

void run_one(std::uint64_t seed) {
  const DrawnDrive drive(seed);
  SCOPED_TRACE(reproduce(seed, drive));
  auto rig = drive.rig();
  Watchdog watchdog;
  EXPECT_EQ(run_to(rig, drive.length_s, watchdog), sim::Stop::end)
      << "at " << rig.now().seconds() << " fault " << int(rig.fault());
  EXPECT_TRUE(finite(rig.plant().state()));
  // A tenth of what is asked of every run: of 100 000 drives none missed 1e-13.
  watchdog.laws.expect_all(1e-12);
}

TEST(Fuzz, DrawnDrivesKeepTheLaws) {
  const Seeds range = seeds(5000);
  for (std::uint64_t n = 0; n < range.count; ++n) run_one(range.first + n);
}

}  // namespace SIXSTEP_TEST_FILE
