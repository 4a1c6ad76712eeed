// SPDX-License-Identifier: Apache-2.0
// A voltage vector rotates in open loop on a sine machine of constant speed. The current is compared with the
// phasor solution: its fundamental is the fundamental of the voltage divided by R + j w L.
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "sixstep/base/elementary.hpp"
#include "sixstep/control/three_phase_pwm.hpp"
#include "tests/support/three_leg_firmware.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using Complex = std::complex<double>;

constexpr double T = 30e-6, U = 24.0, pi = std::numbers::pi;
constexpr int periods = 60;  // PWM periods in an electrical turn
constexpr double w = 2 * pi / (periods * T), start_deg = 20.0;

/// Leg commands for a rotating vector of the length V. At the sample n = 0, the vector leads phase a by
/// `phase_rad`.
struct TurningVector {
  double V = 0.0, phase_rad = 0.0;
  bool space_vector = true;

  control::LegCommands<double> at(std::uint64_t n) const {
    const double angle = phase_rad + 2 * pi * static_cast<double>(n % periods) / periods;
    const control::Direction<double> along{base::cos(angle), base::sin(angle)};
    const control::Abc<double> v = inverse_clarke(inverse_park(control::Dq<double>{V, 0.0}, along));
    return space_vector ? control::space_vector(v, U) : control::sine_triangle(v, U);
  }
  template <class Real>
  control::LegCommands<double> operator()(const rig::SampleInstant<Real>& instant, double) const {
    return at(instant.number);
  }
};

/// The inertia is 1e9 kg m2. The machine's torque therefore changes the speed in the run by only some 1e-13
/// of its value.
Board bench(bool centred) {
  Board b;
  b.machine.back_emf = plant::BackEmf::sine;
  b.shaft.J_kg_m2 = 1e9;
  b.shaft.B_Nm_s = 0.0;
  b.start.speed_rad_s = w / b.machine.pole_pairs;
  b.start.angle_rad = at_electrical_deg(start_deg);
  b.board.modulator.centre_aligned = centred;
  return b;
}

/// (2/turn) times the integral of i_a exp(-j w t), by a five-point Gauss rule in each segment of length h.
/// The rule is exact within rounding for w h <= 0.1 if the order of the current is far below ten.
struct Fundamental {
  Complex sum = 0.0;
  void segment(const auto& rig, double part) {
    constexpr double node[] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                               0.9061798459386640};
    constexpr double weight[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                 0.4786286704993665, 0.2369268850561891};
    const double h = rig.plant().expansion().h * part;
    for (int n = 0; n < 5; ++n) {
      const double at = (1 + node[n]) / 2;
      const double angle = w * (rig.now().seconds() + at * h);
      sum += weight[n] / 2 * h * rig.plant().at(at * part).i[0] * Complex(std::cos(angle), -std::sin(angle));
    }
  }
};

/// Electrical turns before the turn that is evaluated. L/R is 0.55 ms, so exp(-45) of the initial transient
/// remains.
constexpr int settling_turns = 14;

Complex current(const Board& b, const TurningVector& vector) {
  auto rig = three_leg_rig(b, vector);
  EXPECT_EQ(run_to(rig, settling_turns * periods * T), sim::Stop::end);
  Fundamental fundamental;
  EXPECT_EQ(run_to(rig, (settling_turns + 1) * periods * T, fundamental), sim::Stop::end);
  return fundamental.sum * (2 / (periods * T));
}

Complex impedance(const Board& b) { return {b.machine.R_ohm, w * b.machine.L_H}; }

/// The phasor of e_a = K_e w_m cos(theta_e - 60 deg).
Complex back_emf(const Board& b) {
  return std::polar(b.machine.K_e_V_s * w / b.machine.pole_pairs, (start_deg - 60.0) * pi / 180.0);
}

/// The phasor of a vector whose samples are each constant for a period, without the shape of the pulses.
Complex held(const TurningVector& v) {
  const double half = w * T / 2;
  return std::polar(v.V * std::sin(half) / half, v.phase_rad - half);
}

