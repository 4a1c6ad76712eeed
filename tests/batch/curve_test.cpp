// SPDX-License-Identifier: Apache-2.0
// The curve does not depend on the number of threads.
#include "batch/curve.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "batch/for_each.hpp"
#include "tests/support/bench.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

analysis::CurveRequest request(double duty) {
  analysis::CurveRequest r{.sheet = curve_sheet(), .bench = maxon_bench(), .points = 8};
  r.bench.duty = duty;
  return r;
}

TEST(TorqueSpeedCurve, HasTheSameBitsOnAnyNumberOfThreads) {
  for (const double duty : {1.0, 0.7}) {
    const auto one = batch::torque_speed_curve(request(duty), batch::on_threads(1)),
               many = batch::torque_speed_curve(request(duty), batch::on_threads(5));
    ASSERT_TRUE(one);
    ASSERT_TRUE(many);
    ASSERT_EQ(one->points.size(), 8u);
    ASSERT_EQ(many->points.size(), 8u);
    for (std::size_t n = 0; n < 8; ++n) {
      const analysis::OperatingPoint &p = one->points[n], &q = many->points[n];
      using P = analysis::OperatingPoint;
      for (double P::*member :
           {&P::speed_rad_s, &P::torque_Nm, &P::shaft_torque_Nm, &P::ripple_Nm, &P::ripple_rms_Nm,
            &P::bus_current_A, &P::winding_current_A, &P::motor_current_A, &P::phase_rms_A, &P::phase_peak_A,
            &P::supplied_W, &P::copper_W, &P::energy_residual, &P::error_bound_A, &P::half_width_Nm})
        EXPECT_EQ(p.*member, q.*member) << n;
      EXPECT_EQ(p.sectors, q.sectors);
      EXPECT_EQ(one->limits[n].continuous_A, many->limits[n].continuous_A);
    }
    EXPECT_EQ(one->no_load.free_speed_rad_s, many->no_load.free_speed_rad_s);
    ASSERT_TRUE(one->marks.best_efficiency && many->marks.best_efficiency);
    EXPECT_EQ(one->marks.best_efficiency->speed_rad_s, many->marks.best_efficiency->speed_rad_s);
    EXPECT_EQ(one->marks.for_ever->speed_rad_s, many->marks.for_ever->speed_rad_s);
  }
}

TEST(TorqueSpeedCurve, EndsWhenAskedTo) {
  std::atomic<int> asked = 0;
  const auto curve =
      batch::torque_speed_curve(request(1.0), batch::on_threads(2), [&] { return ++asked < 4; });
  ASSERT_FALSE(curve);
  EXPECT_EQ(curve.problems()[0].limit, "was interrupted");
  EXPECT_LE(asked, 9);
}

TEST(TorqueSpeedCurve, HandsOnWhatIsWrong) {
  analysis::CurveRequest r = request(1.0);
  r.bench.voltage_V = -1;
  EXPECT_FALSE(batch::torque_speed_curve(r, batch::on_threads(1)));
}

}  // namespace SIXSTEP_TEST_FILE
