// SPDX-License-Identifier: Apache-2.0
// The plant provokes losses, and the tests check their names. The causes are an old current that outlasts the
// crossing, a rotor struck into another sector, a held rotor, and a broken divider. Each case runs in both
// directions, by crossings in double and by an observer in q15.
#include "tests/support/sensorless_board.hpp"

#include <array>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Follow;
using control::LockLoss;
using control::Q15;
using control::SensorlessPhase;

struct Lost {
  LockLoss named = LockLoss::none;
  bool caused = false;   ///< the cause showed before the loss was named
  int commutations = 0;  ///< since the cause
};

/// Runs until the drive loses the rotor. The function `caused` returns whether the plant shows the cause at
/// that time.
template <class Rig, class Caused>
Lost lost(Rig&& rig, const SensorlessBench& bench, double cause_s, Caused&& caused) {
  run_until(rig, cause_s);
  EXPECT_EQ(phase(rig), SensorlessPhase::running);
  Lost found;
  std::int32_t last = 0, since = 0;
  const double t = run_until_true(rig, cause_s + 0.3, bench.spec.period_s, [&] {
    if (phase(rig) != SensorlessPhase::running) return true;
    last = rig.firmware().rotor().position.sectors;
    if (!found.caused) since = last;
    found.caused = found.caused || caused(rig);
    return false;
  });
  EXPECT_GT(t, 0);
  EXPECT_FALSE(rig.modulator().command().enabled) << "the bridge is off";
  found.named = rig.firmware().rotor().lock.last;
  found.commutations = found.caused ? std::abs(last - since) : 0;
  return found;
}

/// Tests two drives: one by the crossings in double, and one by the flux linkage in q15.
template <class Caused>
void expect_name(const SensorlessBench& bench, double cause_s, LockLoss name, const std::string& where,
                 Caused&& caused) {
  const auto expect = [&](const Lost& l, const char* which) {
    EXPECT_EQ(l.named, name) << where << " " << which;
    EXPECT_LE(l.commutations, 2) << where << " " << which;
  };
  expect(lost(bench.rig(), bench, cause_s, caused), "double");
  SensorlessBench other = bench;
  follow(other, Follow::flux);
  const auto chip = in_fixed_point<Q15>(other);
  expect(lost(rig::Rig<double, rig::SensorlessDrive<Q15>>(other.plant(), {.drive = chip}, other.board,
                                                          other.timeline),
              other, cause_s, caused),
         "q15");
}

std::string at(const SensorlessMotor& motor, int sign) {
  return std::string(motor.name) + (sign > 0 ? " forward" : " backward");
}

/// Returns whether the crossing has passed while the floating leg still carries its old current.
template <class Rig>
bool crossing_is_hidden(const Rig& rig, double least_A) {
  const control::SensorlessState& rotor = rig.firmware().rotor();
  const auto& state = rig.plant().state();
  if (rig.plant().sector() != rotor.sector) return false;
  const bool passed = rotor.direction > 0 ? state.x > base::sector_rad / 2 : state.x < base::sector_rad / 2;
  return passed && std::fabs(state.i[control::floating_leg(rotor.sector)]) > least_A;
}

/// The inductance L is so large that the limit current I decays in half a sector at half the no-load speed: L
/// I = U t (bus voltage U, time t). The drive then accelerates.
TEST(SensorlessNames, AnOldCurrentThatOutlastsTheCrossingIsALongDemagnetisation) {
  for (const SensorlessMotor& motor : three_motors)
    for (const int sign : {1, -1}) {
      SensorlessBench bench(motor);
      const double no_load = bench.no_load_rad_s();
      const double half_s = base::sector_rad / (bench.motor.machine.pole_pairs * 0.5 * no_load) / 2;
      bench.motor.machine.L_H = half_s * motor.bus_V / bench.drive.current_limit_A;
      const double cause_s = aligned_s(bench) + 0.6;
      bench.setpoint(0, sign * 0.3 * no_load);
      bench.setpoint(cause_s, sign * 0.9 * no_load);
      const double least_A = 0.02 * bench.nominal_A();
      expect_name(bench, cause_s, LockLoss::long_demagnetisation, at(motor, sign),
                  [least_A](const auto& rig) { return crossing_is_hidden(rig, least_A); });
    }
}

