// SPDX-License-Identifier: Apache-2.0
// The torque during a commutation is compared with Carlson's closed form (1992). The form assumes flat tops,
// ideal devices, and soft chopping that remains off until the new phase carries the current. model.md 5
// derives the closed form, which uses no code of the kernels.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/general.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

/// Flat tops of 150 degrees: for 15 degrees on either side of the edge at 120 degrees, all three back-EMFs
/// are constant.
constexpr double K_e = 0x1p-6, speed = 256.0, E = K_e * speed, L = 0.286e-3, charging_V = 40.0;

plant::Gates pair(int high, int low) {
  plant::Gates g;
  g.high[static_cast<std::size_t>(high)] = g.low[static_cast<std::size_t>(low)] = true;
  return g;
}

template <class Bench>
Bench bench(double R_ohm);
template <>
Held<> bench<Held<>>(double R_ohm) {
  Drivetrain s;
  s.machine = {.R_ohm = R_ohm, .L_H = L, .K_e_V_s = K_e, .pole_pairs = 8, .flat_deg = 150};
  s.shaft = {.J_kg_m2 = 1e12};  // the speed is constant
  s.supply = {.V_0_V = charging_V};
  s.start = {.speed_rad_s = speed, .angle_rad = at_electrical_deg(116), .bus_V = charging_V};
  return {s, pair(0, 2)};
}
template <>
HeldGeneral bench<HeldGeneral>(double R_ohm) {
  GeneralSetup s;
  s.machine = {.R_ohm = {R_ohm, R_ohm, R_ohm}, .K_e_V_s = {K_e, K_e, K_e}, .L_H = L, .pole_pairs = 8};
  s.machine.shape.flat_deg = 150;
  s.shaft = {.J_kg_m2 = 1e12};
  s.supply = {.V_0_V = charging_V};
  s.start = {.speed_rad_s = speed, .angle_rad = at_electrical_deg(116), .bus_V = charging_V};
  return HeldGeneral(s, pair(0, 2));
}

/// Phase a carries the current I to phase c. Then phase b replaces phase a. The bus voltage is `ratio` times
/// E, the back-EMF of a phase.
template <class Bench>
struct Commutation {
  Bench held;
  double R, U, I = 0, torque = 0;
  sim::Instant begin{};

  Commutation(double ratio, double R_ohm) : held(bench<Bench>(R_ohm)), R(R_ohm), U(ratio * E) {
    run_until(sim::to_instant(18e-6));
    I = held.plant().state().i[0];
    torque = torque_now();
    begin = held.now();
    held.plant().set_source_voltage(U);
    held.plant().set_gates(pair(1, 2));
  }
  void run_until(const sim::Instant& end) {
    sim::NoObserver none;
    ASSERT_EQ(sim::run(held, end, none).stop, sim::Stop::end);
  }
  double torque_now() const {
    auto plant = held.plant();
    EXPECT_GE(plant.expand(1e-9), 0);
    return plant.at(0).torque;
  }
  double current(int k) const { return held.plant().state().i[static_cast<std::size_t>(k)]; }
  /// The time at which the current of a reaches zero: i_a = I + (I + A) expm1(-t R/L), with A = (U + 2 E)/(3
  /// R).
  double gone_s() const { return L / R * std::log1p(3 * R * I / (U + 2 * E)); }
  /// The time at which b carries the current I: i_b = -D expm1(-t R/L), with D = 2 (U - E)/(3 R).
  double risen_s() const { return -L / R * std::log1p(-1.5 * R * I / (U - E)); }
};

/// The relative change of the torque during the first part of the commutation, until b carries I or the
/// current of a is zero. This change depends only on the bus voltage.
double exact_change(double U, double I, double R) {
  const double left = U - 4 * E - 3 * R * I;
  return left >= 0 ? left / (2 * (U - E)) : left / (U + 2 * E + 3 * R * I);
}
double carlsons_change(double ratio) {
  return ratio >= 4 ? (ratio - 4) / (2 * (ratio - 1)) : (ratio - 4) / (ratio + 2);
}
/// Bound of the relative error that is caused by currents which the kernels treat as zero.
double noise(double R, double U, double I) { return 1e-11 + 64 * eps * std::fmax(U, charging_V) / R / I; }

