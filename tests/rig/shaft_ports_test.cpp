// SPDX-License-Identifier: Apache-2.0
// Encoders and resolvers as peripherals of a board. The motion of the shaft has a closed form. The tests
// check the counts and the time of the last edge, the latch of an absolute code, and samples at the peaks of
// an excitation.
#include "sixstep/rig/shaft_ports.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/control/sensing/gray.hpp"
#include "sixstep/design/loops/tracking_loop.hpp"
#include "tests/support/turning_shaft.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using rig::ShaftPorts;
using sixstep::testing::Motion;

constexpr double capture_Hz = 1e9;

ShaftPorts encoder(int lines, const Motion& m) {
  return ShaftPorts({.kind = rig::ShaftSensor::encoder, .encoder = {.lines = lines}}, capture_Hz, 0,
                    m.shaft(0));
}

/// The number of passed quarter lines: floor(4 N theta/2 pi), with N lines per turn.
std::int64_t quarters(const Motion& m, std::int64_t lines, double t) {
  return static_cast<std::int64_t>(std::floor(4 * static_cast<double>(lines) * m.theta(t) / (2 * base::pi)));
}

TEST(EncoderPort, CountsAndCapturesTheLastEdge) {
  for (const double w : {3.0, -3.0, 250.0, -700.0}) {
    const Motion m{0.1234, w, 0};
    ShaftPorts ports = encoder(1000, m);
    m.show(ports, 0, 0.02);
    const std::int64_t n = quarters(m, 1000, 0.02);
    EXPECT_EQ(ports.quarters(), n);
    // The edge at which count n begins. Forward it is edge n, backward it is edge n + 1.
    const double border = static_cast<double>(w > 0 ? n : n + 1) * 2 * base::pi / 4000;
    EXPECT_NEAR(ports.edge_time(), (border - m.theta_0) / w * capture_Hz, 1.0) << w;
    EXPECT_EQ(ports.edge_direction(), w > 0 ? 1 : -1);
  }
}

// The rotor reverses at t = w/|a| (initial speed w, acceleration a). On the way back, it passes its last edge
// again.
TEST(EncoderPort, ARotorThatTurnsRoundPassesItsEdgesAgain) {
  const Motion m{0.5, 40, -8000};  // reverses at 5 ms, 0.1 rad further
  ShaftPorts ports = encoder(1000, m);
  m.show(ports, 0, 4.99e-3);
  EXPECT_EQ(ports.quarters(), quarters(m, 1000, 4.99e-3));
  m.show(ports, 4.99e-3, 7e-3);
  const std::int64_t n = quarters(m, 1000, 7e-3);
  EXPECT_EQ(ports.quarters(), n);
  EXPECT_EQ(ports.edge_direction(), -1);
  const double border = static_cast<double>(n + 1) * 2 * base::pi / 4000;
  // On the way back, the edge is passed at t = (w + sqrt(w^2 - 2 |a| (border - theta_0)))/|a|.
  const double t = (m.w + std::sqrt(m.w * m.w + 2 * m.a * (border - m.theta_0))) / -m.a;
  EXPECT_NEAR(ports.edge_time(), t * capture_Hz, 2.0);
}

TEST(EncoderPort, TellsOfItsIndexOnceATurn) {
  const Motion m{-0.05, 100, 0};
  ShaftPorts ports = encoder(500, m);
  int passed = 0;
  for (int n = 0; n < 2000; ++n) {  // 0.2 s at 100 rad/s: 20 rad from -0.05
    m.show(ports, n * 1e-4, (n + 1) * 1e-4);
    passed += ports.index_passed();
  }
  EXPECT_EQ(passed, 4) << "at 0, 2 pi, 4 pi and 6 pi";
}

// The counter misses 7 edges, so its count is 7 too low. The index then corrects the count since the index.
TEST(EncoderPort, MissesEdgesAndLatchesItsCountAtTheIndex) {
  for (const double w : {100.0, -100.0}) {
    const Motion m{w > 0 ? -0.05 : 0.05, w, 0};
    ShaftPorts ports = encoder(500, m);
    ports.miss(7);
    m.show(ports, 0, 4e-4);  // 12 edges
    const int way = w > 0 ? 1 : -1;
    EXPECT_EQ(ports.quarters(), quarters(m, 500, 4e-4) - 7 * way);
    EXPECT_FALSE(ports.index_passed());
    m.show(ports, 4e-4, 5e-3);
    EXPECT_EQ(ports.quarters(), quarters(m, 500, 5e-3) - 7 * way);
    EXPECT_TRUE(ports.index_passed());
    EXPECT_EQ(ports.since_index(), quarters(m, 500, 5e-3)) << "counted from theta = 0";
  }
}

