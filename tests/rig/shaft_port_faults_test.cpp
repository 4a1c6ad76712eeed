// SPDX-License-Identifier: Apache-2.0
// Encoders and resolvers fail during a run. The motion of the shaft has a closed form. The faults are lines
// that are stuck, an index that is lost or false, tracks and windings that break and recover, and an
// excitation that fails and returns.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/control/sensing/pulse_speed.hpp"
#include "sixstep/design/loops/tracking_loop.hpp"
#include "tests/support/turning_shaft.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using rig::ShaftPorts;
using sixstep::testing::Motion;

constexpr double capture_Hz = 1e9;
constexpr int line_A = 1, line_B = 2, line_Z = 3;

ShaftPorts encoder(int lines, const Motion& m) {
  return ShaftPorts({.kind = rig::ShaftSensor::encoder, .encoder = {.lines = lines}}, capture_Hz, 0,
                    m.shaft(0));
}

/// The number of passed quarter lines: floor(4 N theta/2 pi), with N lines per turn.
std::int64_t quarters(const Motion& m, std::int64_t lines, double t) {
  return static_cast<std::int64_t>(std::floor(4 * static_cast<double>(lines) * m.theta(t) / (2 * base::pi)));
}

// If line A or B is stuck, only the edges of the other line remain, and they count up and down by one. After
// the fault, the count follows the lines again. It has lost a whole number of lines: the lines passed during
// the fault, within one line.
TEST(StuckLine, LosesWholeLines) {
  constexpr std::int64_t lines = 1000;
  for (const int line : {line_A, line_B})
    for (const bool high : {false, true})
      for (const double w : {170.0, -310.0})
        for (int n = 0; n < 8; ++n) {
          const Motion m{0.1234 + n * 2 * base::pi / (4 * lines), w, 0};
          ShaftPorts ports = encoder(lines, m);
          m.show(ports, 0, 2e-3);
          const std::int64_t before = ports.quarters();
          ASSERT_EQ(before, quarters(m, lines, 2e-3));
          ports.stick_line(line, high, sim::to_instant(2e-3));
          for (double t = 2e-3; t < 8e-3 - 1e-6; t += 1e-4) {
            m.show(ports, t, t + 1e-4);
            ASSERT_LE(std::abs(ports.quarters() - before), 2) << line << high << w;
          }
          ports.free_line(line, sim::to_instant(8e-3));
          m.show(ports, 8e-3, 0.01);
          const std::int64_t lost = quarters(m, lines, 0.01) - ports.quarters(),
                             passed = quarters(m, lines, 8e-3) - quarters(m, lines, 2e-3);
          EXPECT_EQ(lost % 4, 0) << line << high << w;
          EXPECT_LE(std::abs(lost - passed), 4) << line << high << w;
        }
}

// If one line is stuck, each edge of the other line looks like a reversal at the same angle. The measured
// distance is therefore zero, and so is the speed.
TEST(StuckLine, ReadsAsNoSpeedAtAll) {
  constexpr std::int64_t lines = 1000;
  const Motion m{0.1, 300, 0};
  ShaftPorts ports = encoder(lines, m);
  const control::PulseSpeedConfig<double> config{2 * base::pi / (4 * lines) * capture_Hz, 1000000000};
  control::PulseSpeedState state;
  std::int64_t counted = ports.quarters();
  double told = 0.0;
  const auto tick = [&](double t) {
    const std::int64_t moved = ports.quarters() - counted;
    counted = ports.quarters();
    if (moved != 0 || t > 5e-3)
      control::pulse_edge(state, static_cast<std::int32_t>(moved),
                          static_cast<std::int8_t>(ports.edge_direction()), ports.edge_time());
    told = control::pulse_speed(config, state, static_cast<std::uint32_t>(t * capture_Hz));
  };
  for (int n = 0; n < 100; ++n) {
    if (n == 50) {
      EXPECT_NEAR(told, 300, 300 * 2 / (1e-4 * capture_Hz) + 1e-6);
      ports.stick_line(line_B, true, sim::to_instant(5e-3));
    }
    m.show(ports, n * 1e-4, (n + 1) * 1e-4);
    tick((n + 1) * 1e-4);
    if (n > 52) {
      ASSERT_EQ(told, 0.0) << n;
    }
  }
}

