// SPDX-License-Identifier: Apache-2.0
// Tests the board's analogue front end in whole runs. With a locked motor, the outputs are compared with
// closed forms: first-order lags of exponentials. With a turning motor, which freewheels and has a floating
// leg, the outputs are compared with the integral of the lag, by quadrature of the plant's values. The cases
// include both kernels, crossed wires and delays.
#include "sixstep/rig/front_end.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/general.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

/// A drive with converters. It stores the terminal voltages that it receives.
struct Looking : rig::SensedDrive<double> {
  using SensedDrive::SensedDrive;
  plant::PerLeg<double> terminal_V{};
  void look_at_terminals(const plant::PerLeg<double>& u) { terminal_V = u; }
  bool open_loop() const { return false; }  ///< the drive samples although its constant duty needs no sample
};
using LookingRig = rig::Rig<double, Looking>;
using GeneralLookingRig = GeneralRigOf<Looking>;

constexpr std::int64_t period_ticks = 30'000'000;
constexpr double period_s = 30e-6;

Board held(double duty, const rig::FrontEndConfig& front_end) {
  Board board = Board::duty(duty);
  board.shaft.locked = true;
  board.start.angle_rad = at_electrical_deg(10);  // the pair a to b
  board.board.modulator.period_ticks = period_ticks;
  board.board.front_end = front_end;
  return board;
}

LookingRig rig_of(const Board& board) {
  return LookingRig(board.plant(), board.drive, board.board, board.timeline);
}

/// Output at the time t of a first-order lag with the time constant tau. The output starts at x, and the
/// input is a + b exp(-t/T).
double lagged(double x, double a, double b, double T, double tau, double t) {
  const double particular = b / (1 - tau / T);
  return a + particular * std::exp(-t / T) + (x - a - particular) * std::exp(-t / tau);
}

/// The bounds are 1e-12 of the largest current and of the largest voltage.
constexpr double amp = 1e-12 * 24 / 1.03, volt = 1e-12 * 24;

TEST(FrontEnd, AnAmplifierFollowsTheHeldMotorsCurrent) {
  for (const double tau : {2e-9, 1e-6, 40e-6, 3e-3}) {
    const Board board = held(1.0, {.amplifier_s = tau});
    LookingRig rig = rig_of(board);
    const double I = 24 / board.R_tt(), T = board.tau();
    for (const double t : {17e-6, 30e-6, 0.2e-3, 1e-3, 5e-3}) {
      ASSERT_EQ(run_to(rig, t), sim::Stop::end);
      const rig::FrontEndReading& seen = rig.front_end().reading();
      const double expected = lagged(0, I, -I, T, tau, t);
      EXPECT_NEAR(seen.i_A[0], expected, amp) << tau << " " << t;
      EXPECT_NEAR(seen.i_A[1], -expected, amp);
      EXPECT_EQ(seen.i_A[2], 0);
      EXPECT_NEAR(seen.dc_link_A, expected, amp);  // the whole time is one on-time
    }
  }
}

TEST(FrontEnd, ADelayShowsTheCurrentBeforeTheSample) {
  for (const double tau : {0.0, 2e-6})
    for (const bool middle : {false, true}) {
      Board board = held(1.0, {.amplifier_s = tau, .amplifier_delay_ticks = 7'123'456});
      board.board.sampled_in_middle = middle;
      LookingRig rig = rig_of(board);
      const double I = 24 / board.R_tt(), T = board.tau();
      double begin = 0;  // if sampled in the middle, the first command waits for the next period
      if (middle) begin = period_s;
      for (const int n : {3, 4, 20}) {
        const double sample = n * period_s + (middle ? period_s / 2 : 0);
        ASSERT_EQ(run_to(rig, sample), sim::Stop::end);
        const double t = sample - 7.123456e-6 - begin;
        const double expected = tau > 0 ? lagged(0, I, -I, T, tau, t) : I - I * std::exp(-t / T);
        EXPECT_NEAR(rig.front_end().reading().i_A[0], expected, amp) << tau << middle << n;
      }
    }
}

TEST(FrontEnd, ALinksAmplifierSeesPulses) {
  const double tau = 8e-6, duty = 0.3, on_s = duty * period_s, off_s = period_s - on_s;
  const Board board = held(duty, {.amplifier_s = tau});
  LookingRig rig = rig_of(board);
  const double I = 24 / board.R_tt(), T = board.tau();
  double i = 0, x = 0;
  for (int n = 1; n <= 200; ++n) {
    x = lagged(x, I, i - I, T, tau, on_s);
    i = I + (i - I) * std::exp(-on_s / T);
    x *= std::exp(-off_s / tau);  // freewheeling current does not flow through the link
    i *= std::exp(-off_s / T);
    ASSERT_EQ(run_to(rig, n * period_s), sim::Stop::end);
    EXPECT_NEAR(rig.front_end().reading().dc_link_A, x, amp) << n;
  }
  EXPECT_GT(x, 0.1);
}

