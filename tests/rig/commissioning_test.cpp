// SPDX-License-Identifier: Apache-2.0
// Commissioning on the virtual board finds the parameters of three motors of the motor library.
#include "tests/support/commissioning.hpp"
#include "tests/support/in_part.hpp"

#include <cstdio>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::CommissioningFault;
using control::CommissioningPhase;
using control::HallSurvey;
using rig::WireOrder;

control::Commissioned<double> in_si(const CommissioningBench& bench,
                                    const control::CommissioningState& found) {
  return control::commissioned<double>(control::commissioning_scale<double>(bench.facts), found);
}

/// The relative errors that the rounding of the converters allows (level_steps.hpp, flux_turn.hpp).
struct Allowed {
  double R, L, flux;

  Allowed(const CommissioningBench& bench, const control::CommissioningState& found) {
    const double apart = (found.winding.higher - found.winding.lower) / 24.0;
    const double bus = 0.5 * bench.facts.V_per_count / bench.at.bus_V;
    R = 4.0 / 3.0 / apart + bus;
    // The ripple within a period T hides at most (T/tau)^2/4 of the current's step, with the time constant
    // tau.
    const double x = 65536.0 / found.winding.tau;
    L = R + std::log(2 * apart) / apart + x * x / 4;
    // The voltage drop R i is at most the applied voltage v.
    const double v_over_e = static_cast<double>(found.magnet.applied) / found.magnet.emf;
    const double i_A = found.v * bench.at.bus_V / control::whole_bus / bench.machine.R_ohm[0];
    flux = v_over_e * (R + bus) + bench.machine.L_H * i_A / bench.flux_linkage() * L;
  }
};

void expect_found(const CommissioningBench& bench, const control::CommissioningState& found, const char* name,
                  const char* devices, double R_ohm) {
  ASSERT_EQ(found.phase, CommissioningPhase::done) << name << " " << static_cast<int>(found.fault);
  const control::Commissioned<double> si = in_si(bench, found);
  const Allowed allowed(bench, found);
  const double of_R = si.R_ohm / R_ohm - 1, of_L = si.L_H / bench.machine.L_H - 1,
               of_flux = si.flux_linkage_Vs / bench.flux_linkage() - 1;
  std::printf(
      "%-15s %-6s  R %7.4f ohm %+5.2f (%.2f) %%   L %7.4f mH %+5.2f (%.1f) %%   psi %7.4f mVs %+5.2f (%.1f) %%\n",
      name, devices, si.R_ohm, 100 * of_R, 100 * allowed.R, 1e3 * si.L_H, 100 * of_L, 100 * allowed.L,
      1e3 * si.flux_linkage_Vs, 100 * of_flux, 100 * allowed.flux);
  EXPECT_LT(std::fabs(of_R), allowed.R) << name;
  EXPECT_LT(std::fabs(of_L), allowed.L) << name;
  EXPECT_LT(std::fabs(of_flux), allowed.flux) << name;
}

/// The test prints, in brackets, the errors that rounding allows.
TEST(Commissioning, FindsResistanceInductanceAndFluxLinkage) {
  InPart some;
  for (const CommissionedMotor& motor : commissioned_motors)
    for (const bool ideal : {true, false}) {
      if (some.leaves_out()) continue;
      CommissioningBench bench(motor);
      double R = bench.machine.R_ohm[0];
      if (!ideal) {
        // The amplifiers have an offset of 12 counts and a noise of one count. The resistance of the switches
        // is a tenth of the phase resistance. There are diodes and a dead time.
        const double dead_s = 0.5e-6, in_diode = 2 * dead_s / bench.facts.period_s;
        bench.board.sensors.current.offset = 12.3 * bench.facts.A_per_count;
        bench.board.sensors.current.noise = 1.0 * bench.facts.A_per_count;
        bench.devices = {.R_on_ohm = 0.1 * R, .V_f_V = 0.7, .r_d_ohm = 0.01};
        bench.board.modulator.dead_ticks = dead_s * 1e12;
        R += bench.devices.R_on_ohm * (1 - in_diode) + bench.devices.r_d_ohm * in_diode;
      }
      auto rig = bench.rig();
      expect_found(bench, commission(rig), motor.name, ideal ? "ideal" : "real", R);
    }
}