// The missed edges are on both sides of the index. The count since the index lacks the edges that are missed
// after the index.
TEST(EncoderPort, EdgesMissedBehindTheIndexAreMissingFromItsCount) {
  const Motion m{-3.5 * 2 * base::pi / 2000, 100, 0};  // 4 edges to the index; the fourth is the edge of the
                                                       // index
  ShaftPorts ports = encoder(500, m);
  ports.miss(6);
  m.show(ports, 0, 1e-3);
  EXPECT_TRUE(ports.index_passed());
  EXPECT_EQ(ports.since_index(), quarters(m, 500, 1e-3) - 2);
}

TEST(EncoderPort, OnTheLoadsSideCountsTheLoad) {
  const Motion m{0.3, 170, 900};
  ShaftPorts ports(
      {.kind = rig::ShaftSensor::encoder, .on_load = true, .gear = 3.7, .encoder = {.lines = 1000}},
      capture_Hz, 0, rig::in_sixths(m.theta(0) / 3.7));
  m.show(ports, 0, 0.02, 1.0, 3.7, 0.01);
  const double turns = (m.theta(0.02) / 3.7 - 0.01) / (2 * base::pi);
  EXPECT_EQ(ports.quarters(), static_cast<std::int64_t>(std::floor(4000 * turns)));
}

TEST(AbsolutePort, ATrackSticks) {
  const Motion m{0.3, 0, 0};
  ShaftPorts ports({.kind = rig::ShaftSensor::absolute, .absolute = {.bits = 16}}, capture_Hz, 0, m.shaft(0));
  const std::uint32_t whole = ports.code();
  for (int bit = 0; bit < 16; ++bit) {
    ShaftPorts low = ports, high = ports;
    low.stick_track(bit, false);
    high.stick_track(bit, true);
    EXPECT_EQ(low.code(), whole & ~(1u << bit));
    EXPECT_EQ(high.code(), whole | 1u << bit);
  }
}

TEST(AbsolutePort, LatchesItsCodeBeforeItIsRead) {
  const Motion m{0.3, 200, 5000};
  for (const double latency_s : {0.0, 7e-6, 28e-6}) {
    ShaftPorts ports({.kind = rig::ShaftSensor::absolute, .absolute = {.bits = 16, .latency_s = latency_s}},
                     capture_Hz, 0, m.shaft(0));
    for (int n = 1; n < 200; ++n) {
      m.show(ports, (n - 1) * 30e-6, n * 30e-6, n * 30e-6);
      const double turns = m.theta(n * 30e-6 - latency_s) / (2 * base::pi);
      const auto code = static_cast<std::uint32_t>(std::floor((turns - std::floor(turns)) * 65536));
      ASSERT_EQ(control::binary_of_gray(ports.code(), 16), code) << n << " latency " << latency_s;
    }
  }
}

TEST(ResolverPort, IsSampledAtItsPeaks) {
  const Motion m{0.7, 0, 0};
  ShaftPorts ports({.kind = rig::ShaftSensor::resolver,
                    .resolver = {.pole_pairs = 2, .amplitude_V = 2.0, .excitation_Hz = 10e3}},
                   capture_Hz, 0, m.shaft(0));
  for (int n = 0; n < 6; ++n) {
    const auto counts =
        ports.resolver_counts(m.shaft(0), sim::to_instant(12e-6 + n * 50e-6), static_cast<std::uint64_t>(n));
    const double sign = n % 2 == 0 ? 1 : -1, lsb = 2 * 2.5 / 4096;
    EXPECT_NEAR(counts.cos, 2048 + sign * 2 * std::cos(1.4) / lsb, 0.51) << n;
    EXPECT_NEAR(counts.sin, 2048 + sign * 2 * std::sin(1.4) / lsb, 0.51) << n;
  }
}

