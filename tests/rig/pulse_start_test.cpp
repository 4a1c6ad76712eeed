// SPDX-License-Identifier: Apache-2.0
// Pulses find the rotor's angle on the virtual board, with two motors. The wheel hub motor has two
// inductances in its sheet, and iron that saturates. The motor 251601 has a rotor whose angle pulses cannot
// find.
#include <cstdio>
#include <random>

#include "tests/support/in_part.hpp"
#include "tests/support/sensorless.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::PulsePositionReading;
using control::SensorlessPhase;

using PulsedRig = rig::Rig<double, rig::SensorlessDrive<double>, plant::general::Plant<double>>;

struct PulseBench {
  SensorlessBench base;
  plant::general::Machine machine;
  double noise_A = 0.0;
  int pulse_ticks = 4;

  explicit PulseBench(const SensorlessMotor& from) : base(from) {
    const plant::Machine& m = base.motor.machine;
    machine = {.R_ohm = {m.R_ohm, m.R_ohm, m.R_ohm},
               .K_e_V_s = {m.K_e_V_s, m.K_e_V_s, m.K_e_V_s},
               .L_H = m.L_H,
               .pole_pairs = m.pole_pairs};
    machine.shape.flat_deg = m.flat_deg;
    if (m.back_emf == plant::BackEmf::sine) machine.shape.harmonics = {{1, 1.0}};
  }
  /// Sets the angle theta_e of the rotor at rest, in electrical degrees.
  void stand_at(double electrical_deg) {
    base.at.angle_rad = electrical_deg * base::pi / 180 / machine.pole_pairs;
  }
  PulsedRig rig(double range_A) const {
    control::PulsedDriveConfig<double> chip{.drive = base.chip};
    chip.pulses.current = {.offset_counts = 2048, .offset_tolerance = 256};
    chip.pulses.pulse_ticks = static_cast<std::uint16_t>(pulse_ticks);
    chip.pulses.rest_ticks = static_cast<std::uint16_t>(2 * pulse_ticks);
    rig::BoardConfig board = base.board;
    board.sensors.current = {.bits = 12, .range = range_A, .offset = 0.01 * range_A, .noise = noise_A};
    const plant::general::Shaft shaft{.J_kg_m2 = base.motor.shaft.J_kg_m2, .B_Nm_s = base.motor.shaft.B_Nm_s};
    return PulsedRig({machine,
                      shaft,
                      {},
                      {.V_0_V = base.spec.bus_V},
                      {.angle_rad = base.at.angle_rad, .bus_V = base.spec.bus_V}},
                     chip, board, base.timeline);
  }
};

PulseBench hub() {
  PulseBench bench(three_motors[2]);
  bench.machine.L_d_H = 520e-6;
  bench.machine.L_q_H = 650e-6;
  bench.machine.saturation_A = 40.0;
  bench.base.setpoint(0, 0.3 * bench.base.no_load_rad_s());
  return bench;
}

/// Runs until the pulses have ended. Returns their result.
PulsePositionReading found(PulsedRig& rig) {
  bool began = false;
  const double t = run_until_true(rig, 2.0, 0.25e-3, [&] {
    began = began || rig.firmware().start().pulsing;
    return began && !rig.firmware().start().pulsing;
  });
  EXPECT_GT(t, 0.0);
  return rig.firmware().start().found;
}

double off_deg(const PulsePositionReading& reading, double electrical_deg) {
  return std::remainder(reading.electrical * (360.0 / 4294967296.0) - electrical_deg, 360.0);
}