/// Error, in degrees, that the trapezoidal back-EMF causes. It is 1.12 at rest (hall_survey.hpp). It
/// increases as the frequency of the shape's ripple approaches the natural frequency of the rotor in the
/// field.
double of_shape_deg(const CommissioningBench& bench) {
  const double p = bench.machine.pole_pairs;
  const double swing =
      std::sqrt(1.5 * p * p * bench.flux_linkage() * bench.wish.test_A / bench.shaft.J_kg_m2);
  const double ripple = 6 * 2 * base::pi * bench.wish.slow_turns_s;
  return 1.12 / (1 - ripple * ripple / (swing * swing));
}

/// Each edge has its own angle and a hysteresis. Friction is a tenth of the test current's torque. With a
/// sinusoidal back-EMF, the error has two parts: the oscillation of the rotor, and the counts of the capture
/// timer in both directions. With a trapezoid, the error is the error of the shape plus a twentieth, because
/// friction affects the oscillation.
TEST(Commissioning, FindsWhereEachHallEdgeStands) {
  InPart some;
  for (const CommissionedMotor& motor : commissioned_motors)
    for (const double offset : {-22.0, -7.5, 0.0, 13.0, 25.0}) {
      if (some.leaves_out()) continue;
      CommissioningBench bench(motor);
      bench.probes.placement = {.offset_deg = offset, .hysteresis_deg = 2.0, .own_deg = {0, 3, -2, 1, -4, 2}};
      bench.shaft.coulomb_Nm = 0.1 * bench.machine.K_e_V_s[0] * motor.test_A;
      const bool sine = !bench.machine.shape.harmonics.empty();
      if (!sine) bench.wish.slow_turns_s = 1.0;
      auto rig = bench.rig();
      const control::CommissioningState& found = commission(rig);
      ASSERT_EQ(found.probes.verdict, HallSurvey::good) << motor.name << " " << offset;
      double worst = 0;
      for (unsigned n = 0; n < 6; ++n) {
        const double at = found.probes.edges.at[n] * (360.0 / 4294967296.0);
        const double due = 60.0 * n + offset + bench.probes.placement.own_deg[n];
        worst = std::fmax(worst, std::fabs(std::remainder(at - due, 360.0)));
      }
      std::printf("%-15s offset %5.1f: found %7.3f degrees, worst edge off by %.3f, lag %.2f\n", motor.name,
                  offset, in_si(bench, found).hall_offset_deg, worst, in_si(bench, found).hall_lag_deg);
      const double count_deg = 360.0 * bench.wish.slow_turns_s / bench.facts.timer_Hz;
      EXPECT_LT(worst, sine ? 6 * count_deg : 1.05 * of_shape_deg(bench)) << motor.name << " " << offset;
      EXPECT_TRUE(found.probes.plain);
    }
}

constexpr WireOrder orders[] = {WireOrder::abc, WireOrder::bca, WireOrder::cab,
                                WireOrder::acb, WireOrder::cba, WireOrder::bac};

/// The mean over a sector of a phase's trapezoid with a flat top of 120 degrees (model.md 1).
double in_sector(int sector, std::size_t phase) {
  constexpr double of_a[6] = {1, 1, 0, -1, -1, 0};
  return of_a[(sector + 6 - 2 * static_cast<int>(phase)) % 6];
}

/// In each sector of the rotor, the pair of the table gives the largest torque. With an odd permutation of
/// the motor wires, the board's forward direction is the motor's backward direction, so the pair is reversed.
void expect_right_table(const CommissioningBench& bench, const control::HallLines& lines) {
  for (int sector = 0; sector < 6; ++sector) {
    const std::uint8_t probes =
        bench.probes.spaced_60 ? plant::hall_code_60(sector) : plant::hall_code(sector);
    const std::uint8_t seen = lines.sector[bench.wires.at_pins(probes)];
    ASSERT_LT(seen, 6) << sector;
    const control::Pair pair = control::positive_pair(seen);
    const double torque = in_sector(sector, bench.wires.phase(static_cast<std::size_t>(pair.source))) -
                          in_sector(sector, bench.wires.phase(static_cast<std::size_t>(pair.sink)));
    EXPECT_EQ(torque, bench.wires.phases < WireOrder::acb ? 2.0 : -2.0) << sector;
  }
}