/// The fundamental of the actual pulses, as the voltage from phase a to the star point. A pulse of length d
/// T, centred at t_c, contributes (2/turn) U d T sinc(w d T/2) exp(-j w t_c) (duty d, period T, bus voltage
/// U).
Complex pulsed(const TurningVector& v, bool centred) {
  const auto leg = [&](int k) {
    Complex sum = 0.0;
    for (int n = 0; n < periods; ++n) {
      const double d = v.at(static_cast<std::uint64_t>(n)).leg[k].duty, half = w * d * T / 2;
      if (half > 0)
        sum += std::polar(d * std::sin(half) / half, -w * (n * T + (centred ? T / 2 : d * T / 2)));
    }
    return 2 * U / periods * sum;
  };
  return leg(0) - (leg(0) + leg(1) + leg(2)) / 3.0;
}

/// The sinc of a centred pulse of length d T exceeds the sinc of a pulse of length T by (1 - d^2) (w T)^2/24.
/// With x = d - 1/2, d (1 - d^2) = 3/8 + x/4 - 3/2 x^2 - x^3. Half a turn later, x has the opposite sign, so
/// the constant and the square have no fundamental. The fundamental of x/4 is V/(4 U). The fundamental of the
/// cube is at most 2/8.
double pulse_shape_V(double V) { return (V + U) / 4 * w * T * w * T / 24; }

/// The bound allows for the solver's error (6.5e-12 of full scale, model.md 12), the quadrature's error, and
/// the initial transient after 45 time constants.
constexpr double tolerance_A = 1e-10 * 23.3;

TEST(VoltageVector, ItsCurrentIsThatOfThePhasorSolution) {
  for (const double phase_deg : {-40.0, 10.0, 80.0})
    for (const bool space_vector : {false, true}) {
      const TurningVector v{space_vector ? 13.5 : 11.5, phase_deg * pi / 180, space_vector};
      const Board b = bench(true);
      const Complex i = current(b, v);
      EXPECT_LE(std::abs(i - (held(v) - back_emf(b)) / impedance(b)),
                pulse_shape_V(v.V) / std::abs(impedance(b)));
      EXPECT_GT(std::abs(i), 1.0) << "beside a bound of 4 mA";
    }
}

TEST(VoltageVector, ItsCurrentIsThatOfItsPulsesToRounding) {
  for (const bool centred : {false, true})
    for (const bool space_vector : {false, true})
      for (const double V : {5.0, 11.9, 13.8, 15.5, 30.0}) {  // amplitudes up to U/2, up to U/sqrt 3, and
                                                              // beyond
        SCOPED_TRACE(::testing::Message() << centred << space_vector << " " << V);
        const TurningVector v{V, 0.3, space_vector};
        const Board b = bench(centred);
        const Complex i = current(b, v);
        EXPECT_LE(std::abs(i - (pulsed(v, centred) - back_emf(b)) / impedance(b)), tolerance_A);
      }
}

/// A delay of one period rotates the voltage back by exactly w T.
TEST(VoltageVector, ADelayOfOnePeriodTurnsTheVoltageBackByOneSample) {
  const TurningVector v{12.0, 0.3};
  Board b = bench(true);
  b.board.delayed = true;
  const Complex voltage = pulsed(v, true) * std::polar(1.0, -w * T);
  EXPECT_LE(std::abs(current(b, v) - (voltage - back_emf(b)) / impedance(b)), tolerance_A);
}

/// The amplitude of the bridge's voltage for a vector of length V. Up to U/2 (sine-triangle) or U/sqrt 3
/// (space vector), it is equal to V (bus voltage U). For larger vectors, it is smaller than V.
TEST(VoltageVector, SpaceVectorReachesUOverRoot3AndSineTriangleHalfOfU) {
  const auto made = [](double V, bool space_vector) {
    const Board b = bench(true);
    const TurningVector v{V, 0.3, space_vector};
    return std::abs(current(b, v) * impedance(b) + back_emf(b)) / std::abs(held(v));
  };
  const double root3 = U / std::numbers::sqrt3;
  EXPECT_NEAR(made(0.999 * U / 2, false), 1.0, pulse_shape_V(U / 2) / (0.999 * U / 2));
  EXPECT_NEAR(made(0.999 * root3, true), 1.0, pulse_shape_V(root3) / (0.999 * root3));
  EXPECT_LT(made(root3, false), 0.95);
  EXPECT_LT(made(1.2 * root3, true), 0.95);
}

}  // namespace SIXSTEP_TEST_FILE
