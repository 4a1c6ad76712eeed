// SPDX-License-Identifier: Apache-2.0
// Random complete drives. Each run ends at its duration with finite values, and obeys the laws of model.md 5.
#include <gtest/gtest.h>

#include "tests/fuzz/drawn_drive.hpp"
#include "tests/support/laws.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

/// Checks the laws and counts the segments. A valid run of this length never reaches the limit of segments.
/// The limit therefore detects a run that hardly advances.
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
  // A tenth of the tolerance of the other tests, because the error of none of 100 000 drives exceeded 1e-13.
  watchdog.laws.expect_all(1e-12);
}

TEST(Fuzz, DrawnDrivesKeepTheLaws) {
  const Seeds range = seeds(5000);
  for (std::uint64_t n = 0; n < range.count; ++n) run_one(range.first + n);
}

}  // namespace SIXSTEP_TEST_FILE
