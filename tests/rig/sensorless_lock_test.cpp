// SPDX-License-Identifier: Apache-2.0
// Tests the losses of the rotor and their names, rotors that already spin at the start, and Hall probes as a
// second source of the angle.
#include "tests/support/sensorless.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::LockLoss;
using control::SensorlessPhase;

TEST(Sensorless, CatchesASpinningRotor) {
  for (const SensorlessMotor& motor : three_motors)
    for (const double part : {0.1, 0.5, 0.9, -0.1, -0.5, -0.9}) {
      SensorlessBench bench(motor);
      bench.at.speed_rad_s = part * bench.no_load_rad_s();
      bench.at.angle_rad = 1.0;
      // Soft chopping cannot limit a braking current near the no-load speed. At 0.9 of the no-load speed, the
      // setpoint is therefore the speed of the rotor. At the other speeds, the setpoint is lower, so that the
      // drive brakes.
      bench.setpoint(0, (std::fabs(part) > 0.8 ? 1.0 : 0.6) * part * bench.no_load_rad_s());
      auto rig = bench.rig();
      const double listen_s = bench.start.rotor.spin.listen_ticks / bench.spec.capture_Hz;
      const double t = run_until_true(rig, 4 * listen_s, 0.1e-3, [&] {
        return phase(rig) != SensorlessPhase::catching && phase(rig) != SensorlessPhase::off;
      });
      EXPECT_EQ(phase(rig), SensorlessPhase::running) << motor.name << " " << part;
      EXPECT_GT(t, 0);
      EXPECT_EQ(wrong_looks(rig, t + 0.1, 0.3e-3), 0) << motor.name << " " << part;
    }
}

TEST(Sensorless, BrakesARotorThatSpinsTheOtherWayAndTurnsItRound) {
  for (const SensorlessMotor& motor : three_motors) {
    SensorlessBench bench(motor);
    bench.load_part = 0.1;
    bench.at.speed_rad_s = -0.4 * bench.no_load_rad_s();
    const double w = 0.3 * bench.no_load_rad_s();
    bench.setpoint(0, w);
    auto rig = bench.rig();
    const double t = run_until_true(rig, 6.0, 1e-3, [&] {
      return phase(rig) == SensorlessPhase::running && rig.plant().state().w > 0.9 * w;
    });
    EXPECT_GT(t, 0) << motor.name;
  }
}

/// A loss of the rotor after a cause: the name of the loss, and the number of commutations from the cause to
/// the loss.
struct Lost {
  LockLoss named = LockLoss::none;
  int commutations = 0;
  double sectors = 0.0;  ///< time from the cause to the loss, in sectors
};

template <class Firmware = rig::SensorlessDrive<double>>
Lost lost(SensorlessBench bench, double cause_s) {
  auto rig = bench.template rig<Firmware>();
  run_until(rig, cause_s);
  EXPECT_EQ(phase(rig), SensorlessPhase::running);
  const std::int32_t before = rig.firmware().rotor().position.sectors;
  const double sector_s =
      base::sector_rad / (bench.motor.machine.pole_pairs * std::fabs(rig.plant().state().w));
  std::int32_t last = before;
  const double t = run_until_true(rig, cause_s + 0.3, bench.spec.period_s, [&] {
    if (phase(rig) != SensorlessPhase::running) return true;
    last = rig.firmware().rotor().position.sectors;
    return false;
  });
  EXPECT_GT(t, 0);
  EXPECT_FALSE(rig.modulator().command().enabled) << "the bridge is off";
  return {rig.firmware().rotor().lock.last, std::abs(last - before), (t - cause_s) / sector_s};
}

constexpr double cause_s = 1.9;

TEST(Sensorless, ABlockedRotorIsSeenWithinTwoCommutations) {
  for (const SensorlessMotor& motor : three_motors) {
    SensorlessBench bench(motor);
    bench.setpoint(0, 0.5 * bench.no_load_rad_s());
    bench.act(cause_s, rig::ActionKind::shaft_locked, 1);
    const Lost l = lost(bench, cause_s);
    EXPECT_EQ(l.named, LockLoss::masked_crossing) << motor.name;
    EXPECT_LE(l.commutations, 2) << motor.name;
    EXPECT_LE(l.sectors, 4.0) << motor.name;
  }
}

