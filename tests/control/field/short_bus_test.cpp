// SPDX-License-Identifier: Apache-2.0
// A field-oriented drive is turned faster than the bus voltage allows. Its winding (R, L and a magnet) is
// solved in the rotor's frame. The voltage of the three duties is constant over each period in the stator's
// frame.
//
// The law for any request: the current stays below the sum of three terms:
// - the reference: i_q and, with field weakening, at most weakening_A;
// - the least current within the voltage circle, (|E| - V)/|Z| (back-EMF E, voltage limit V, impedance Z);
// - a margin: the change by the whole voltage until the next command acts, (n + 1) T V/L (delay of n periods
//   T).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>

#include "sixstep/control/field/field_drive.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;
using Complex = std::complex<double>;

struct Case {
  double R = 1, L = 1e-3, psi = 1e-2, pole_pairs = 1, bus_V = 24, period_s = 50e-6;
  int delay = 0;  ///< periods from a sample to its answer
  double bandwidth_rad_s = 1000, i_q = 0, weakening_A = 0;
  double from_rad_s = 0, to_rad_s = 0, ramp_s = 0.1, held_s = 0.1;
  bool decouples = true, axes = false;

  double circle_V() const { return axes ? bus_V / 2 : bus_V / std::numbers::sqrt3; }
  double least_A(double w) const {
    const double E = std::fabs(w) * pole_pairs * psi;
    return std::max(0.0, (E - circle_V()) / std::hypot(R, w * pole_pairs * L));
  }
  double asked_A() const { return std::hypot(i_q, weakening_A); }
  double margin_A() const { return (delay + 1) * period_s * circle_V() / L; }
};

/// The gains follow the design in design/loops/field_current.hpp.
FieldDriveConfig<double> config_of(const Case& x) {
  FieldDriveConfig<double> c;
  const double z = std::exp(-x.bandwidth_rad_s * x.period_s), a0 = -std::exp(-x.R * x.period_s / x.L),
               b0 = (1 + a0) / x.R, d1 = (x.delay > 0 ? z * (1 - z) : 1 - z) / b0;
  c.drive.mode = Mode::current;
  c.current.d = c.current.q = {d1, a0 * d1, x.bus_V / 2};
  c.current.limit = x.axes ? VoltageLimit::axes : VoltageLimit::circle;
  c.current.decouples = x.decouples;
  c.current.d_V_s_A = c.current.q_V_s_A = x.pole_pairs * x.L;
  c.current.magnet_V_s = x.pole_pairs * x.psi;
  c.current.R_ohm = x.R;
  const double w_0 = x.bus_V / std::numbers::sqrt3 / (x.pole_pairs * x.psi);
  if (x.weakening_A > 0)
    c.weakening = {(1 - std::exp(-x.bandwidth_rad_s * x.period_s / 10)) / (w_0 * x.pole_pairs * x.L), 0.95,
                   x.weakening_A};
  c.advance.rad_s = (x.delay + 0.5) * x.period_s * x.pole_pairs;
  return c;
}

struct Seen {
  double peak_A = 0, end_A = 0;  ///< peak_A: over the whole run; end_A: over the last half of the constant
                                 ///< speed
};

class Winding {
 public:
  explicit Winding(const Case& x) : x_(x) {}
  Complex current() const { return i_ * std::polar(1.0, angle_); }
  double length() const { return std::abs(i_); }
  double angle() const { return angle_; }
  /// Integrates di/dt = (v e^(-j theta) - R i - j w (L i + psi))/L over an interval that is shorter than both
  /// time constants. The only approximation is the angle of v, which is taken in the middle of the interval.
  void go(const Complex& stator_V, double w, double dt) {
    const double w_e = w * x_.pole_pairs;
    const Complex rate(x_.R / x_.L, w_e), v = stator_V * std::polar(1.0, -(angle_ + w_e * dt / 2));
    const Complex rest = (v - Complex(0, w_e * x_.psi)) / (rate * x_.L);
    i_ = rest + (i_ - rest) * std::exp(-rate * dt);
    angle_ = std::remainder(angle_ + w_e * dt, 2 * std::numbers::pi);
  }