// The captured edges are edges of the line that is not stuck.
TEST(StuckLine, CapturesTheOtherLinesEdges) {
  constexpr std::int64_t lines = 500;
  for (const int line : {line_A, line_B}) {
    const Motion m{0.05, 120, 0};
    ShaftPorts ports = encoder(lines, m);
    ports.stick_line(line, false, sim::to_instant(0));
    for (int n = 1; n < 60; ++n) {
      m.show(ports, (n - 1) * 1e-4, n * 1e-4);
      const std::int64_t now = quarters(m, lines, n * 1e-4);
      // Line A changes at the beginning of quarters 0 and 2 of a line, line B at the beginning of quarters 1
      // and 3.
      const std::int64_t border = line == line_A ? now - (now % 2 == 0 ? 1 : 0) : now - now % 2;
      if (border <= quarters(m, lines, 0)) continue;
      const double at_s = (static_cast<double>(border) * 2 * base::pi / (4 * lines) - m.theta_0) / m.w;
      EXPECT_NEAR(ports.edge_time(), at_s * capture_Hz, 1.0) << n;
    }
  }
}

int indexes(ShaftPorts& ports, const Motion& m, double from_s, double to_s) {
  int passed = 0;
  for (double t = from_s; t < to_s - 1e-6; t += 1e-4) {
    m.show(ports, t, t + 1e-4);
    passed += ports.index_passed();
  }
  return passed;
}

TEST(StuckIndex, IsLostUntilItIsWhole) {
  const Motion m{0.5, 100, 0};  // the angle passes 2 pi at 57.8 ms and then one turn every 62.8 ms
  for (const bool high : {false, true}) {
    ShaftPorts ports = encoder(500, m);
    EXPECT_EQ(indexes(ports, m, 0, 0.1), 1);
    ports.stick_line(line_Z, high, sim::to_instant(0.1));
    EXPECT_EQ(ports.index_passed(), high) << "where Z rises by that, the timer takes it for the index";
    EXPECT_EQ(indexes(ports, m, 0.1, 0.3), 0) << "three were passed";
    ports.free_line(line_Z, sim::to_instant(0.3));
    EXPECT_EQ(indexes(ports, m, 0.3, 0.4), 2);
    EXPECT_EQ(ports.since_index(), quarters(m, 500, 0.4) % 2000);
    EXPECT_EQ(ports.quarters(), quarters(m, 500, 0.4)) << "A and B count as ever";
  }
}

TEST(FalseIndex, LatchesTheCountAtAWrongPlace) {
  const Motion m{0.5, 100, 0};
  ShaftPorts ports = encoder(500, m);
  m.show(ports, 0, 0.02);
  ports.pulse_index();
  EXPECT_TRUE(ports.index_passed());
  EXPECT_EQ(ports.since_index(), 0);
  m.show(ports, 0.02, 0.03);
  EXPECT_FALSE(ports.index_passed());
  EXPECT_EQ(ports.since_index(), quarters(m, 500, 0.03) - quarters(m, 500, 0.02));
  // A line Z that is stuck, high or low, has no rising pulse.
  ports.stick_line(line_Z, true, sim::to_instant(0.03));
  EXPECT_TRUE(ports.index_passed());
  ports.pulse_index();
  EXPECT_FALSE(ports.index_passed());
  ports.stick_line(line_Z, false, sim::to_instant(0.03));
  ports.pulse_index();
  EXPECT_FALSE(ports.index_passed());
}

