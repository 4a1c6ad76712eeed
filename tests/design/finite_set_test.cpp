// SPDX-License-Identifier: Apache-2.0
// The model that selects the states of the legs is compared with closed forms.
#include "sixstep/design/loops/finite_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::design;

TEST(FiniteSetDesign, IsTheWindingsZeroOrderHold) {
  const FieldMachine m{.R_ohm = 0.5, .L_d_H = 2e-4, .L_q_H = 3e-4, .magnet_V_s = 0.02, .pole_pairs = 7};
  const FiniteSet f = finite_set(m, 40e-6, 24);
  EXPECT_NEAR(f.config.d_decay, std::exp(-0.1), 1e-15);
  EXPECT_NEAR(f.config.q_A_per_V, (1 - std::exp(-0.5 * 40e-6 / 3e-4)) / 0.5, 1e-15);
  EXPECT_NEAR(f.config.half_turn_s, 7 * 20e-6, 1e-18);
  EXPECT_NEAR(f.config.salient_V_s_A, -7e-4, 1e-18);
  EXPECT_NEAR(f.band_A, 2 / (3 * std::numbers::sqrt3) * f.config.d_A_per_V * 24, 1e-14);
}

}  // namespace SIXSTEP_TEST_FILE