/// The cases are all 36 orders of both plugs, the eight inversions of lines in turn, and both spacings of the
/// probes.
TEST(Commissioning, FindsEveryWiring) {
  InPart some;
  int plain = 0;
  std::uint8_t inverted = 0;
  for (const bool spaced_60 : {false, true})
    for (const WireOrder phases : orders)
      for (const WireOrder probes : orders) {
        CommissioningBench bench(commissioned_motors[0]);
        bench.wish.settle_s = 0.1;
        bench.wish.step_s = 6e-3;
        bench.wish.slow_turns_s = 20.0;
        bench.probes.spaced_60 = spaced_60;
        bench.wires = {phases, probes, inverted};
        inverted = static_cast<std::uint8_t>((inverted + 1) % 8);
        if (some.leaves_out()) continue;
        auto rig = bench.rig();
        const control::CommissioningState& found = commission(rig, 60.0, CommissioningPhase::spinning);
        SCOPED_TRACE(::testing::Message()
                     << spaced_60 << int(phases) << int(probes) << int(bench.wires.inverted));
        ASSERT_EQ(found.probes.verdict, HallSurvey::good);
        expect_right_table(bench, found.probes.lines);
        plain += found.probes.plain;
        if (bench.wires == rig::Wiring{}) {
          EXPECT_TRUE(found.probes.plain);
          EXPECT_EQ(found.probes.config.arrangement,
                    spaced_60 ? control::HallArrangement::degrees_60 : control::HallArrangement::degrees_120);
        }
      }
  EXPECT_LT(plain, 36);
}

/// With the found table, the drive turns in the board's forward direction. Its speed is the no-load speed of
/// the duty, reduced by friction.
TEST(Commissioning, DrivesByTheTableThatItFound) {
  for (const rig::Wiring& wires : {rig::Wiring{}, rig::Wiring{WireOrder::bca, WireOrder::acb, 5},
                                   rig::Wiring{WireOrder::cba, WireOrder::cab, 2}})
    for (const double duty : {0.4, -0.4}) {
      CommissioningBench bench(commissioned_motors[0]);
      bench.wires = wires;
      bench.timeline.push_back({{}, rig::ActionKind::setpoint, duty});
      auto rig = bench.rig();
      ASSERT_EQ(commission(rig).phase, CommissioningPhase::done);
      sim::NoObserver none;
      ASSERT_EQ(sim::run(rig, sim::to_instant(rig.now().seconds() + 0.5), none).stop, sim::Stop::end);
      const double forward = wires.phases < WireOrder::acb ? 1.0 : -1.0;
      const double no_load = forward * duty * bench.at.bus_V / bench.model.K_t_Nm_A;
      EXPECT_NEAR(rig.plant().state().w, no_load, 0.05 * std::fabs(no_load));
    }
}

TEST(Commissioning, SaysWhatIsWrong) {
  CommissioningBench dead(commissioned_motors[0]);
  dead.timeline.push_back({{}, rig::ActionKind::hall_stuck, 2.0});
  auto dead_rig = dead.rig();
  const control::CommissioningState& line = commission(dead_rig);
  EXPECT_EQ(line.probes.verdict, HallSurvey::dead_line);
  EXPECT_EQ(line.probes.dead_pins, 0b010);
  EXPECT_EQ(line.phase, CommissioningPhase::done);  // the other values are found nevertheless

  CommissioningBench open(commissioned_motors[0]);
  open.timeline.push_back({{}, rig::ActionKind::wire_break, 0.0});
  open.timeline.push_back({{}, rig::ActionKind::wire_break, 1.0});
  auto open_rig = open.rig();
  EXPECT_EQ(commission(open_rig).fault, CommissioningFault::current);

  CommissioningBench amplifier(commissioned_motors[0]);
  amplifier.board.sensors.current.offset = 0.2 * commissioned_motors[0].range_A;
  auto amplifier_rig = amplifier.rig();
  EXPECT_EQ(commission(amplifier_rig).fault, CommissioningFault::offset);

  CommissioningBench held(commissioned_motors[0]);
  held.shaft.locked = true;
  held.wish.tries = 2;
  auto held_rig = held.rig();
  EXPECT_EQ(commission(held_rig).fault, CommissioningFault::not_turned);
  EXPECT_NE(held_rig.firmware().found().probes.verdict, HallSurvey::good);
  EXPECT_TRUE(held_rig.firmware().found().winding.usable);
}

}  // namespace SIXSTEP_TEST_FILE