// If a winding's voltage leads the excitation by the angle d, its sample at a peak of the excitation is the
// amplitude times cos d.
TEST(ResolverPort, ShowsWhatItsWindingsAreUnlikeBy) {
  constexpr double rad = 180 / base::pi;
  const rig::Resolver r{.amplitude_V = 1.5,
                        .excitation_Hz = 10e3,
                        .imbalance = 0.04,
                        .quadrature_deg = 0.03 * rad,
                        .phase_deg = 0.2 * rad,
                        .sine_phase_deg = -0.35 * rad};
  const double lsb = 2 * 1.25 * 1.5 / 4096;
  for (const double theta : {0.0, 0.4, 1.3, 2.9, 4.0, 5.5}) {
    const Motion m{theta, 0, 0};
    ShaftPorts ports({.kind = rig::ShaftSensor::resolver, .resolver = r}, capture_Hz, 0, m.shaft(0));
    for (int n = 0; n < 4; ++n) {
      const auto counts =
          ports.resolver_counts(m.shaft(0), sim::to_instant(7e-6 + n * 50e-6), static_cast<std::uint64_t>(n));
      const double sign = n % 2 == 0 ? 1 : -1;
      EXPECT_NEAR(counts.cos, 2048 + sign * 1.5 * std::cos(0.2) * std::cos(theta) / lsb, 0.51) << theta;
      EXPECT_NEAR(counts.sin, 2048 + sign * 1.5 * 1.04 * std::cos(0.35) * std::sin(theta + 0.03) / lsb, 0.51)
          << theta;
    }
    const auto envelope = plant::resolver_envelope(rig::windings_of(r), m.shaft(0));
    EXPECT_NEAR(envelope[0], std::cos(theta), 4e-11);
    EXPECT_NEAR(envelope[1], 1.04 * std::sin(theta + 0.03), 4e-11);
  }
}

TEST(ResolverPort, IsAsNoisyAsItIsSaidToBeAndTheSeedsOwn) {
  const Motion m{0.7, 0, 0};
  const double lsb = 2 * 2.5 / 4096, noise_V = 10 * lsb;
  const rig::ShaftSensorConfig given{.kind = rig::ShaftSensor::resolver,
                                     .resolver = {.amplitude_V = 2.0, .noise_V = noise_V}};
  ShaftPorts one(given, capture_Hz, 1, m.shaft(0)), same(given, capture_Hz, 1, m.shaft(0)),
      other(given, capture_Hz, 2, m.shaft(0));
  constexpr int samples = 4000;
  double square = 0.0, product = 0.0;
  int alike = 0;
  for (int n = 0; n < samples; ++n) {
    const auto read = [&](ShaftPorts& ports) {
      return ports.resolver_counts(m.shaft(0), sim::to_instant(n * 100e-6), static_cast<std::uint64_t>(n));
    };
    const auto a = read(one), b = read(same), c = read(other);
    EXPECT_TRUE(a.cos == b.cos && a.sin == b.sin);
    alike += a.cos == c.cos;
    const double x = a.cos - 2048 - 2 * std::cos(0.7) / lsb, y = a.sin - 2048 - 2 * std::sin(0.7) / lsb;
    square += (x * x + y * y) / 2;
    product += x * y;
  }
  // Rounding to counts adds 1/12 to the variance. From 8000 values, the deviation is accurate to 0.8 %. From
  // 4000 products, the mean is accurate to 1/63.
  const double wanted = 100 + 1.0 / 12;
  EXPECT_NEAR(std::sqrt(square / samples / wanted), 1, 5 * 0.008);
  EXPECT_NEAR(product / samples / wanted, 0, 5.0 / 63) << "the windings' noise is each one's own";
  EXPECT_LT(alike, samples / 10);
}

constexpr double clock_Hz = 500e3;

rig::ShaftSensorConfig converter(int bits, double latency_s = 0.0) {
  rig::ShaftSensorConfig given{.kind = rig::ShaftSensor::resolver};
  given.resolver = {.pole_pairs = 2,
                    .bits = bits,
                    .reading = rig::ResolverReading::tracking,
                    .converter_Hz = clock_Hz,
                    .latency_s = latency_s};
  const auto loop = design::tracking_loop(
      {.bandwidth_rad_s = 2 * base::pi * 1000, .damping = 1.0, .period_s = 1 / clock_Hz});
  given.tracking = design::tracking_config(*loop);
  return given;
}

/// The chip's angle minus p_r theta(t), in turns, between -1/2 and 1/2 (p_r: pole pairs of the resolver).
double off_turns(const ShaftPorts& ports, const Motion& m, double t) {
  const double turns = 2 * m.theta(t) / (2 * base::pi);
  const double off = ports.converter().angle() * 0x1p-32 - turns;
  return off - std::floor(off + 0.5);
}