TEST(AbsolutePort, ATrackIsWholeAgain) {
  const Motion m{0.3, 0, 0};
  ShaftPorts ports({.kind = rig::ShaftSensor::absolute, .absolute = {.bits = 16}}, capture_Hz, 0, m.shaft(0));
  const std::uint32_t whole = ports.code();
  for (int bit = 0; bit < 16; ++bit) {
    ports.stick_track(bit, (whole >> bit & 1) == 0);
    EXPECT_EQ(ports.code(), whole ^ 1u << bit);
    ports.free_track(bit);
    EXPECT_EQ(ports.code(), whole);
  }
}

// The voltages of the cosine and sine windings are proportional to the excitation. The voltage of a broken
// winding is zero. After the repair, both voltages have their full amplitude.
TEST(ResolverPort, ShowsThePartOfItsExcitation) {
  const Motion m{0.7, 0, 0};
  ShaftPorts ports({.kind = rig::ShaftSensor::resolver,
                    .resolver = {.pole_pairs = 2, .amplitude_V = 2.0, .excitation_Hz = 10e3}},
                   capture_Hz, 0, m.shaft(0));
  int n = 0;
  const auto shows = [&](double cosine, double sine) {
    const auto counts =
        ports.resolver_counts(m.shaft(0), sim::to_instant(n * 50e-6), static_cast<std::uint64_t>(n));
    const double sign = n++ % 2 == 0 ? 1 : -1, lsb = 2 * 2.5 / 4096;
    EXPECT_NEAR(counts.cos, 2048 + sign * cosine * 2 * std::cos(1.4) / lsb, 0.51) << n;
    EXPECT_NEAR(counts.sin, 2048 + sign * sine * 2 * std::sin(1.4) / lsb, 0.51) << n;
  };
  for (const double part : {1.0, 0.4, 0.0, 1.2, 1.0}) {
    ports.excite(part);
    shows(part, part);
    shows(part, part);
  }
  ports.break_winding(1);
  shows(0, 1);
  ports.break_winding(2);
  shows(0, 0);
  ports.break_winding(0);
  shows(1, 1);
}

rig::ShaftSensorConfig converter() {
  rig::ShaftSensorConfig given{.kind = rig::ShaftSensor::resolver};
  given.resolver = {.amplitude_V = 1.0, .reading = rig::ResolverReading::tracking};
  const auto loop = design::tracking_loop(
      {.bandwidth_rad_s = 2 * base::pi * 1000, .damping = 1.0, .period_s = 1 / given.resolver.converter_Hz});
  given.tracking = design::tracking_config(*loop);
  return given;
}

void follow(ShaftPorts& ports, const Motion& m, double from_s, double to_s) {
  for (double t = from_s; t < to_s - 1e-6; t += 1e-4) m.show(ports, t, t + 1e-4, t + 1e-4);
}

double off_turns(const ShaftPorts& ports, double turns) {
  const double off = ports.converter().angle() * 0x1p-32 - turns;
  return off - std::floor(off + 0.5);
}

// The angle is computed from a ratio, so half the excitation gives the same angle. Without excitation there
// is no error signal, and the angle continues at its last speed.
TEST(ConverterChip, WithoutExcitationGoesOnAtItsSpeed) {
  const Motion m{0.4, 150, 0};
  ShaftPorts whole(converter(), capture_Hz, 0, m.shaft(0)), half = whole, none = whole;
  half.excite(0.5);
  follow(whole, m, 0, 0.02);
  follow(half, m, 0, 0.02);
  follow(none, m, 0, 0.02);
  EXPECT_EQ(whole.converter().angle(), half.converter().angle());
  none.excite(0.0);
  const Motion stopped{m.theta(0.02), 0, 0};
  follow(none, stopped, 0.02, 0.03);
  const double step = 150 / (2 * base::pi) / 500e3;
  EXPECT_NEAR(off_turns(none, m.theta(0.03) / (2 * base::pi)), 0, 0x1p-16 + step);
}

}  // namespace SIXSTEP_TEST_FILE
