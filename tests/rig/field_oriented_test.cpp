// SPDX-License-Identifier: Apache-2.0
// A field-oriented current controller on three legs is compared with the trajectory of an independent
// brute-force solver in float128 (tests/reference/G15.csv). A sine machine starts from rest with i_q* = +-4
// A. The PWM and control period is 50 us, with centred pulses, space vector modulation and one period of
// delay.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "sixstep/base/elementary.hpp"
#include "sixstep/control/three_phase_pwm.hpp"
#include "tests/support/three_leg_firmware.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

constexpr double T = 50e-6, bus_V = 24.0;

control::Direction<double> direction(double rad) { return {base::cos(rad), base::sin(rad)}; }

/// A PI controller in velocity form: v[n] = v[n-1] + 1.2 e[n] - 1.1 e[n-1], with the voltage v in V and the
/// error e in A. v is limited to +-12 V, and the limited value is stored.
struct VelocityPi {
  double v = 0.0, e = 0.0;
  double step(double error) {
    v = std::clamp(v + 1.2 * error - 1.1 * e, -12.0, 12.0);
    e = error;
    return v;
  }
};

struct FieldOriented {
  VelocityPi d, q;

  template <class Real>
  control::LegCommands<double> operator()(const rig::SampleInstant<Real>& instant, double i_q) {
    const plant::State<Real>& s = instant.state;
    const double w_e = instant.pole_pairs * s.w;
    const double theta_d = plant::sector_in_turn(s.sector) * base::sector_rad + s.x - 5 * base::pi / 6;
    const control::Dq<double> i =
        park(control::clarke(control::Abc<double>{s.i[0], s.i[1], s.i[2]}), direction(theta_d));
    const control::Dq<double> v{d.step(-i.d), q.step(i_q - i.q)};
    // The voltage acts in an interval whose middle is a period and a half after the sample.
    return space_vector(inverse_clarke(inverse_park(v, direction(theta_d + 1.5 * T * w_e))), bus_V);
  }
};

TEST(FieldOriented, FollowsTheReferenceTrajectory) {
  Board b;
  b.machine.back_emf = plant::BackEmf::sine;
  b.board.delayed = true;
  b.board.modulator.period_ticks = 50'000'000;
  b.board.modulator.centre_aligned = true;
  for (int n = 0; n < 4; ++n) b.setpoint(n * 5'000'000'000, n % 2 == 0 ? 4.0 : -4.0);
  auto rig = three_leg_rig(b, FieldOriented{});

  std::ifstream file(SIXSTEP_SOURCE_DIR "/tests/reference/G15.csv");
  std::string line;
  std::getline(file, line);
  ASSERT_EQ(line, "t,i_a,i_b,i_c,w_m,theta_m");
  std::array<double, 5> worst{}, peak{};
  int rows = 0;
  for (; std::getline(file, line); ++rows) {
    std::array<double, 6> row{};
    const char* at = line.c_str();
    for (double& value : row) {
      char* end = nullptr;
      value = std::strtod(at, &end);
      at = *end == ',' ? end + 1 : end;
    }
    ASSERT_EQ(run_to(rig, row[0]), sim::Stop::end);
    const plant::State<double>& s = rig.plant().state();
    const double theta = (static_cast<double>(s.sector) * base::sector_rad + s.x) / 8;
    const std::array<double, 5> have{s.i[0], s.i[1], s.i[2], s.w, theta};
    for (std::size_t k = 0; k < 5; ++k) {
      worst[k] = std::max(worst[k], std::abs(have[k] - row[k + 1]));
      peak[k] = std::max(peak[k], std::abs(row[k + 1]));
    }
  }
  EXPECT_EQ(rows, 401);
  // The accuracy of the reference determines the bounds: 1e-10 of the peak for currents, 1e-12 of the peak
  // for the other columns.
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_LE(worst[k], (k < 3 ? 1e-10 : 1e-12) * peak[k]) << "column " << k + 1;
}

}  // namespace SIXSTEP_TEST_FILE