 private:
  Case x_;
  Complex i_{};
  double angle_ = 0;
};

Complex vector_of(const LegCommands<double>& legs, double bus_V) {
  const AlphaBeta<double> v =
      clarke(Abc<double>{legs.leg[0].duty * bus_V, legs.leg[1].duty * bus_V, legs.leg[2].duty * bus_V});
  return {v.alpha, v.beta};
}

FieldDriveInput<double> input_of(const Case& x, const Winding& winding, double w, double advance) {
  const Complex i = winding.current();
  const Abc<double> abc = inverse_clarke(AlphaBeta<double>{i.real(), i.imag()});
  const double at = winding.angle(), answered = at + advance * w;
  FieldDriveInput<double> in;
  in.measured.i_a_A = abc.a;
  in.measured.i_b_A = abc.b;
  in.measured.i_c_A = abc.c;
  in.measured.bus_V = x.bus_V;
  in.measured.speed_rad_s = w;
  in.magnet = {{std::cos(at), std::sin(at)},
               {std::cos(answered), std::sin(answered)},
               static_cast<BinaryAngle>(std::llround(at / (2 * std::numbers::pi) * 4294967296.0))};
  return in;
}

Seen turned(const Case& x) {
  const FieldDriveConfig<double> c = config_of(x);
  FieldDriveState<double> state;
  Telemetry<double> telemetry{};
  Winding winding(x);
  Complex next{};
  Seen seen;
  const auto periods = static_cast<long>((x.ramp_s + x.held_s) / x.period_s);
  constexpr int pieces = 12;
  for (long n = 0; n < periods; ++n) {
    const double t = static_cast<double>(n) * x.period_s;
    const double part = x.ramp_s > 0 ? std::min(1.0, t / x.ramp_s) : 1.0;
    const double w = x.from_rad_s + (x.to_rad_s - x.from_rad_s) * part;
    const Complex before = next;
    next = vector_of(field_drive_step(c, state, input_of(x, winding, w, c.advance.rad_s),
                                      Setpoint<double>{x.i_q}, telemetry),
                     x.bus_V);
    for (int k = 0; k < pieces; ++k) {
      winding.go(x.delay > 0 ? before : next, w, x.period_s / pieces);
      seen.peak_A = std::max(seen.peak_A, winding.length());
      if (t > x.ramp_s + x.held_s / 2) seen.end_A = std::max(seen.end_A, winding.length());
    }
  }
  return seen;
}

/// A motor with 7 pole pairs, a flux linkage of 5.12 mWb and 22.3 uH, on a bus of 60 V. The back-EMF reaches
/// the voltage circle at 966 rad/s.
Case hand_brake() {
  return {.R = 0.0187,
          .L = 22.3e-6,
          .psi = 5.12e-3,
          .pole_pairs = 7,
          .bus_V = 60,
          .period_s = 33.333e-6,
          .delay = 1,
          .bandwidth_rad_s = 2 * std::numbers::pi * 1000,
          .to_rad_s = 1000};
}

/// Without this limitation, the current would be 460 A in each case. This is 2 psi/L, the current of a sudden
/// short circuit.
TEST(ShortBus, AHandBrakeThatIsTurnedBeyondTheBusIsHeld) {
  for (const double i_q : {0.0, 80.0, -80.0, -20.0})
    for (const double weakening_A : {0.0, 5.0, 40.0, 150.0})
      for (const double bandwidth_Hz : {300.0, 1000.0, 2000.0}) {
        Case x = hand_brake();
        x.i_q = i_q;
        x.weakening_A = weakening_A;
        x.bandwidth_rad_s = 2 * std::numbers::pi * bandwidth_Hz;
        // The requested d current lowers the voltage to 95 % of the circle. It needs 20 A of the allowed 150
        // A.
        const double most = std::hypot(i_q, std::min(weakening_A, 20.0)) + x.least_A(1000);
        const Seen seen = turned(x);
        EXPECT_LT(seen.peak_A, most + 5.0) << i_q << ' ' << weakening_A << ' ' << bandwidth_Hz;
      }
  EXPECT_NEAR(hand_brake().least_A(1000), 7.6, 0.1);
}

