// SPDX-License-Identifier: Apache-2.0
// How long a series is: until its terms are nothing, not until one of them happens to be. And that it is the
// same whatever instructions it is compiled to.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "tests/support/laws.hpp"
#include "tests/support/maxon.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;

/// Hardly any resistance, and a torque that begins with zero at the edge where b's bottom begins and a's
/// ends: a load pulls, x ~ t^2, i ~ t, and torque and EMF bring i and w the orders 1, 4, 7, 10 alone. A
/// series that stops at the first zero after the seventh leaves out what the energy balance misses.
TEST(Series, ASymmetrysZeroIsNotTheirEnd) {
  Drivetrain setup;
  setup.machine = {.R_ohm = 1e-9, .L_H = 1e-3, .K_e_V_s = 0.01, .pole_pairs = 1};
  setup.shaft = {.J_kg_m2 = 1e-7};
  setup.start.angle_rad = 5 * base::sector_rad;
  Held<> bench(setup, a_to_b());
  bench.plant().set_load(-0.02);
  LawChecker<> laws;
  ASSERT_EQ(bench.run_to(1e-3, laws), sim::Stop::end);
  EXPECT_GT(bench.state().w, 0.0);
  laws.expect_all();
}

/// Locked rotor: i ~ 1 - exp(-t/tau), asked for over more than one series can hold.
TEST(Series, OneThatIsTooLongIsHalvedUntilItsLastTwoTermsAreNothing) {
  Drivetrain setup;
  setup.shaft.locked = true;
  setup.start.angle_rad = 0.02;
  const plant::Plant<double> rotor = setup.plant();
  const plant::Constants<double>& c = rotor.constants();
  const plant::Mode mode{
      .legs = {plant::Connection::high_switch, plant::Connection::low_switch, plant::Connection::floating},
      .motion = plant::Motion::locked};
  int halved = 0;
  for (double taus = 0.5; taus < 8.0; taus += 1.0 / 512) {
    plant::Expansion<double> y{};
    plant::expand(c, rotor.state(), mode, taus * setup.tau(), y);
    // Nothing: what follows is, both legs together, below one part in 2^53 of the natural scale; of this
    // exponential each term is h/(n tau) of the one before.
    const auto size = [&](int n) { return 2 * std::fabs(y.i[0][n]) * c.amp_limit; };
    EXPECT_LE(size(y.degree) * y.h / setup.tau() / (y.degree + 1), 1.0) << taus;
    if (y.h == taus * setup.tau()) continue;
    ++halved;
    EXPECT_LE(size(y.degree - 1), 1.0) << taus;
    const double exact = -24.0 / setup.R_tt() * std::expm1(-y.h / setup.tau());
    EXPECT_NEAR(series::evaluate(y.i[0], y.degree, 1.0), exact, 8 * eps * exact) << taus;
  }
  EXPECT_GT(halved, 0);
}

#ifdef __x86_64__

template <bool sine>
void expect_same_bits(const plant::Constants<double>& c, const plant::Mode& mode,
                      const plant::Expansion<double>& start, int n) {
  using plant::detail::Build;
  plant::Expansion<double> any = start, avx = start;
  plant::detail::expand_shape<sine, Build::any>(c, mode, any);
  plant::detail::expand_shape<sine, Build::avx>(c, mode, avx);
  ASSERT_EQ(any.degree, avx.degree) << "state " << n;
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  for (int j = 0; j <= any.degree; ++j)
    ASSERT_TRUE(same(any.i[0][j], avx.i[0][j]) && same(any.i[1][j], avx.i[1][j]) &&
                same(any.i[2][j], avx.i[2][j]) && same(any.w[j], avx.w[j]) && same(any.x[j], avx.x[j]) &&
                same(any.bus[j], avx.bus[j]) && same(any.torque[j], avx.torque[j]))
        << "state " << n << " order " << j;
  ASSERT_TRUE(same(any.h, avx.h) && same(any.end.i, avx.end.i) && same(any.end.i_2, avx.end.i_2) &&
              same(any.end.w, avx.end.w) && same(any.end.x, avx.end.x) && same(any.reach_w, avx.reach_w) &&
              same(any.later_x, avx.later_x))
      << "state " << n;
}

/// All connections, both shapes, a stiff bus and one that moves.
TEST(Series, BothBuildsGiveTheSameBits) {
  if (!__builtin_cpu_supports("avx")) GTEST_SKIP() << "this processor runs one of them only";
  std::mt19937_64 random{20261122};
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 4000; ++n) {
    Drivetrain setup;
    const bool sine = n % 2 == 1;
    setup.machine.back_emf = sine ? plant::BackEmf::sine : plant::BackEmf::trapezoid;
    if (n % 3 == 0) setup.supply = {.V_0_V = 24, .R_b_ohm = 0.1, .C_F = 1e-3};
    setup.devices = {.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.02};
    const plant::Plant<double> rotor = setup.plant();
    plant::Mode mode{.motion = plant::Motion::forward};
    for (plant::Connection& leg : mode.legs) leg = static_cast<plant::Connection>(random() % 5);
    mode.sector = static_cast<std::uint8_t>(random() % 6);
    plant::Expansion<double> y{};
    y.h = 2e-5 * (1 + any(random));
    const double x = base::sector_rad * (1 + any(random)) / 2;
    y.i[0][0] = 20 * any(random);
    y.i[1][0] = plant::is_floating(mode.legs[2]) ? -y.i[0][0] : 20 * any(random);
    y.i[2][0] = -(y.i[0][0] + y.i[1][0]);
    y.w[0] = 700 * any(random);
    y.x[0] = x;
    y.bus[0] = 24;
    y.phi0[0] = std::cos(x);
    y.phi1[0] = std::sin(x);
    if (sine)
      expect_same_bits<true>(rotor.constants(), mode, y, n);
    else
      expect_same_bits<false>(rotor.constants(), mode, y, n);
    if (HasFatalFailure()) return;
  }
}

#endif

}  // namespace
