// SPDX-License-Identifier: Apache-2.0
// The block selects among the states of three legs. The selection is compared with a numerical solution of
// the winding's equation, and with a sort of all states.
#include "sixstep/control/field/finite_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

#include "sixstep/control/field/field_drive.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

constexpr double pi = std::numbers::pi;

/// A drone motor with a salient rotor, at 20 kHz.
struct Machine {
  double R = 0.1, L_d = 60e-6, L_q = 90e-6, p = 7, psi = 2e-3, T = 50e-6;
};

template <class Scalar>
FiniteSetConfig<Scalar> config_of(const Machine& m) {
  const auto s = [](double x) { return static_cast<Scalar>(x); };
  const double a_d = std::exp(-m.R * m.T / m.L_d), a_q = std::exp(-m.R * m.T / m.L_q);
  FiniteSetConfig<Scalar> c;
  c.on = true;
  c.d_decay = s(a_d);
  c.q_decay = s(a_q);
  c.d_A_per_V = s((1 - a_d) / m.R);
  c.q_A_per_V = s((1 - a_q) / m.R);
  c.half_turn_s = s(m.p * m.T / 2);
  c.salient_V_s_A = s(m.p * (m.L_d - m.L_q));
  return c;
}

/// Currents in the magnet's frame with constant leg states, computed by Runge-Kutta in many small steps.
/// Unlike the block, the solver uses no half rotations and no exponentials.
Dq<double> solved(const Machine& m, Dq<double> i, unsigned legs, double bus_V, double magnet, double w) {
  const int steps = 50;
  const double h = m.T / steps, w_e = m.p * w;
  const auto side = [&](unsigned k) { return (legs >> k & 1u) != 0 ? bus_V : 0.0; };
  const double alpha = (2 * side(0) - side(1) - side(2)) / 3, beta = (side(1) - side(2)) / std::sqrt(3.0);
  const auto slope = [&](double t, const Dq<double>& x) {
    const double c = std::cos(magnet + w_e * t), s = std::sin(magnet + w_e * t);
    const double v_d = alpha * c + beta * s, v_q = beta * c - alpha * s;
    return Dq<double>{(v_d - m.R * x.d + w_e * m.L_q * x.q) / m.L_d,
                      (v_q - m.R * x.q - w_e * (m.L_d * x.d + m.psi)) / m.L_q};
  };
  const auto moved = [](const Dq<double>& x, const Dq<double>& k, double by) {
    return Dq<double>{x.d + by * k.d, x.q + by * k.q};
  };
  for (int n = 0; n < steps; ++n) {
    const double t = n * h;
    const Dq<double> k1 = slope(t, i), k2 = slope(t + h / 2, moved(i, k1, h / 2)),
                     k3 = slope(t + h / 2, moved(i, k2, h / 2)), k4 = slope(t + h, moved(i, k3, h));
    i.d += h / 6 * (k1.d + 2 * k2.d + 2 * k3.d + k4.d);
    i.q += h / 6 * (k1.q + 2 * k2.q + 2 * k3.q + k4.q);
  }
  return i;
}

struct Case {
  Dq<double> measured, reference;
  double magnet, w, bus_V;
  LegBits legs;
};

Case drawn(std::mt19937& random) {
  const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  return {
      {in(-20, 20), in(-20, 20)},        {in(-20, 20), in(-20, 20)}, in(0, 2 * pi), in(-700, 700), in(8, 30),
      static_cast<LegBits>(random() % 8)};
}

template <class Scalar>
FiniteSetInput<Scalar> input_of(const Machine& m, const Case& x) {
  const auto s = [](double v) { return static_cast<Scalar>(v); };
  const Dq<Scalar> e{Scalar{}, s(x.w * m.p * m.psi)};
  return {.reference = {s(x.reference.d), s(x.reference.q)},
          .measured = {s(x.measured.d), s(x.measured.q)},
          .magnet = {s(std::cos(x.magnet)), s(std::sin(x.magnet))},
          .speed_rad_s = s(x.w),
          .bus_V = s(x.bus_V),
          .e = e,
          .e_next = e};
}

/// The currents after each of the eight states, from the solver.
std::array<Dq<double>, 8> currents(const Machine& m, const Case& x, bool foretells) {
  Dq<double> i = x.measured;
  double magnet = x.magnet;
  if (foretells) {
    i = solved(m, i, x.legs, x.bus_V, magnet, x.w);
    magnet += m.p * x.w * m.T;
  }
  std::array<Dq<double>, 8> all;
  for (unsigned n = 0; n < 8; ++n) all[n] = solved(m, i, n, x.bus_V, magnet, x.w);
  return all;
}

double distance(const Dq<double>& a, const Dq<double>& b) { return std::hypot(a.d - b.d, a.q - b.q); }

