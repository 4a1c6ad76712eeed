// SPDX-License-Identifier: Apache-2.0
// The current PI with back-EMF feed-forward at its largest output. A duty of magnitude 1 has no off-time
// (model.md 3), but a duty that is one digit smaller has an off-time.
#include <gtest/gtest.h>

#include "sixstep/control/drive.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

TEST(SaturatedFeedForward, GivesTheWholeVoltageAndSoTheWholeDuty) {
  int short_of_it = 0;
  for (const double bus : {27.55, 25.2, 24.0, 22.2})
    for (int n = -600; n <= 600; ++n) {
      DriveConfig<double> config{.mode = Mode::current, .current = {4.5, -4.04, bus}, .nominal_bus_V = bus};
      config.extras.on = true;
      config.extras.feed_forward.K_t_V_s = 0.0335;
      DriveState<double> state{};
      Telemetry<double> telemetry{};
      const Measurement<double> measured{.speed_rad_s = n * 1.0, .bus_V = bus, .hall = 0b100};
      for (const double wanted : {40.0, -40.0}) {
        step(config, state, measured, {wanted}, telemetry);
        ASSERT_EQ(telemetry.duty, wanted > 0 ? 1.0 : -1.0) << bus << " " << n;
      }
      const double e = 0.0335 * n, high = bus - e;
      short_of_it += high + e < bus;
    }
  EXPECT_GT(short_of_it, 100) << "else this test shows nothing";
}

template <class Scalar>
class EveryScalar : public ::testing::Test {};
TYPED_TEST_SUITE(EveryScalar, Scalars);

TYPED_TEST(EveryScalar, ReachesItsLimitExactlyAndLeavesItAtOnce) {
  using S = TypeParam;
  DriveExtras<S> extras{};
  extras.feed_forward.K_t_V_s = static_cast<Gain<S>>(0.7);
  const PiConfig<S> config = pi<S>(0.5, 0.125, 0.9);
  for (int n = -100; n <= 100; ++n) {
    PiState<S> state{};
    const S w(static_cast<float>(0.0123 * n));
    const auto u = [&](double error) {
      return detail::voltage_with_feed_forward(extras, config, state, S(static_cast<float>(error)), w);
    };
    for (int k = 0; k < 30; ++k) u(0.75);
    ASSERT_EQ(u(0.75), config.limit) << n;
    ASSERT_LT(u(0.5), config.limit) << n;
    for (int k = 0; k < 60; ++k) u(-0.75);
    ASSERT_EQ(u(-0.75), -config.limit) << n;
  }
}

}  // namespace SIXSTEP_TEST_FILE