// At constant speed, a loop of type 2 has no lag at its clocks. Two errors remain: the angle is rounded down
// to a count, and the integrator rounds the speed by 2^-48 turn, which is divided by K_i.
TEST(ConverterChip, FollowsASteadyShaftToItsCount) {
  for (const int bits : {10, 12, 14, 16})
    for (const double w : {0.0, 150.0, -400.0}) {
      const Motion m{0.4, w, 0};
      ShaftPorts ports(converter(bits), capture_Hz, 0, m.shaft(0));
      for (int n = 0; n < 300; ++n) m.show(ports, n * 100e-6, (n + 1) * 100e-6, (n + 1) * 100e-6);
      const double off = off_turns(ports, m, 0.03);
      EXPECT_GT(off, -std::ldexp(1.0, -bits) - 1e-6) << bits << " bits at " << w;
      EXPECT_LT(off, 1e-6) << bits << " bits at " << w;
      EXPECT_NEAR(ports.converter().speed() * 0x1p-32 * clock_Hz * base::pi, w, 1e-3 * std::fabs(w) + 1e-2);
    }
}

// The lag is constant. It is the acceleration divided by the loop's acceleration constant K_a.
TEST(ConverterChip, LagsAnAccelerationByItOverKa) {
  const Motion m{0.1, 0, 40000};
  ShaftPorts ports(converter(16), capture_Hz, 0, m.shaft(0));
  for (int n = 0; n < 50; ++n) m.show(ports, n * 100e-6, (n + 1) * 100e-6, (n + 1) * 100e-6);
  const auto loop = design::tracking_loop(
      {.bandwidth_rad_s = 2 * base::pi * 1000, .damping = 1.0, .period_s = 1 / clock_Hz});
  const double lag_turns = 2 * m.a / (2 * base::pi) / loop->K_a_per_s2;
  const double step = 2 * m.a * 0.005 / (2 * base::pi) / clock_Hz;
  EXPECT_GT(step, 5 * 0x1p-16) << "a clock's way is told from the count it rounds down to";
  const double off = off_turns(ports, m, 0.005);
  EXPECT_LT(off, -lag_turns + 1e-6);
  EXPECT_GT(off, -lag_turns - 0x1p-16 - 1e-6);
}

// Between two clocks the chip shows the angle of the earlier clock.
TEST(ConverterChip, HoldsTheAngleOfItsLastClock) {
  const Motion m{0.4, 300, 0};
  ShaftPorts ports(converter(16), capture_Hz, 0, m.shaft(0));
  for (int n = 0; n < 100; ++n) m.show(ports, n * 100e-6, (n + 1) * 100e-6, (n + 1) * 100e-6);
  const double t = 0.01 + 0.7 / clock_Hz;
  m.show(ports, 0.01, t, t);
  const double behind = 2 * m.w * 0.7 / clock_Hz / (2 * base::pi);
  EXPECT_NEAR(off_turns(ports, m, t), -behind, 0x1p-16);
}

TEST(ConverterChip, IsReadAsItWasLatched) {
  const Motion m{0.4, 300, 0};
  ShaftPorts now(converter(16), capture_Hz, 0, m.shaft(0)),
      late(converter(16, 40e-6), capture_Hz, 0, m.shaft(0));
  for (int n = 0; n < 100; ++n) {
    m.show(now, n * 100e-6, (n + 1) * 100e-6, (n + 1) * 100e-6);
    m.show(late, n * 100e-6, (n + 1) * 100e-6, (n + 1) * 100e-6);
  }
  const double behind = 2 * m.w * 40e-6 / (2 * base::pi), step = 2 * m.w / (2 * base::pi) / clock_Hz;
  EXPECT_NEAR(off_turns(now, m, 0.01) - off_turns(late, m, 0.01), behind, 0x1p-16 + step);
}

// Without the cosine winding, the chip can determine only the sign of the sine.
TEST(ConverterChip, WithoutItsCosineSaysAQuarterOfATurn) {
  for (const double theta : {0.2, 0.7, 1.2}) {  // p_r theta is below half a turn
    const Motion m{theta, 0, 0};
    ShaftPorts ports(converter(16), capture_Hz, 0, m.shaft(0));
    ports.break_winding(1);
    for (int n = 0; n < 200; ++n) m.show(ports, n * 100e-6, (n + 1) * 100e-6, (n + 1) * 100e-6);
    EXPECT_NEAR(ports.converter().angle() * 0x1p-32, 0.25, 2 * 0x1p-16) << theta;
  }
}

}  // namespace SIXSTEP_TEST_FILE
