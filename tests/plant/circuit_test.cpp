// SPDX-License-Identifier: Apache-2.0
#include "sixstep/plant/circuit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::plant;
using enum Connection;

constexpr Devices real{.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.02};

TEST(Circuit, ConnectionsAreThoseOfTheGatesAndTheCurrentsSign) {
  static_assert(connection_of(true, false, -1) == high_switch);
  static_assert(connection_of(false, true, 1) == low_switch);
  static_assert(connection_of(false, false, 1) == low_diode);
  static_assert(connection_of(false, false, -1) == high_diode);
  static_assert(connection_of(false, false, 0) == floating);
}

TEST(Circuit, PoleVoltagesFollowTheDevices) {
  const auto u = [](Connection c, double i) { return pole_voltage(pole_terms<double>(c, real), 24.0, i); };
  EXPECT_DOUBLE_EQ(u(high_switch, 5.0), 24.0 - 0.05);
  EXPECT_DOUBLE_EQ(u(low_switch, -5.0), 0.05);
  EXPECT_DOUBLE_EQ(u(low_diode, 5.0), -0.7 - 0.1);
  EXPECT_DOUBLE_EQ(u(high_diode, -5.0), 24.7 + 0.1);
}

TEST(Circuit, CurrentsOfTheConnectedLegsKeepTheirSum) {
  // With equation 5, the sum of L di/dt = u_k - u_n - R i_k - e_k over the connected legs is zero.
  const PerLeg<double> i{3.0, -5.0, 2.0}, e{6.0, -4.0, 1.5};
  for (const Legs& legs :
       {Legs{high_switch, low_switch, low_diode}, Legs{high_diode, low_diode, high_switch}}) {
    const PerLeg<double> u = pole_voltages(legs, pole_table<double>(real), 24.0, i, e);
    const double u_n = star_voltage(legs, pole_table<double>(real), 24.0, i, e);
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += u[k] - u_n - 0.515 * i[k] - e[k];
    EXPECT_NEAR(sum, 0.0, 1e-14);
  }
}

TEST(Circuit, FloatingTerminalShowsTheStarPointAndItsEmf) {
  const PerLeg<double> e{5.0, -5.0, 2.0};
  const PerLeg<double> u =
      pole_voltages({high_switch, low_switch, floating}, pole_table<double>({}), 24.0, {1.0, -1.0, 0.0}, e);
  EXPECT_EQ(u[2], 12.0 + 2.0);
}

TEST(Circuit, FreeStarPointLiesSymmetrically) {
  // Without a connected leg, a current starts when max e - min e exceeds U_s + 2 V_f (back-EMFs e, bus
  // voltage U_s, diode drop V_f). At this instant, one terminal reaches the upper rail and another terminal
  // reaches the lower rail.
  const PerLeg<double> e{20.0, -12.0, 3.0};
  const PerLeg<double> u =
      pole_voltages({floating, floating, floating}, pole_table<double>(real), 24.0, {}, e);
  EXPECT_DOUBLE_EQ(u[0] - 24.0, -u[1]);
}

TEST(Circuit, BusCarriesTheLegsThatHangOnIt) {
  static_assert(bus_current<double>({high_switch, low_switch, high_diode}, {3.0, -2.0, -1.0}) == 2.0);
  static_assert(connected_count({high_switch, floating, low_diode}) == 2);
}

}  // namespace SIXSTEP_TEST_FILE