TEST(Sensorless, ALoadThatTurnsTheRotorBackIsSeenWithinTwoCommutations) {
  for (const SensorlessMotor& motor : three_motors) {
    SensorlessBench bench(motor);
    bench.setpoint(0, 0.2 * bench.no_load_rad_s());
    bench.act(cause_s, rig::ActionKind::load_torque, 10 * bench.nominal_A() * bench.motor.K_t_Nm_A);
    auto rig = bench.rig();
    run_until(rig, cause_s);
    // While the rotor turns forward, the drive may follow it. After the rotor's reversal, the drive may
    // commutate at most twice.
    ASSERT_GT(
        run_until_true(rig, cause_s + 0.3, bench.spec.period_s, [&] { return rig.plant().state().w <= 0; }),
        0);
    const std::int32_t before = rig.firmware().rotor().position.sectors;
    std::int32_t last = before;
    ASSERT_GT(run_until_true(rig, cause_s + 0.6, bench.spec.period_s,
                             [&] {
                               if (phase(rig) == SensorlessPhase::running)
                                 last = rig.firmware().rotor().position.sectors;
                               return phase(rig) != SensorlessPhase::running;
                             }),
              0);
    EXPECT_LE(std::abs(last - before), 2) << motor.name;
    EXPECT_NE(rig.firmware().rotor().lock.last, LockLoss::none) << motor.name;
  }
}

/// A drive whose divider of leg b breaks at `cause_s`.
struct BrokenDivider : rig::SensorlessDrive<double> {
  using rig::SensorlessDrive<double>::SensorlessDrive;
  template <class Real>
  const Command& tick(const rig::SampleInstant<Real>& instant, double setpoint) {
    if (instant.at >= sim::to_instant(cause_s)) break_divider(1);
    return rig::SensorlessDrive<double>::tick(instant, setpoint);
  }
};

TEST(Sensorless, ADividerThatDiesIsNamed) {
  for (const SensorlessMotor& motor : three_motors) {
    SensorlessBench bench(motor);
    bench.setpoint(0, 0.5 * bench.no_load_rad_s());
    const Lost l = lost<BrokenDivider>(bench, cause_s);
    EXPECT_TRUE(l.named == LockLoss::terminals || l.named == LockLoss::long_demagnetisation ||
                l.named == LockLoss::masked_crossing)
        << motor.name << int(l.named);
    EXPECT_LE(l.commutations, 3) << motor.name;
  }
}

TEST(Sensorless, GivesUpAfterSoManyLossesAndIsClearedBySettingNothing) {
  SensorlessBench bench(three_motors[0]);
  bench.setpoint(0, 0.5 * bench.no_load_rad_s());
  bench.act(0, rig::ActionKind::shaft_locked, 1);
  const double t_clear = 4.0;
  bench.setpoint(t_clear, 0);
  bench.act(t_clear + 0.01, rig::ActionKind::shaft_locked, 0);
  bench.setpoint(t_clear + 0.02, 0.5 * bench.no_load_rad_s());
  auto rig = bench.rig();
  run_until(rig, t_clear - 0.01);
  EXPECT_EQ(phase(rig), SensorlessPhase::gave_up);
  EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::start);
  EXPECT_FALSE(rig.modulator().command().enabled);
  run_until(rig, t_clear + 1.0);
  EXPECT_EQ(phase(rig), SensorlessPhase::running);
}

/// A bench with Hall probes. Its drive starts with the rotor source `source`.
SensorlessBench with_probes(const SensorlessMotor& motor, control::RotorSource source) {
  SensorlessBench bench(motor);
  bench.chip.source = {.has_hall = true, .wanted = source};
  bench.setpoint(0, 0.4 * bench.no_load_rad_s());
  return bench;
}

/// Changes the rotor source of the chip at the time t_s.
void choose(SensorlessBench& bench, rig::Rig<double, rig::SensorlessDrive<double>>::Tunings& tunings,
            double t_s, control::RotorSource source) {
  tunings.push_back({{.drive = bench.chip}, 1.0});
  tunings.back().config.drive.source.wanted = source;
  bench.act(t_s, rig::ActionKind::retune, static_cast<double>(tunings.size() - 1));
}

/// The smallest and the largest speed until `to_s`.
template <class Rig>
std::pair<double, double> speeds(Rig& rig, double to_s, double every_s) {
  double low = rig.plant().state().w, high = low;
  sim::NoObserver none;
  for (double t = rig.now().seconds() + every_s; t < to_s; t += every_s) {
    EXPECT_EQ(sim::run(rig, sim::to_instant(t), none).stop, sim::Stop::end);
    low = std::fmin(low, rig.plant().state().w);
    high = std::fmax(high, rig.plant().state().w);
  }
  return {low, high};
}