/// Bound of the model's error. The model uses the angle in the middle of a period, in which the rotor turns
/// by x = w_e T. The error has two parts: x^2/24 of the voltage and of the back-EMF, and half of the
/// current's change in the saliency term. The current changes by at most D in a period.
double model_A(const Machine& m, const Case& x, bool foretells) {
  const double turn = std::fabs(m.p * x.w * m.T), b = m.T / m.L_d,
               D = b * (2 * x.bus_V / 3 + std::fabs(x.w) * m.p * m.psi);
  const double salient = std::fabs(m.p * x.w) * (m.L_q - m.L_d) * b * D / 2;
  return (foretells ? 2 : 1) * (turn * turn / 24 * D + salient) + 1e-4;
}

template <class Scalar>
class FiniteSet : public ::testing::Test {};
using Floats = ::testing::Types<double, float>;
TYPED_TEST_SUITE(FiniteSet, Floats);

TYPED_TEST(FiniteSet, ForetellsTheCurrentOfTheWindingsEquation) {
  std::mt19937 random(7);
  for (const bool foretells : {false, true})
    for (int n = 0; n < 500; ++n) {
      Machine m;
      if (n % 2 == 0) m.L_q = m.L_d;
      const Case x = drawn(random);
      auto c = config_of<TypeParam>(m);
      c.foretells = foretells;
      FiniteSetState<TypeParam> state{x.legs, {}};
      const LegBits legs = finite_set_step(c, state, input_of<TypeParam>(m, x));
      const Dq<double> there = currents(m, x, foretells)[legs];
      EXPECT_NEAR(static_cast<double>(state.foretold.d), there.d, model_A(m, x, foretells));
      EXPECT_NEAR(static_cast<double>(state.foretold.q), there.q, model_A(m, x, foretells));
    }
}

/// For no other state is the current closer to the reference, by more than the model's error, than for the
/// chosen state.
TYPED_TEST(FiniteSet, NoOtherStateComesNearer) {
  const Machine m;
  std::mt19937 random(8);
  int changed = 0;
  for (const bool foretells : {false, true})
    for (int n = 0; n < 1000; ++n) {
      const Case x = drawn(random);
      auto c = config_of<TypeParam>(m);
      c.foretells = foretells;
      FiniteSetState<TypeParam> state{x.legs, {}};
      const LegBits legs = finite_set_step(c, state, input_of<TypeParam>(m, x));
      const auto all = currents(m, x, foretells);
      for (const Dq<double>& i : all)
        EXPECT_LE(distance(all[legs], x.reference),
                  distance(i, x.reference) + 2 * std::numbers::sqrt2 * model_A(m, x, foretells));
      changed += legs != x.legs;
    }
  EXPECT_GT(changed, 500);
}

/// A sort of all states by their costs selects the same state. The costs use the block's own prediction for
/// each state.
TYPED_TEST(FiniteSet, IsTheFirstOfAllStatesSorted) {
  const Machine m;
  std::mt19937 random(9);
  int beyond = 0, kept = 0;
  for (int n = 0; n < 3000; ++n) {
    const Case x = drawn(random);
    auto c = config_of<TypeParam>(m);
    c.switching_A = static_cast<TypeParam>(n % 3);
    c.most_A = static_cast<TypeParam>(n % 2 == 0 ? 0 : 15);
    const auto in = input_of<TypeParam>(m, x);
    const double half = m.p * x.w * m.T / 2;
    const Direction<TypeParam> by{static_cast<TypeParam>(std::cos(half)),
                                  static_cast<TypeParam>(std::sin(half))};
    const Direction<TypeParam> middle{static_cast<TypeParam>(std::cos(x.magnet + half)),
                                      static_cast<TypeParam>(std::sin(x.magnet + half))};
    std::vector<std::tuple<double, double, int, LegBits>> all;
    for (LegBits k = 0; k < 8; ++k) {
      const Dq<TypeParam> i =
          foretold(c, in.measured, legs_voltage(k, in.bus_V), middle, by, in.speed_rad_s, in.e_next);
      const double d = static_cast<double>(i.d), q = static_cast<double>(i.q);
      const double over = n % 2 == 0 ? 0.0 : std::max(0.0, d * d + q * q - 225);
      const int legs = std::popcount(static_cast<unsigned>(k ^ x.legs));
      const double s = n % 3;
      const double off =
          distance({d, q}, {static_cast<double>(in.reference.d), static_cast<double>(in.reference.q)});
      all.emplace_back(over, off * off + s * s * legs, legs, k);
    }
    std::sort(all.begin(), all.end());
    FiniteSetState<TypeParam> state{x.legs, {}};
    const LegBits legs = finite_set_step(c, state, in);
    // If two states are equal, rounding may exchange them. The selected state must therefore have the same
    // cost as the first state.
    const auto own =
        *std::find_if(all.begin(), all.end(), [&](const auto& a) { return std::get<3>(a) == legs; });
    const double rounding = 4000 * 64 * std::numeric_limits<TypeParam>::epsilon() + 4000 * 4e-7;
    EXPECT_NEAR(std::get<0>(own), std::get<0>(all[0]), rounding);
    if (std::get<0>(all[0]) == 0.0) {
      EXPECT_NEAR(std::get<1>(own), std::get<1>(all[0]), rounding);
    }
    beyond += std::get<0>(own) > 0;
    kept += std::get<2>(own) == 0;
  }
  EXPECT_GT(beyond, 50);
  EXPECT_GT(kept, 300);
}