/// In the on-time leg a is above and leg b below; in the off-time the current flows through a's lower diode.
TEST(FrontEnd, AnAmplifierOfALowSideShuntFollowsTheLowerPathOnly) {
  const double tau = 8e-6, duty = 0.3, on_s = duty * period_s, off_s = period_s - on_s;
  const Board board = held(duty, {.amplifier_s = tau, .shunts = 0b011});
  LookingRig rig = rig_of(board);
  const double I = 24 / board.R_tt(), T = board.tau();
  double i = 0, a = 0, b = 0;
  for (int n = 1; n <= 200; ++n) {
    a *= std::exp(-on_s / tau);
    b = lagged(b, -I, I - i, T, tau, on_s);
    i = I + (i - I) * std::exp(-on_s / T);
    a = lagged(a, 0, i, T, tau, off_s);
    b = lagged(b, 0, -i, T, tau, off_s);
    i *= std::exp(-off_s / T);
    ASSERT_EQ(run_to(rig, n * period_s), sim::Stop::end);
    EXPECT_NEAR(rig.front_end().reading().i_A[0], a, amp) << n;
    EXPECT_NEAR(rig.front_end().reading().i_A[1], b, amp) << n;
    EXPECT_EQ(rig.front_end().reading().i_A[2], 0) << n;
  }
  EXPECT_GT(a, 0.1);
}

TEST(FrontEnd, DividersAverageAChoppedTerminal) {
  const double tau = 100e-6, duty = 0.3;
  LookingRig rig = rig_of(held(duty, {.divider_s = tau}));
  const double on = std::exp(-duty * period_s / tau), off = std::exp(-(1 - duty) * period_s / tau);
  ASSERT_EQ(run_to(rig, period_s), sim::Stop::end);
  // Before the run, all three legs float at half the bus voltage.
  EXPECT_NEAR(rig.front_end().reading().terminal_V[0], (24 + (12.0 - 24) * on) * off, volt);
  EXPECT_NEAR(rig.front_end().reading().terminal_V[1], 12 * on * off, volt);
  ASSERT_EQ(run_to(rig, 200 * period_s), sim::Stop::end);  // 60 time constants later
  const rig::FrontEndReading& seen = rig.front_end().reading();
  const double low = 24 * (1 - on) / (1 - on * off) * off;
  EXPECT_NEAR(seen.terminal_V[0], low, volt);
  EXPECT_NEAR(seen.terminal_V[1], 0, volt);
  EXPECT_NEAR(seen.terminal_V[2], low / 2, volt);  // c floats at the mean of a and b
  EXPECT_EQ(seen.bus_V, 24);
  // At its tick, the drive received the same value.
  ASSERT_EQ(run_to(rig, 200 * period_s + 1e-6), sim::Stop::end);
  EXPECT_NEAR(rig.firmware().terminal_V[2], low / 2, volt);
}

/// The integral of the lag over whole segments: x exp(-z) + z int exp(-z (1 - r)) u(r) dr. z is the duration
/// of the segment divided by tau, r is the elapsed part of the segment, x is the initial output, and the
/// input u comes from plant.at(). The quadrature has ten pieces of five Gauss points. For z < 1, which is
/// true in these tests, its error is below rounding.
struct Quadrature {
  double tau;
  plant::PerLeg<double> x{}, i{};
  double bus = 24;
  double worst_series = 0;
  int floating = 0, coasting = 0;

  template <class Rig>
  void segment(const Rig& rig, double s) {
    constexpr double at[] = {0.0, 0.538469310105683091, 0.906179845938663993};
    constexpr double of[] = {0.568888888888888889, 0.478628670499366468, 0.236926885056189088};
    const auto& y = rig.plant().expansion();
    const double z = s * y.h / tau, kept = std::exp(-z);
    if (y.h == 0) return;
    plant::PerLeg<double> u_sum{}, i_sum{};
    double bus_sum = 0;
    const auto series = plant::terminal_series(rig.plant(), s);
    constexpr int pieces = 10;
    for (int n = 0; n < pieces; ++n)
      for (int k = -2; k <= 2; ++k) {
        const double r = (n + 0.5 + (k < 0 ? -at[-k] : at[k]) / 2) / pieces;
        const double weight = of[std::abs(k)] / 2 / pieces * std::exp(-z * (1 - r));
        const auto now = rig.plant().at(s * r);
        for (int leg = 0; leg < 3; ++leg) {
          u_sum[leg] += weight * now.pole[leg];
          i_sum[leg] += weight * now.i[leg];
          worst_series = std::fmax(worst_series,
                                   std::fabs(series::evaluate(series[leg], y.degree, s * r) - now.pole[leg]));
        }
        bus_sum += weight * now.bus;
      }
    for (int leg = 0; leg < 3; ++leg) {
      x[leg] = x[leg] * kept + z * u_sum[leg];
      i[leg] = i[leg] * kept + z * i_sum[leg];
    }
    bus = bus * kept + z * bus_sum;
    const int connected = plant::connected_count(rig.plant().mode().legs);
    floating += connected == 2;
    coasting += connected == 0;
  }
};