/// The error of the finer angle x has two parts, noise and saturation. The second harmonic depends on 2 x,
/// and its two components have equal noise. The noise of 2 x is 1/(signal to noise) rad, and the noise of x
/// is half of this. With m = L_d I/(2 I_sat L_S), saturation contributes m/4 times 3 m/8, divided by L_D/L_S.
/// The bound contains five times the noise, because it applies to a hundred angles.
TEST(PulseStart, SeesARotorThatIsSalientAndSaturatesAtAnyAngle) {
  const unsigned seed = 20'261'123;
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> angle(0.0, 360.0);
  double worst = 0;
  int beyond_edges = 0;
  for (int n = 0; n < 100; n += one_in) {
    PulseBench bench = hub();
    bench.noise_A = 0.02;
    const double deg = angle(draw);
    bench.stand_at(deg);
    auto rig = bench.rig(25.0);
    const PulsePositionReading reading = found(rig);
    ASSERT_TRUE(reading.seen) << deg << " of seed " << seed;
    EXPECT_TRUE(reading.axis_seen) << deg;
    const double off = off_deg(reading, deg);
    worst = std::fmax(worst, std::fabs(off));
    const double I_A = rig.firmware().start().pulses.sum[0] / (16.0 * 8) * 25.0 / 2048;
    const double m = 520e-6 * I_A * 2 / std::sqrt(3.0) / (2 * 40.0 * 585e-6), saliency = 65.0 / 585.0;
    const double allowed_deg = (5 * 16.0 / reading.axis_16 + m * m * 3 / 32 / saliency) / 2 * 180 / base::pi;
    EXPECT_LT(std::fabs(off), allowed_deg) << deg;
    // The sector is right if the rotor's distance from the nearest edge exceeds the error.
    const double into = std::fmod(deg, 60.0);
    if (reading.sector == static_cast<int>(deg / 60)) continue;
    ++beyond_edges;
    EXPECT_LT(std::fmin(into, 60.0 - into), std::fabs(off) + 1e-6) << deg;
  }
  std::printf(
      "100 rotor angles: north right in all, %d beyond an edge of its sector, worst angle off by %.2f degrees\n",
      beyond_edges, worst);
}

/// After the pulses, the drive starts without an alignment, in both directions.
TEST(PulseStart, StartsFromTheSectorThatItSaw) {
  for (const double sign : {1.0, -1.0})
    for (const double deg : {5.0, 83.0, 160.0, 239.0, 301.0}) {
      PulseBench bench = hub();
      bench.base.timeline.clear();
      const double w = sign * 0.3 * bench.base.no_load_rad_s();
      bench.base.setpoint(0, w);
      bench.stand_at(deg);
      auto rig = bench.rig(25.0);
      ASSERT_TRUE(found(rig).seen);
      EXPECT_EQ(phase(rig), SensorlessPhase::ramping);
      EXPECT_LE(std::abs(ahead(rig)), 1);
      const double t = run_until_true(rig, 4.0, 5e-3, [&] {
        return phase(rig) == SensorlessPhase::running &&
               std::fabs(rig.plant().state().w - w) < 0.05 * std::fabs(w);
      });
      EXPECT_GT(t, 0.0) << sign << " " << deg;
      EXPECT_EQ(rig.firmware().rotor().lock.last, control::LockLoss::none) << sign << " " << deg;
      std::printf("from %3.0f degrees %s: up to speed after %.2f s\n", deg, sign > 0 ? "forward" : "backward",
                  t);
    }
}

/// Pulses cannot detect a round rotor, with or without noise. The drive reports this, aligns the rotor and
/// starts.
TEST(PulseStart, RefusesTheRound251601AndAlignsIt) {
  for (const double noise_counts : {0.0, 1.0})
    for (int n = 0; n < 12; ++n) {
      PulseBench bench(three_motors[0]);
      bench.base.setpoint(0, 0.3 * bench.base.no_load_rad_s());
      bench.noise_A = noise_counts * 10.24 / 2048;
      bench.stand_at(13.0 + 30.0 * n);
      auto rig = bench.rig(10.24);
      const PulsePositionReading reading = found(rig);
      EXPECT_FALSE(reading.seen) << n;
      EXPECT_EQ(phase(rig), SensorlessPhase::aligning);
      if (n > 1) continue;
      EXPECT_GT(run_until_true(rig, 4.0, 5e-3, [&] { return phase(rig) == SensorlessPhase::running; }), 0.0);
    }
}

}  // namespace SIXSTEP_TEST_FILE