/// If the reference is within the bus's hexagon, the current's distance to the reference is at most the
/// radius of the triangles.
TYPED_TEST(FiniteSet, ComesWithinTheRadiusOfTheTriangles) {
  Machine m;
  m.L_q = m.L_d;
  const auto c = config_of<TypeParam>(m);
  const double U = 24, b = static_cast<double>(c.d_A_per_V), radius = 2 / (3 * std::sqrt(3.0)) * b * U;
  std::mt19937 random(10);
  double farthest = 0.0;
  for (int n = 0; n < 4000; ++n) {
    Case x = drawn(random);
    x.bus_V = U;
    x.w = 0;
    const double length = std::uniform_real_distribution(0.0, U / std::sqrt(3.0))(random), angle = n;
    const double a = std::exp(-m.R * m.T / m.L_d);
    x.reference = {a * x.measured.d + b * length * std::cos(angle),
                   a * x.measured.q + b * length * std::sin(angle)};
    FiniteSetState<TypeParam> state{x.legs, {}};
    finite_set_step(c, state, input_of<TypeParam>(m, x));
    const double off = std::hypot(static_cast<double>(state.foretold.d) - x.reference.d,
                                  static_cast<double>(state.foretold.q) - x.reference.q);
    EXPECT_LE(off, radius * (1 + 1e-5));
    farthest = std::max(farthest, off);
  }
  EXPECT_GT(farthest, 0.97 * radius) << "and comes as far";
}

TYPED_TEST(FiniteSet, TheNearerZeroVectorIsTakenAndAWeightKeepsTheLegs) {
  const Machine m;
  auto c = config_of<TypeParam>(m);
  Case x{};
  x.bus_V = 24;
  x.reference = x.measured = {};
  for (LegBits from = 0; from < 8; ++from) {
    FiniteSetState<TypeParam> state{from, {}};
    const LegBits to = finite_set_step(c, state, input_of<TypeParam>(m, x));
    EXPECT_EQ(to, std::popcount(static_cast<unsigned>(from)) >= 2 ? 7 : 0);
    EXPECT_EQ(legs_changed(from, to), std::min(std::popcount(static_cast<unsigned>(from)),
                                               3 - std::popcount(static_cast<unsigned>(from))));
    c.switching_A = TypeParam(100);
    state.legs = from;
    EXPECT_EQ(finite_set_step(c, state, input_of<TypeParam>(m, x)), from);
    c.switching_A = {};
  }
}

TYPED_TEST(FiniteSet, TheDriveAnswersLegsThatStandForAPeriod) {
  FieldDriveConfig<TypeParam> c;
  c.drive.mode = Mode::current;
  c.finite_set = config_of<TypeParam>(Machine{});
  FieldDriveState<TypeParam> state;
  Telemetry<TypeParam> telemetry;
  FieldDriveInput<TypeParam> in;
  in.measured.bus_V = TypeParam(24);
  in.magnet = field_directions(c.advance, 0x12345678u, TypeParam{});
  const auto& legs = field_drive_step(c, state, in, Setpoint<TypeParam>{TypeParam(10)}, telemetry);
  EXPECT_TRUE(legs.enabled);
  for (unsigned k = 0; k < 3; ++k)
    EXPECT_EQ(legs.leg[k].state, (state.finite_set.legs >> k & 1u) != 0 ? LegState::high : LegState::low);
  EXPECT_NE(state.finite_set.legs, 0);
  EXPECT_GT(state.current.voltage.q, TypeParam(8)) << "across the magnet, of 16 V";
  FieldDriveConfig<TypeParam> off = c;
  off.drive.mode = Mode::off;
  retune(c, state, off);
  EXPECT_FALSE(field_drive_step(c, state, in, Setpoint<TypeParam>{}, telemetry).enabled);
}

/// The types double and float select the same state, unless two states are equal.
TEST(FiniteSets, DoubleAndFloatAgree) {
  const Machine m;
  std::mt19937 random(11);
  int other = 0;
  for (int n = 0; n < 3000; ++n) {
    const Case x = drawn(random);
    FiniteSetState<double> wide{x.legs, {}};
    FiniteSetState<float> narrow{x.legs, {}};
    const LegBits a = finite_set_step(config_of<double>(m), wide, input_of<double>(m, x));
    const LegBits b = finite_set_step(config_of<float>(m), narrow, input_of<float>(m, x));
    if (a == b) {
      EXPECT_NEAR(wide.foretold.d, static_cast<double>(narrow.foretold.d), 1e-4);
      EXPECT_NEAR(wide.foretold.q, static_cast<double>(narrow.foretold.q), 1e-4);
    } else {
      ++other;
    }
  }
  EXPECT_LE(other, 1);
}

}  // namespace SIXSTEP_TEST_FILE
