// SPDX-License-Identifier: Apache-2.0
// A power series ends when its terms are negligible, not at a single zero term. Its bits are the same with
// every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "tests/support/laws.hpp"
#include "tests/support/maxon.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

/// The resistance is almost zero. At the first edge, the flat bottom of b begins and the flat bottom of a
/// ends, and the pair has no torque. The load accelerates the rotor: x ~ t^2 and i ~ t, so i and w have only
/// terms of the orders 1, 4, 7, 10. If the series ended at the zero terms between them, the error of the
/// speed would be 3e-7. In slices of 1 us, only the first slice has such zeros, because all others begin with
/// a current.
TEST(Series, ASymmetrysZeroIsNotTheirEnd) {
  Drivetrain setup;
  setup.machine = {.R_ohm = 1e-9, .L_H = 1e-3, .K_e_V_s = 0.01, .pole_pairs = 1};
  setup.shaft = {.J_kg_m2 = 1e-7};
  setup.start.angle_rad = 5 * base::sector_rad;
  Held<> bench(setup, a_to_b()), sliced = bench;
  LawChecker<> laws;
  for (Held<>* one : {&bench, &sliced}) one->plant().set_load(-0.02);
  ASSERT_EQ(bench.run_to(1e-3, laws), sim::Stop::end);
  for (int slice = 1; slice <= 1000; ++slice) ASSERT_EQ(sliced.run_to(slice * 1e-6), sim::Stop::end);
  EXPECT_NEAR(bench.state().w, sliced.state().w, 1000 * eps * sliced.state().w);
  EXPECT_NEAR(bench.state().i[0], sliced.state().i[0], 1000 * eps * sliced.state().i[0]);
  EXPECT_GT(bench.state().w, 0.0);
  laws.expect_all();
}

/// The rotor is locked, so i ~ 1 - exp(-t/tau). One series cannot cover the whole time.
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
    // The next term, for both legs together, is below 2^-53 of the natural scale. Each term of this
    // exponential is the previous term times h/(n tau) (length h, order n).
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

/// A shaft with every kind of torque, so that an omitted term in either method is detected.
plant::Plant<double> braked(std::mt19937_64& random, bool stiff) {
  std::uniform_real_distribution<double> part(0.1, 1);
  Drivetrain setup;
  setup.machine = {.R_ohm = part(random), .L_H = 1e-3 * part(random), .K_e_V_s = 0.03 * part(random)};
  setup.shaft = {.J_kg_m2 = 1e-5 * part(random), .B_Nm_s = 1e-3 * part(random), .coulomb_Nm = part(random)};
  setup.devices = {.R_on_ohm = 0.1 * part(random), .V_f_V = part(random), .r_d_ohm = 0.1 * part(random)};
  if (!stiff) setup.supply = {.V_0_V = 24, .R_b_ohm = 0.1, .C_F = 1e-3};
  plant::Plant<double> out = setup.plant();
  out.set_load(part(random) - 0.5);
  return out;
}

/// A bound of the rounding error of an order. It is computed by the same recurrence with all terms positive.
struct Majorant {
  series::Coefficients<double> i{}, w{}, bus{};
  Majorant(const plant::Constants<double>& c, const plant::LegsLaw<double>& law, double emf, bool turns,
           const plant::Expansion<double>& y) {
    const auto size = [](double v) { return std::fabs(v); };
    const double inv_J = turns ? c.inv_J : 0;
    i[0] = size(y.i[law.leg[0]][0]);
    w[0] = size(y.w[0]);
    bus[0] = y.bus[0];
    for (int n = 0; n < series::max_degree; ++n) {
      const double f = y.h / (n + 1), first = n == 0 ? 1 : 0;
      i[n + 1] = f * (size(law.slope.i) * i[n] + law.emf_rate * emf * w[n] + size(law.slope.bus) * bus[n] +
                      first * size(law.slope.offset));
      bus[n + 1] = f * c.inv_C * (c.inv_R_b * (first * c.V_0 + bus[n]) + 2 * i[n]);
      w[n + 1] = f * inv_J * (emf * i[n] + c.B * w[n] + first * (size(c.load) + c.coulomb));
    }
  }
};

/// FlatPair multiplies out the equations of winding and shaft, two orders at a time. The plain recurrence
/// does not. In both methods, an order has less than a dozen roundings.
TEST(Series, APairOnItsFlatTopsIsThePlainRecurrence) {
  std::mt19937_64 random{20261122};
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 2000; ++n) {
    const plant::Plant<double> rotor = braked(random, n % 2 == 0);
    const plant::Constants<double>& c = rotor.constants();
    plant::Mode mode{.motion = static_cast<plant::Motion>(random() % 5)};
    // In sector 0, the back-EMFs of a and b are at their flat tops, and the back-EMF of c is on a ramp.
    for (unsigned k = 0; k < 2; ++k) mode.legs[k] = static_cast<plant::Connection>(1 + random() % 4);
    const plant::EmfPiece<double>& piece = c.emf[0].piece[0];
    ASSERT_EQ(piece.beta[0], piece.beta[1]);
    const plant::LegsLaw<double>& law = c.legs[plant::legs_index(mode.legs)];
    plant::Expansion<double> flat{};
    flat.h = 2e-5 * (1.5 + any(random));
    flat.i[0][0] = 20 * any(random);
    flat.i[1][0] = -flat.i[0][0];
    flat.w[0] = plant::turns(mode.motion) ? 700 * any(random) : 0.0;
    flat.x[0] = base::sector_rad * (1 + any(random)) / 2;
    flat.bus[0] = 24 + any(random);
    plant::Expansion<double> plain = flat;
    const plant::detail::ShapeLine<false, double> shape(piece, flat.x[0]);
    using plant::detail::Build;
    plant::detail::recurrence<Build::any, plant::detail::FlatPair<double>>(c, mode, law, shape, flat);
    plant::detail::recurrence<Build::any, plant::detail::OneCurrent<false, double>>(c, mode, law, shape,
                                                                                    plain);
    ASSERT_EQ(flat.h, plain.h);
    const Majorant size(c, law, piece.alpha[0] - piece.alpha[1], plant::turns(mode.motion), plain);
    for (int j = 0; j <= std::min(flat.degree, plain.degree); ++j) {
      ASSERT_NEAR(flat.i[0][j], plain.i[0][j], 12 * (j + 1) * eps * size.i[j])
          << "state " << n << " order " << j;
      ASSERT_NEAR(flat.w[j], plain.w[j], 12 * (j + 1) * eps * size.w[j]) << "state " << n << " order " << j;
    }
  }
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

/// The cases are all connections, both shapes, and a stiff and a varying bus.
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

}  // namespace SIXSTEP_TEST_FILE
