// SPDX-License-Identifier: Apache-2.0
// Recorded voltages that contradict the assumption of one motor. A wrong divider or unit of one column, or a
// reversed probe, gives a constant that no motor has: the log is refused. A difference of a few per cent is
// accepted, because real motors have it.
#include <gmock/gmock.h>

#include "sixstep/analysis/identification/hall/identify.hpp"
#include "tests/analysis/identification/drilled.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::HallLog;
using analysis::RecordedVoltages;
using ::testing::HasSubstr;

HallLog between_lines(int channels) {
  HallTruth t = drilled();
  t.voltages = RecordedVoltages::lines;
  t.noise_V = 0.005;
  t.channels = channels;
  return drawn_log(t).log;
}

/// Voltages against terminal b: u_a = u_ab, u_b = 0, u_c = -u_bc.
HallLog against_b() {
  HallLog log = between_lines(2);
  log.voltages = RecordedVoltages::terminals;
  log.u_V[2] = log.u_V[1];
  for (double& u : log.u_V[2]) u = -u;
  log.u_V[1].assign(log.t_s.size(), 0.0);
  return log;
}

void expect_told(const HallLog& right, std::size_t column) {
  for (const double factor : {1e-6, 0.1, 0.5, 2.0, 10.0, 1e6, 0.97, 1.0, 1.03}) {
    HallLog log = right;
    for (double& u : log.u_V[column]) u *= factor;
    const auto found = analysis::identify(log);
    const bool alike = factor > 0.9 && factor < 1.1;
    ASSERT_EQ(bool{found}, alike) << factor << " at " << column;
    if (alike) continue;
    EXPECT_THAT(to_string(found.problems()[0]), HasSubstr("differ too much for the phases of one motor"));
  }
}

TEST(IdentifyAlike, AFactorOfOneColumnIsRefused) {
  for (const std::size_t column : {0, 1}) expect_told(between_lines(2), column);
  for (const std::size_t column : {0, 1, 2}) expect_told(between_lines(3), column);
  for (const std::size_t column : {0, 2}) expect_told(against_b(), column);
}

/// If one probe is reversed, the two recorded voltages are 60 degrees apart instead of 120. The third line
/// voltage, computed from these two, is sqrt(3) times too large.
TEST(IdentifyAlike, AProbeTheWrongWayRoundIsRefused) {
  for (const std::size_t column : {0, 1}) {
    HallLog log = between_lines(2);
    for (double& u : log.u_V[column]) u = -u;
    const auto found = analysis::identify(log);
    ASSERT_FALSE(found);
    EXPECT_THAT(to_string(found.problems()[0]), HasSubstr("their polarity"));
  }
}

}  // namespace SIXSTEP_TEST_FILE
