// SPDX-License-Identifier: Apache-2.0
// Whole drives at random: each run ends where it should, in numbers, by the laws of MODEL 5, and without
// getting stuck.
#include <gtest/gtest.h>

#include "tests/fuzz/drawn_drive.hpp"
#include "tests/support/laws.hpp"

namespace {

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
  std::int64_t segments() const { return segments_; }
  LawChecker<> laws;

 private:
  std::int64_t segments_ = 0;
};

/// A voltage that must drive a leg on, but in the time at hand drives no current above its noise, leaves no
/// mode consistent until settle() has widened the noise of 64 eps, at most to 16^4 of it. In three million
/// drives a terminal stood at most 1e-11 of the voltage scale beyond a rail for it, and a diode carried 1e-13
/// of the stall current backwards.
constexpr double widest_noise = 65536 * 64 * eps;

/// The model's 1e-11; but a current within 64 eps that plant::snap() takes from a leg without gate goes from
/// the other legs too, and costs L i times that. With a dead time of nanoseconds on an ideal bridge near
/// standstill this happens once per period (5e-11 at most in three million drives). 1e-9 is a defect in any
/// case.
double energy_tolerance(const Watchdog& w, const plant::Constants<double>& c) {
  const double snapped = 64 * eps * c.amp_scale * w.laws.highest_current_A() / c.inv_L;
  const double all =
      static_cast<double>(w.segments()) * snapped / std::max(w.laws.audit().energy().moved, 1e-300);
  if (all > 1) return 1;  // nothing but rounding moved
  return std::clamp(all, 1e-11, 1e-9);
}

bool finite(const plant::State<double>& s) {
  return std::isfinite(s.i[0]) && std::isfinite(s.i[1]) && std::isfinite(s.i[2]) && std::isfinite(s.w) &&
         std::isfinite(s.x) && std::isfinite(s.bus);
}

void run_one(std::uint64_t seed, double slack = widest_noise) {
  const DrawnDrive drive(seed);
  SCOPED_TRACE(reproduce(seed, drive));
  auto rig = drive.rig();
  Watchdog watchdog;
  EXPECT_EQ(run_to(rig, drive.length_s, watchdog), sim::Stop::end)
      << "at " << rig.now().seconds() << " fault " << int(rig.fault());
  EXPECT_TRUE(finite(rig.plant().state()));
  const auto& c = rig.plant().constants();
  watchdog.laws.expect_all(energy_tolerance(watchdog, c), slack * c.volt_scale, slack * c.amp_scale);
}

TEST(Fuzz, DrawnDrivesKeepTheLaws) {
  const Seeds range = seeds(5000);
  for (std::uint64_t n = 0; n < range.count; ++n) run_one(range.first + n);
}

/// Open: what settle() judges by plain values in volts and by series in amperes differs by the ratio of the
/// winding's time constant to the segment's length; between the two it widens its noise, and these drives
/// then miss the laws' own noise of 128 eps. A floor of volt noise times h/L for the first order of a diode's
/// current would close the gap.
TEST(Fuzz, DISABLED_NoDriveNeedsWidenedNoise) {
  for (const std::uint64_t seed : {3794, 544635, 1088309, 3058719, 5097365}) run_one(seed, 0.0);
}

}  // namespace
