// SPDX-License-Identifier: Apache-2.0
// The outputs of encoders and resolvers are recorded as columns of the trace and as logic lines. For the
// angle in the same row, they are equal to the equations of model.md 10 to the last digits. The edges are at
// the instants of a uniform rotation.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/logic.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;

constexpr double two_pi = 2 * base::pi, w = turned_rad_s, theta_0 = turned_from_rad;

Scenario turned(RotorSensing rotor) {
  Scenario s = turned_by(rotor, 0.04);
  s.sensors.encoder.lines = 500;
  s.sensors.absolute.bits = 13;
  s.sensors.resolver = {.pole_pairs = 2,
                        .amplitude_V = 1.7,
                        .excitation_Hz = 0.5 / s.pwm.period_s,
                        .imbalance = 0.03,
                        .quadrature_deg = 2,
                        .phase_deg = 8,
                        .sine_phase_deg = -5,
                        .noise_V = 1e-3,
                        .bandwidth_Hz = 500};
  return s;
}

template <class Look>
int for_each_row(const Scenario& s, Look&& look) {
  int rows = 0;
  const auto out = run(s, {.on_event = [&](Row row) {
                         const auto of = [&row](ColumnId id) { return row[static_cast<std::size_t>(id)]; };
                         ++rows;
                         look(of);
                       }});
  EXPECT_TRUE(out) << (out ? "" : base::to_string(out.problems()[0]));
  EXPECT_FALSE(out && out->fault);
  return rows;
}

/// Returns whether the angle is on a border between two counts. On a border, the last digit of theta
/// determines the count.
bool near_border(double parts) { return std::fabs(parts - std::floor(parts + 0.5)) < 1e-9; }

TEST(RawColumns, AnEncodersLinesAreThoseOfTheirEquation) {
  int borders = 0;
  const int rows = for_each_row(turned(RotorSensing::encoder), [&](auto of) {
    const double lines = 500 * of(ColumnId::angle) / two_pi, in_line = lines - std::floor(lines),
                 later = in_line < 0.25 ? in_line + 0.75 : in_line - 0.25;
    if (near_border(4 * lines)) return void(++borders);
    EXPECT_EQ(of(ColumnId::encoder_A), in_line < 0.5);
    EXPECT_EQ(of(ColumnId::encoder_B), later < 0.5);
    EXPECT_EQ(of(ColumnId::encoder_Z), std::fmod(lines, 500) < 1);
    EXPECT_EQ(of(ColumnId::resolver_cos_V), 0.0);
  });
  EXPECT_GT(rows, 1000);
  EXPECT_LT(borders, rows / 100);
}

TEST(RawColumns, AnAbsoluteCodeIsThatOfItsEquation) {
  for_each_row(turned(RotorSensing::absolute), [&](auto of) {
    const double turns = of(ColumnId::angle) / two_pi, counts = 8192 * (turns - std::floor(turns));
    if (near_border(counts)) return;
    const auto n = static_cast<unsigned>(counts);
    EXPECT_EQ(of(ColumnId::absolute_code), n ^ n >> 1);
  });
}

// If the drive samples, the peaks of the excitation are at the samples. If a converter chip generates the
// excitation, it starts at t = 0.
TEST(RawColumns, AResolversVoltagesAreThoseOfTheirEquations) {
  for (const auto reading : {rig::ResolverReading::sampled, rig::ResolverReading::tracking}) {
    Scenario s = turned(RotorSensing::resolver);
    s.sensors.resolver.reading = reading;
    const Resolver& r = s.sensors.resolver;
    constexpr double deg = base::pi / 180;
    const double quarter = reading == rig::ResolverReading::sampled ? base::pi / 2 : 0.0;
    double greatest = 0.0;
    for_each_row(s, [&](auto of) {
      if (of(ColumnId::t) == 0) return;
      const double carrier = two_pi * r.excitation_Hz * of(ColumnId::t) + quarter,
                   phi = 2 * of(ColumnId::angle);
      // A period of the excitation is 60 us, and the instant of a row is a whole number of picoseconds.
      const double tolerance = 1.7 * (two_pi * r.excitation_Hz * 1e-12 + 1e-11);
      EXPECT_NEAR(of(ColumnId::resolver_cos_V), 1.7 * std::sin(carrier + 8 * deg) * std::cos(phi), tolerance);
      EXPECT_NEAR(of(ColumnId::resolver_sin_V),
                  1.7 * 1.03 * std::sin(carrier - 5 * deg) * std::sin(phi + 2 * deg), 1.03 * tolerance);
      greatest = std::fmax(greatest, std::fabs(of(ColumnId::resolver_sin_V)));
    });
    EXPECT_GT(greatest, 1.5);
  }
}