TEST(Sensorless, HandsOverFromHallToBackEmfAndBackInFlight) {
  for (const SensorlessMotor& motor : three_motors) {
    SensorlessBench bench = with_probes(motor, control::RotorSource::hall);
    bench.load_part = 0.1;
    rig::Rig<double, rig::SensorlessDrive<double>>::Tunings tunings;
    choose(bench, tunings, 1.0, control::RotorSource::back_emf);
    choose(bench, tunings, 1.2, control::RotorSource::hall);
    rig::Rig<double, rig::SensorlessDrive<double>> rig(bench.plant(), {.drive = bench.chip}, bench.board,
                                                       bench.timeline, tunings);
    run_until(rig, 0.99);
    EXPECT_EQ(phase(rig), SensorlessPhase::following) << motor.name;
    const double w = rig.plant().state().w;
    EXPECT_NEAR(w, 0.4 * bench.no_load_rad_s(), 0.05 * w);
    const auto [low, high] = speeds(rig, 1.1, 1e-4);
    EXPECT_EQ(rig.firmware().source().source, control::RotorSource::back_emf) << motor.name;
    EXPECT_EQ(wrong_looks(rig, 1.19, 1e-4), 0) << motor.name;
    EXPECT_GT(low, 0.97 * w) << motor.name;
    EXPECT_LT(high, 1.03 * w) << motor.name;
    const auto [low_back, high_back] = speeds(rig, 1.3, 1e-4);
    EXPECT_EQ(rig.firmware().source().source, control::RotorSource::hall) << motor.name;
    EXPECT_GT(low_back, 0.97 * w) << motor.name;
    EXPECT_LT(high_back, 1.03 * w) << motor.name;
    EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none) << motor.name;
  }
}

TEST(Sensorless, GoesOnWithoutTheProbesWhereALineDies) {
  for (const SensorlessMotor& motor : three_motors)
    for (const double line : {1.0, 2.0, 3.0})
      for (const double level : {1.0, -1.0}) {
        SensorlessBench bench = with_probes(motor, control::RotorSource::hall);
        bench.load_part = 0.1;
        bench.act(1.0, rig::ActionKind::hall_stuck, level * line);
        auto rig = bench.rig();
        run_until(rig, 0.999);
        ASSERT_EQ(rig.firmware().source().source, control::RotorSource::hall);
        const double w = rig.plant().state().w;
        const auto [low, high] = speeds(rig, 1.3, 2e-4);
        EXPECT_EQ(rig.firmware().source().source, control::RotorSource::back_emf);
        EXPECT_EQ(phase(rig), SensorlessPhase::running)
            << motor.name << " line " << line << " level " << level;
        EXPECT_LE(std::abs(ahead(rig)), 1);
        EXPECT_GT(low, 0.9 * w) << motor.name << " line " << line << " level " << level;
        EXPECT_LT(high, 1.1 * w) << motor.name << " line " << line << " level " << level;
      }
}

TEST(Sensorless, TheGeneralKernelShowsTheSameTerminals) {
  SensorlessBench bench(three_motors[0]);
  bench.setpoint(0, 0.3 * bench.no_load_rad_s());
  bench.at.angle_rad = 0.3;
  const plant::Machine& m = bench.motor.machine;
  const plant::Shaft s = bench.shaft();
  const plant::general::Plant<double> plant(
      {.R_ohm = {m.R_ohm, m.R_ohm, m.R_ohm},
       .K_e_V_s = {m.K_e_V_s, m.K_e_V_s, m.K_e_V_s},
       .L_H = m.L_H,
       .pole_pairs = m.pole_pairs},
      {.J_kg_m2 = s.J_kg_m2, .B_Nm_s = s.B_Nm_s, .coulomb_Nm = s.coulomb_Nm}, {}, {.V_0_V = 24},
      {.angle_rad = 0.3, .bus_V = 24});
  rig::Rig<double, rig::SensorlessDrive<double>, plant::general::Plant<double>> general(
      plant, {.drive = bench.chip}, bench.board, bench.timeline);
  auto lean = bench.rig();
  run_until(general, 0.45);
  run_until(lean, 0.45);
  EXPECT_EQ(phase(general), SensorlessPhase::running);
  EXPECT_NEAR(general.plant().state().w, lean.plant().state().w, 0.01 * lean.plant().state().w);
}

}  // namespace SIXSTEP_TEST_FILE
