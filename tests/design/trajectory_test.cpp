// SPDX-License-Identifier: Apache-2.0
// The two models of the thesis receive the terminal voltages of the engine and reproduce its trajectory. The
// engine and the models have no common code.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/design/thesis/thesis_models.hpp"
#include "tests/support/board.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

/// Voltages are smooth between two events. Each segment of the engine is therefore integrated separately.
constexpr int steps_per_segment = 8;

template <std::size_t States, class Rate>
std::array<double, States> rk4(const std::array<double, States>& x, double t, double h, Rate&& rate) {
  const auto moved = [&](const std::array<double, States>& by, double f) {
    std::array<double, States> y = x;
    for (std::size_t n = 0; n < States; ++n) y[n] += f * by[n];
    return y;
  };
  const auto k1 = rate(t, x), k2 = rate(t + h / 2, moved(k1, h / 2)), k3 = rate(t + h / 2, moved(k2, h / 2)),
             k4 = rate(t + h, moved(k3, h));
  std::array<double, States> y = x;
  for (std::size_t n = 0; n < States; ++n) y[n] += h / 6 * (k1[n] + 2 * k2[n] + 2 * k3[n] + k4[n]);
  return y;
}

/// Runs both thesis models in parallel with the engine.
class Beside {
 public:
  explicit Beside(const Board& board) : board_(board) {
    five_[4] = four_[3] = board.start.angle_rad;
    five_[3] = four_[2] = board.start.speed_rad_s;
  }

  void segment(const rig::LeanRig<double>& rig, double s) {
    const auto& p = rig.plant();
    const double length = p.expansion().h * s;
    if (!(length > 0)) return;
    const double h = length / steps_per_segment, load = p.constants().load;
    const auto part = [&](double t) { return p.at(t / length * s); };
    for (int n = 0; n < steps_per_segment; ++n) {
      five_ = rk4<5>(five_, n * h, h, [&](double t, const auto& x) {
        const auto now = part(t);
        const double u_n = plant::star_voltage(p.mode().legs, p.constants().poles, now.bus, now.i, now.emf);
        return design::phase_voltage_model(board_.machine, board_.shaft, {x[4]})
            .derivative(x, {now.pole[0] - u_n, now.pole[1] - u_n, now.pole[2] - u_n, load});
      });
      four_ = rk4<4>(four_, n * h, h, [&](double t, const auto& x) {
        const auto now = part(t);
        return design::terminal_voltage_model(board_.machine, board_.shaft, {x[3]})
            .derivative(x, {now.pole[0] - now.pole[1], now.pole[1] - now.pole[2], load});
      });
    }
    compare(p, s);
  }
  double current_error_A() const { return current_error_; }
  double speed_error() const { return speed_error_; }
  double angle_error() const { return angle_error_; }

 private:
  void compare(const plant::Plant<double>& p, double s) {
    const auto now = p.at(s);
    for (std::size_t k = 0; k < 3; ++k)
      current_error_ = std::max(current_error_, std::fabs(five_[k] - now.i[k]));
    for (std::size_t k = 0; k < 2; ++k)
      current_error_ = std::max(current_error_, std::fabs(four_[k] - now.i[k]));
    speed_error_ = std::max({speed_error_, std::fabs(five_[3] - now.speed), std::fabs(four_[2] - now.speed)});
    angle_error_ = std::max({angle_error_, std::fabs(five_[4] - now.angle), std::fabs(four_[3] - now.angle)});
  }

  Board board_;
  std::array<double, 5> five_{};
  std::array<double, 4> four_{};
  double current_error_ = 0, speed_error_ = 0, angle_error_ = 0;
};

/// The error of RK4 is (h/tau)^5/120 of the scale per step (step h, fastest time constant tau). It decays
/// over tau, so the total is (h/tau)^4/120. Segments last at most tau/2 (`useful_length`), so h/tau <= 1/16,
/// and the bound is 1.3e-7. With chopping, segments last at most 15 us: h/tau <= 15/(8 * 555), and the bound
/// is 1.1e-12. A model's angle error shifts its shape, and a corner of the shape within a step increases the
/// error by a factor of h. The factor 10 covers these errors.
void expect_beside(const Board& board, double length_s, double h_over_tau) {
  auto rig = board.rig();
  Beside beside(board);
  ASSERT_EQ(run_to(rig, length_s, beside), sim::Stop::end);
  const double part = 10 * std::pow(h_over_tau, 4) / 120 + 1e3 * eps;
  EXPECT_LE(beside.current_error_A(), part * 24.0 / board.R_tt());
  EXPECT_LE(beside.speed_error(), part * 24.0 / (2 * board.machine.K_e_V_s));
  EXPECT_LE(beside.angle_error(), part * 24.0 / (2 * board.machine.K_e_V_s) * length_s);
}

TEST(ThesisModels, FollowTheEngineUnderFullVoltage) { expect_beside(Board::duty(1.0), 30e-3, 1.0 / 16); }

TEST(ThesisModels, FollowTheEngineUnderSoftChopping) {
  expect_beside(Board::duty(0.5), 30e-3, 15.0 / (8 * 555));
}

TEST(ThesisModels, FollowTheEngineThroughReversalAndLoad) {
  Board b = Board::duty(0.6, control::Chopping::hard);
  b.devices = {.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.02};
  b.setpoint(10'000'000'000, -0.4);
  b.load(5'000'000'000, 0.05);
  expect_beside(b, 20e-3, 18.0 / (8 * 555));
}

TEST(ThesisModels, FollowTheEngineWithASineMachine) {
  Board b = Board::duty(0.5, control::Chopping::complementary);
  b.machine.back_emf = plant::BackEmf::sine;
  expect_beside(b, 20e-3, 15.0 / (8 * 555));
}

TEST(ThesisModels, TorqueIsTheEnginesTorque) {
  const Board b = Board::duty(0.5);
  auto rig = b.rig();
  struct Torque {
    const Board& board;
    double worst = 0;
    void segment(const rig::LeanRig<double>& r, double s) {
      for (const double part : {0.0, 0.4, 1.0}) {
        const auto now = r.plant().at(s * part);
        const auto f = design::back_emf_shape(board.machine, {now.angle * board.machine.pole_pairs});
        const double T = design::electromagnetic_torque(board.machine, f, {now.i[0], now.i[1], now.i[2]});
        worst = std::max(worst, std::fabs(T - now.torque));
      }
    }
  } torque{b};
  ASSERT_EQ(run_to(rig, 0.1, torque), sim::Stop::end);
  // The relative error of the angle is eps, at an angle of some 235 electrical rad. A ramp of the shape has a
  // slope of 2 per 60 degrees.
  const double shape_error = 4 * eps * 240 * 2 / base::sector_rad;
  EXPECT_LE(torque.worst, 3 * b.machine.K_e_V_s * 23.3 * shape_error + 64 * eps);
}

}  // namespace SIXSTEP_TEST_FILE