template <class Bench>
class CarlsonsRipple : public ::testing::Test {};
using Kernels = ::testing::Types<Held<>, HeldGeneral>;
TYPED_TEST_SUITE(CarlsonsRipple, Kernels);

TYPED_TEST(CarlsonsRipple, IsThatOfTheBusOverTheBackEmf) {
  for (const double ratio : {2.0, 2.2, 3.0, 3.7, 4.0, 4.5, 6.0, 12.0, 100.0, 1e4})
    for (const double R : {0.515, 1e-2, 1e-4}) {
      SCOPED_TRACE(::testing::Message() << "U = " << ratio << " E, R = " << R);
      Commutation<TypeParam> c(ratio, R);
      ASSERT_NEAR(c.torque * speed, 2 * E * c.I, 1e-11);
      const double rises = c.risen_s(), goes = c.gone_s(), until = std::fmin(rises, goes);
      EXPECT_EQ(goes > rises, c.U > 4 * E + 3 * R * c.I);
      c.run_until(c.begin.plus_seconds(until));
      const double change = c.torque_now() / c.torque - 1;
      EXPECT_NEAR(change, exact_change(c.U, c.I, R), noise(R, c.U, c.I));
      EXPECT_NEAR(change, carlsons_change(ratio), 2 * R * c.I / E) << "what R leaves of it";
      EXPECT_NEAR(c.current(rises < goes ? 1 : 0), rises < goes ? c.I : 0.0, noise(R, c.U, c.I));
      EXPECT_NEAR(c.torque_now() * speed, -2 * E * c.current(2), 1e-11) << "the phase that stays makes it";
    }
}

TYPED_TEST(CarlsonsRipple, EndsAtHalfMoreNothingAndHalfLess) {
  const auto change = [](double ratio) {
    Commutation<TypeParam> c(ratio, 1e-5);
    c.run_until(c.begin.plus_seconds(std::fmin(c.risen_s(), c.gone_s())));
    return c.torque_now() / c.torque - 1;
  };
  EXPECT_NEAR(change(1e5), 0.5, 2e-5);
  EXPECT_NEAR(change(4), 0.0, 1e-5);
  EXPECT_NEAR(change(2), -0.5, 1e-5);
}

TYPED_TEST(CarlsonsRipple, AtTwiceTheBackEmfTheNewCurrentNeverRisesAgain) {
  const double R = 1e-2;
  Commutation<TypeParam> c(2.0, R);
  c.run_until(c.begin.plus_seconds(c.gone_s()));
  const double reached = c.current(1);
  EXPECT_NEAR(reached, c.I / 2, R * c.I);
  for (const double later : {5e-6, 20e-6, 40e-6}) {  // within the flat tops
    c.run_until(c.begin.plus_seconds(c.gone_s() + later));
    EXPECT_NEAR(c.current(1), reached * std::exp(-later * R / L), noise(R, c.U, c.I));
    EXPECT_EQ(c.current(0), 0.0);
  }
}

/// When the new phase carries I, chopping starts to keep its current constant. From this instant on, the
/// torque falls with the current of the old phase.
TYPED_TEST(CarlsonsRipple, IsAtItsPeakWhenChoppingBegins) {
  Commutation<TypeParam> c(8.0, 1e-4);
  c.run_until(c.begin.plus_seconds(c.risen_s()));
  const double peak = c.torque_now();
  plant::Gates off = pair(1, 2);
  off.high.reset();
  for (int half = 1; half <= 40; ++half) {
    c.held.plant().set_gates(half % 2 != 0 ? off : pair(1, 2));
    c.run_until(c.held.now().plus_seconds(0.1e-6));
    EXPECT_LT(c.torque_now(), peak);
  }
}

}  // namespace SIXSTEP_TEST_FILE