/// The law also holds without decoupling. It also holds if each axis is limited to half the bus voltage,
/// although the circle within these limits is smaller.
TEST(ShortBus, OtherLimitsHoldItToo) {
  for (const double i_q : {0.0, 80.0, -80.0})
    for (const bool axes : {false, true}) {
      Case x = hand_brake();
      x.i_q = i_q;
      x.axes = axes;
      x.decouples = axes;
      EXPECT_LT(turned(x).peak_A, std::fabs(i_q) + x.least_A(1000) + 5.0)
          << i_q << (axes ? " axes" : " coupled");
    }
}

Case drawn(std::mt19937_64& random) {
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  const auto decades = [&](double a, double b) { return a * std::pow(b / a, between(0, 1)); };
  Case x;
  x.delay = between(0, 1) < 0.5;
  // The magnet turns by up to 0.4 rad per period at the speed at which the bus limits, and by 0.8 rad at
  // twice this speed. The advance of the angle is limited to 1 rad.
  const double w_0 = decades(0.01, x.delay > 0 ? 0.25 : 0.4) / x.period_s;
  x.psi = x.bus_V / std::numbers::sqrt3 / w_0;
  x.L = decades(0.3, 30) * x.R / w_0;
  const double most = x.delay > 0 ? std::numbers::ln2 : 1.5, shorted_A = x.psi / x.L;
  x.bandwidth_rad_s = decades(0.01, most) / x.period_s;
  x.i_q = between(-1, 1) * std::min(x.circle_V() / x.R, 1.5 * shorted_A);
  if (between(0, 1) < 0.5) x.weakening_A = between(0.01, 0.99) * shorted_A;
  x.to_rad_s = w_0 * between(0.9, 2) * (between(0, 1) < 0.5 ? -1 : 1);
  const double tau_s = x.L / x.R + 1 / x.bandwidth_rad_s;
  x.ramp_s = std::min(60 * tau_s, 1.0);
  x.held_s = x.ramp_s / 2;
  return x;
}

int count(int usual) {
  const char* asked = std::getenv("SIXSTEP_SHORT_BUS");
  return asked != nullptr ? std::atoi(asked) : usual;
}

TEST(ShortBus, ItIsHeldWhateverIsAskedForUpToTwiceTheSpeedWithoutALoad) {
  const unsigned seed = 20261127;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const int cases = count(25);
  for (int n = 0; n < cases; ++n) {
    const Case x = drawn(random);
    EXPECT_LE(turned(x).peak_A, x.asked_A() + x.least_A(x.to_rad_s) + x.margin_A())
        << "case " << n << ": L/R " << x.L / x.R << " s, i_q " << x.i_q << " A, weakening " << x.weakening_A
        << " A, psi/L " << x.psi / x.L << " A, " << x.to_rad_s << " rad/s, bandwidth "
        << x.bandwidth_rad_s * x.period_s << "/T, delay " << x.delay;
  }
}

/// The drive starts without a current, at a speed beyond the bus voltage. At first, the available voltage is
/// too small for the current that it can maintain later. The current oscillates around this final value by at
/// most the initial difference, and settles there.
TEST(ShortBus, BegunBeyondTheBusItSwingsOnce) {
  const unsigned seed = 20261128;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const int cases = count(25);
  for (int n = 0; n < cases; ++n) {
    Case x = drawn(random);
    x.from_rad_s = x.to_rad_s;
    const double steady = x.asked_A() + x.least_A(x.to_rad_s), swing = steady + x.margin_A();
    const Seen seen = turned(x);
    EXPECT_LE(seen.peak_A, steady + swing) << "case " << n;
    EXPECT_LE(seen.end_A, steady + x.margin_A()) << "case " << n;
  }
}

}  // namespace SIXSTEP_TEST_FILE