TEST(RawColumns, StuckLinesAndLostExcitationAreSeenThere) {
  Scenario s = turned(RotorSensing::encoder);
  s.duration_s = 0.02;
  s.at.resize(1);
  s.at[0].time_s = 0.01;
  s.at[0].sensors.encoder_line = AtEncoderLine{EncoderLine::B, EncoderLevel::high};
  for_each_row(s, [&](auto of) {
    if (of(ColumnId::t) > 0.01) {
      ASSERT_EQ(of(ColumnId::encoder_B), 1.0);
    }
  });
  s = turned(RotorSensing::resolver);
  s.sensors.watched = false;
  s.at.resize(1);
  s.at[0].time_s = 0.01;
  s.at[0].sensors.excitation = 0.0;
  for_each_row(s, [&](auto of) {
    if (of(ColumnId::t) > 0.01) {
      ASSERT_EQ(of(ColumnId::resolver_cos_V), 0.0);
    }
  });
}

TEST(RawColumns, AreRecordedWhereTheSensorIsFitted) {
  const auto names = [](RotorSensing rotor) {
    std::string text;
    const auto columns = record_columns(turned(rotor));
    for (const Column& c : *columns)
      if (c.name.starts_with("encoder") || c.name.starts_with("absolute") || c.name.starts_with("resolver"))
        text += c.name + " ";
    return text;
  };
  EXPECT_EQ(names(RotorSensing::hall), "");
  EXPECT_EQ(names(RotorSensing::encoder), "encoder_A encoder_B encoder_Z ");
  EXPECT_EQ(names(RotorSensing::absolute), "absolute_code ");
  EXPECT_EQ(names(RotorSensing::resolver), "resolver_cos_V resolver_sin_V ");
}

// In the logic record, each edge has its own picosecond, not the picosecond of the next event. The edge is at
// theta_0 + w t = n 2 pi/(4 N), with N lines.
TEST(LogicLines, AnEncodersEdgesStandWhereTheShaftPassesThem) {
  const Scenario s = turned(RotorSensing::encoder);
  std::int64_t n = static_cast<std::int64_t>(std::floor(2000 * theta_0 / two_pi));
  unsigned last = 8;
  int edges = 0;
  const auto out = run(s, {.on_logic = [&](std::int64_t ps, std::span<const std::uint32_t> row) {
                         const auto of = [&row](LogicId id) { return row[static_cast<std::size_t>(id)]; };
                         EXPECT_EQ(of(LogicId::absolute_code), logic_unknown);
                         const unsigned pins = of(LogicId::encoder_A) << 2 | of(LogicId::encoder_B) << 1 |
                                               of(LogicId::encoder_Z);
                         if (pins != last && last != 8) {
                           ++edges;
                           ++n;
                           // The bound is one picosecond, plus the rounding of theta (1e-15 of a few rad)
                           // divided by w.
                           EXPECT_NEAR(static_cast<double>(ps),
                                       (static_cast<double>(n) * two_pi / 2000 - theta_0) / w * 1e12, 3);
                         }
                         last = pins;
                       }});
  ASSERT_TRUE(out);
  EXPECT_EQ(edges,
            std::floor(2000 * (theta_0 + w * s.duration_s) / two_pi) - std::floor(2000 * theta_0 / two_pi));
}

}  // namespace SIXSTEP_TEST_FILE