/// A torque accelerates the rotor from 0.1 to 0.7 of its no-load speed within four control periods, at any
/// angle in a sector. The rotor turns through sectors that the drive does not yet expect.
TEST(SensorlessNames, ARotorThatIsStruckStandsInAWrongSector) {
  int n = 0;
  for (const SensorlessMotor& motor : three_motors)
    for (const int sign : {1, -1}) {
      SensorlessBench bench(motor);
      const double w = 0.1 * bench.no_load_rad_s(), blow_s = 4 * bench.spec.period_s;
      const double sector_s = base::sector_rad / (bench.motor.machine.pole_pairs * w);
      const double cause_s = aligned_s(bench) + 0.6 + n++ * sector_s / 6;
      bench.setpoint(0, sign * w);
      bench.act(cause_s, rig::ActionKind::load_torque, -sign * 6 * w * bench.motor.shaft.J_kg_m2 / blow_s);
      bench.act(cause_s + blow_s, rig::ActionKind::load_torque, 0);
      expect_name(bench, cause_s, LockLoss::wrong_sector, at(motor, sign), [](const auto&) { return true; });
    }
}

TEST(SensorlessNames, AHeldRotorMasksItsCrossing) {
  for (const SensorlessMotor& motor : three_motors)
    for (const int sign : {1, -1}) {
      SensorlessBench bench(motor);
      const double cause_s = aligned_s(bench) + 0.6;
      bench.setpoint(0, sign * 0.5 * bench.no_load_rad_s());
      bench.act(cause_s, rig::ActionKind::shaft_locked, 1);
      expect_name(bench, cause_s, LockLoss::masked_crossing, at(motor, sign),
                  [](const auto&) { return true; });
    }
}

constexpr double broken_s = 1.4;

/// The divider of one leg breaks on the board and reads 0. The reading is wrong as soon as the terminal has
/// another voltage. A wrong reading has no effect if the leg floats and its crossing has already passed.
/// Before a falling crossing, the chip interprets 0 as the crossing; the pairs of the next two sectors are
/// then still right.
template <class Scalar, std::size_t leg>
struct BrokenDivider : BuiltDrive<Scalar> {
  using BuiltDrive<Scalar>::BuiltDrive;
  using typename BuiltDrive<Scalar>::Command;
  bool reads_wrong = false;
  bool broken = false;
  bool looks_crossed = false;

  template <class Real>
  void look_at_terminals(const plant::PerLeg<Real>& u) {
    const control::SensorlessState& rotor = this->rotor();
    const bool matters = control::floating_leg(rotor.sector) != leg || !rotor.crossing.done;
    reads_wrong = reads_wrong || (broken && matters && u[leg] > 1.0);
    BuiltDrive<Scalar>::look_at_terminals(u);
  }
  template <class Real>
  const Command& tick(const rig::SampleInstant<Real>& instant, double setpoint) {
    if (!broken && instant.at >= sim::to_instant(broken_s)) {
      broken = true;
      const control::SensorlessState& rotor = this->rotor();
      looks_crossed =
          control::floating_leg(rotor.sector) == leg && rotor.sector % 2 == 0 && !rotor.crossing.done;
      this->break_divider(leg);
    }
    return BuiltDrive<Scalar>::tick(instant, setpoint);
  }
};

template <std::size_t leg>
void expect_divider_named(const SensorlessMotor& motor, int sign, Follow follower) {
  SensorlessBench bench = on_built_board(motor);
  follow(bench, follower);
  bench.setpoint(0, sign * 0.5 * bench.no_load_rad_s());
  bool looks_crossed = false;
  const Lost l = lost(bench.rig<BrokenDivider<double, leg>>(), bench, broken_s, [&](const auto& rig) {
    looks_crossed = rig.firmware().looks_crossed;
    return rig.firmware().reads_wrong;
  });
  const std::string where = at(motor, sign) + " " + word(follower) + " leg " + std::to_string(leg);
  EXPECT_TRUE(l.named == LockLoss::terminals || l.named == LockLoss::long_demagnetisation ||
              l.named == LockLoss::masked_crossing)
      << where << " " << static_cast<int>(l.named);
  EXPECT_TRUE(l.caused) << where;
  EXPECT_LE(l.commutations, looks_crossed ? 3 : 2) << where;
}

/// If a leg is driven high, a reading of 0 contradicts the command, and the loss is named `terminals`. If a
/// leg floats, a reading of 0 has two explanations: a conducting diode, which hides the crossing, or a
/// back-EMF that does not reach its crossing.
TEST(SensorlessNames, ADividerThatBreaksIsOneOfThree) {
  int n = 0;
  for (const SensorlessMotor& motor : three_motors)
    for (const Follow follower : {Follow::crossings, Follow::luenberger, Follow::flux}) {
      const int sign = n % 2 == 0 ? 1 : -1;
      constexpr auto by_leg =
          std::array{expect_divider_named<0>, expect_divider_named<1>, expect_divider_named<2>};
      by_leg[static_cast<std::size_t>((n + n / 3) % 3)](motor, sign, follower);
      ++n;
    }
}

}  // namespace SIXSTEP_TEST_FILE