Board turning(double duty) {
  Board board = Board::duty(duty);
  board.start.speed_rad_s = 300;
  board.board.modulator.period_ticks = period_ticks;
  board.board.front_end = {.amplifier_s = 60e-6, .divider_s = 60e-6};
  board.devices = {.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.02};
  board.supply = {.V_0_V = 24, .R_b_ohm = 0.1, .C_F = 470e-6};
  return board;
}

template <class Rig>
Quadrature held_against_quadrature(Rig rig, double tau) {
  Quadrature exact{.tau = tau, .x = rig.front_end().reading().terminal_V};
  EXPECT_EQ(run_to(rig, 10e-3, exact), sim::Stop::end);
  const rig::FrontEndReading& seen = rig.front_end().reading();
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(seen.terminal_V[k], exact.x[k], volt) << k;
    EXPECT_NEAR(seen.i_A[k], exact.i[k], amp) << k;
  }
  EXPECT_NEAR(seen.bus_V, exact.bus, volt);
  EXPECT_LT(exact.worst_series, volt);
  return exact;
}

TEST(FrontEnd, ShowsAllSwitchingOfATurningMotor) {
  for (const plant::BackEmf shape : {plant::BackEmf::trapezoid, plant::BackEmf::sine})
    for (const double duty : {0.6, -0.2}) {
      Board board = turning(duty);
      board.machine.back_emf = shape;
      const Quadrature exact = held_against_quadrature(rig_of(board), 60e-6);
      EXPECT_GT(exact.floating, 100);
    }
}

TEST(FrontEnd, ShowsACoastingStarCentred) {
  for (const plant::BackEmf shape : {plant::BackEmf::trapezoid, plant::BackEmf::sine}) {
    Board board = turning(0);
    board.drive.mode = control::Mode::off;
    board.machine.back_emf = shape;
    const Quadrature exact = held_against_quadrature(rig_of(board), 60e-6);
    EXPECT_GT(exact.coasting, 10);
  }
}

TEST(FrontEnd, TheGeneralKernelsTerminalsAreShownAlike) {
  GeneralSetup setup;
  setup.start.speed_rad_s = 300;
  setup.devices = {.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.02};
  setup.supply = {.V_0_V = 24, .R_b_ohm = 0.1, .C_F = 470e-6};
  for (const control::Mode mode : {control::Mode::duty, control::Mode::off}) {
    Board board = turning(0.6);
    board.drive.mode = mode;
    const GeneralLookingRig rig(setup.plant(), board.drive, board.board, board.timeline);
    const Quadrature exact = held_against_quadrature(rig, 60e-6);
    EXPECT_GT(mode == control::Mode::off ? exact.coasting : exact.floating, 10);
  }
}

TEST(FrontEnd, BelongsToTheBoardsLegs) {
  GeneralSetup setup;
  setup.shaft.locked = true;
  Board board = Board::duty(1.0);
  board.board.front_end = {.amplifier_s = 1e-15, .divider_s = 1e-15};
  const rig::Wiring crossed{.phases = rig::WireOrder::bca};
  GeneralLookingRig rig(setup.plant(), board.drive, board.board, board.timeline, {}, crossed);
  ASSERT_EQ(run_to(rig, 1.01e-3), sim::Stop::end);
  const rig::FrontEndReading& seen = rig.front_end().reading();
  const auto& i = rig.plant().state().i;
  for (std::size_t leg = 0; leg < 3; ++leg) EXPECT_NEAR(seen.i_A[leg], i[crossed.phase(leg)], amp) << leg;
  EXPECT_NEAR(seen.i_A[0], -seen.i_A[1], amp);  // legs a and b are driven, whichever phases are connected to
                                                // them
  EXPECT_GT(seen.i_A[0], 1);
  EXPECT_NEAR(seen.terminal_V[0], 24, volt);
  EXPECT_NEAR(seen.terminal_V[1], 0, volt);
}

/// If the board has no lags, the drive receives the true values, equal to the last bit.
TEST(FrontEnd, WithoutAnyItIsNotThere) {
  LookingRig rig = rig_of(held(0.5, {}));
  ASSERT_EQ(run_to(rig, 1e-3), sim::Stop::end);
  EXPECT_FALSE(rig.front_end().follows());
  EXPECT_EQ(rig.front_end().reading().i_A[0], 0);
  EXPECT_GT(rig.plant().state().i[0], 1);
}

}  // namespace SIXSTEP_TEST_FILE
