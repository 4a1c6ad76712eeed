// SPDX-License-Identifier: Apache-2.0
// The yardstick must be fair: it solves the same machine, with the error that its step allows and no more.
#include "benchmarks/rk4_yardstick.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

namespace {

using namespace benchmarks;

TEST(Rk4Yardstick, RisesAsAnRlCircuitWithTheRotorHeld) {
  YardstickParameters held;
  held.J = 1e12;
  Rk4Yardstick motor(held);
  motor.set_reference(1.0);
  for (int n = 1; n <= 3000; ++n) {
    motor.step();
    const double exact = held.U / (2 * held.R) * (1.0 - std::exp(-n * held.step_s * held.R / held.L));
    // Fourth order: (h R/L)^5/120 a step, times the steps of one time constant.
    ASSERT_NEAR(motor.current(0), exact, 1e-12 * 24) << n;
    ASSERT_EQ(motor.current(2), 0.0);
  }
}

struct Errors {
  double current = 0.0, speed = 0.0;
};

/// Largest errors of phase currents and speed against the reference trajectory, as shares of their largest
/// value.
Errors errors(double step_s, bool floating_phase_conducts = true) {
  YardstickParameters parameters;
  parameters.step_s = step_s;
  parameters.floating_phase_conducts = floating_phase_conducts;
  parameters.steps_per_period = static_cast<int>(std::lround(30e-6 / step_s));
  Rk4Yardstick motor(parameters);
  motor.set_reference(0.5);
  std::ifstream file(SIXSTEP_SOURCE_DIR "/tests/reference/R3.csv");
  std::string line;
  std::getline(file, line);
  long done = 0;
  Errors error, largest;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    double t_s = 0.0;
    cells >> t_s;
    for (const long until = std::lround(t_s / step_s); done < until; ++done) motor.step();
    for (std::size_t k = 0; k < 3; ++k) {
      double exact = 0.0;
      cells >> exact;
      error.current = std::max(error.current, std::abs(motor.current(k) - exact));
      largest.current = std::max(largest.current, std::abs(exact));
    }
    double exact = 0.0;
    cells >> exact;
    error.speed = std::max(error.speed, std::abs(motor.speed() - exact));
    largest.speed = std::max(largest.speed, std::abs(exact));
  }
  return {error.current / largest.current, error.speed / largest.speed};
}

TEST(Rk4Yardstick, HasTheFloatingPhaseAndFirstOrderErrorsUnderSoftChopping) {
  // Only the switching instants between steps are left, and they shrink with the step.
  const double coarse = errors(1e-6).current, fine = errors(1e-7).current;
  std::printf("RK4 with it: %.2f %% of peak current at 1 us, %.3f %% at 0.1 us\n", 100 * coarse, 100 * fine);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_LT(fine, coarse / 4);
}

TEST(Rk4Yardstick, LeavingTheFloatingPhaseOutCostsTenPercentOfPeakCurrentAtAnyStep) {
  const Errors fine = errors(1e-7, false), finer = errors(2.5e-8, false);
  std::printf("without the floating phase: %.2f %% of peak current, %.2f %% of speed\n", 100 * finer.current,
              100 * finer.speed);
  EXPECT_NEAR(finer.current, 0.106, 0.0005);
  EXPECT_NEAR(finer.speed, 0.0040, 0.0005);
  EXPECT_NEAR(fine.current, finer.current, 0.002);  // no smaller step helps
}

TEST(Rk4Yardstick, HoldsItsReferences) {
  YardstickParameters parameters{.mode = YardstickMode::speed};
  Rk4Yardstick motor(parameters);
  motor.set_reference(100.0);
  double mean = 0.0;
  for (int n = 0; n < 100000; ++n) {
    motor.step();
    if (n >= 80000) mean += motor.speed() / 20000;
  }
  EXPECT_NEAR(mean, 100.0, 0.1);
}

}  // namespace
