// SPDX-License-Identifier: Apache-2.0
// A scenario in which the sensorless drive finds its rotor by pulses. A wheel hub motor with a salient rotor
// and iron that saturates starts from many angles. Pulses cannot find the angle of the round rotor of the
// 251601. The tests include refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;
using control::SensorlessPhase;
using ::testing::HasSubstr;

constexpr int pairs = 15;

/// The motor library's hub motor, with two inductances in its sheet and iron that saturates at 40 A.
Scenario hub(double electrical_deg, double speed_rad_s) {
  Scenario s;
  s.sheet.name = "hub";
  s.sheet.pole_pairs = pairs;
  s.sheet.back_emf = design::BackEmfShape::sine;
  s.sheet.resistance_ohm = {0.179, "phase", ""};
  s.sheet.d_axis_inductance_mH = {0.52, "phase", ""};
  s.sheet.q_axis_inductance_mH = {0.65, "phase", ""};
  s.sheet.saturation_current_A = {40.0, "phase", ""};
  s.sheet.flux_linkage_mWb = {17.2, "", ""};
  s.sheet.inertia_gcm2 = {60'000.0, "", ""};
  s.sheet.nominal_current_A = {6.0, "terminal", ""};
  s.supply.voltage_V = 36.0;
  s.control.mode = Mode::speed;
  s.control.drive = FirmwareKind::sensorless;
  s.control.sensorless.starts_by = StartsBy::pulses;
  s.control.current.settle_s = 2e-3;
  s.control.current.damping = 0.9;
  s.control.speed.settle_s = 0.5;
  s.control.speed.damping = 0.9;
  s.pwm.period_s = 50e-6;
  s.pwm.alignment = Alignment::centre;
  s.pwm.sample = SampleAt::middle;
  s.sensors.capture_Hz = 16e6;
  s.sensors.currents = rig::CurrentMeasurement::phases;
  s.sensors.current_range_A = 25.0;
  s.sensors.current_noise_A = 0.02;
  s.initial.angle_rad = electrical_deg * base::pi / 180 / pairs;
  s.reference.value = speed_rad_s;
  s.duration_s = 1.5;
  return s;
}

double step_of(const Compiled& compiled, const std::string& symbol) {
  for (const design::DerivationStep& step : compiled.sensorless_steps)
    if (step.symbol == symbol) return step.value;
  ADD_FAILURE() << symbol << " is no step";
  return 0.0;
}

using Firmware = rig::SensorlessDrive<double>;

/// Runs until the pulses have ended.
void run_pulses(GeneralRig<Firmware>& rig) {
  sim::NoObserver none;
  bool began = false;
  for (int n = 1; n < 4000; ++n) {
    ASSERT_EQ(sim::run(rig, sim::to_instant(n * 250e-6), none).stop, sim::Stop::end);
    began = began || rig.firmware().start().pulsing;
    if (began && !rig.firmware().start().pulsing) return;
  }
  FAIL() << "no pulses";
}

/// The design gives the bounds: for the angle five times the noise, for the rotation the sum of impulses. The
/// signals are compared with the block's measurement.
TEST(SensorlessPulses, FindsTheRotorFromAnyAngleAndLeavesItWhereItStands) {
  double worst_off = 0, worst_turn = 0, most_off = 0, most_turn = 0;
  for (double deg = 2.5; deg < 360; deg += 7.5) {
    const Scenario s = hub(deg, 5.0);
    const auto compiled = compile(s);
    ASSERT_TRUE(compiled) << to_string(compiled.problems().front());
    most_off = step_of(*compiled, "off");
    most_turn = step_of(*compiled, "turned");
    const auto chip = chip_of<Firmware>(s, *compiled);
    ASSERT_TRUE(chip);
    GeneralRig<Firmware> rig = general_rig_of<Firmware>(*compiled, *chip, compiled->timeline);
    run_pulses(rig);
    const control::PulsePositionReading& found = rig.firmware().start().found;
    ASSERT_TRUE(found.seen && found.axis_seen) << deg;
    EXPECT_EQ(rig.firmware().rotor().phase, SensorlessPhase::ramping) << deg;
    const auto& state = rig.plant().state();
    const double turned = static_cast<double>(state.sector) * 60.0 + state.x * 180 / base::pi - deg;
    const double off = std::remainder(found.electrical * (360.0 / 4294967296.0) - deg - turned, 360.0);
    worst_off = std::fmax(worst_off, std::fabs(off));
    worst_turn = std::fmax(worst_turn, std::fabs(turned));
    EXPECT_LT(std::fabs(off), most_off + most_turn)
        << deg << ": it is asked over all the rounds, while it turns";
    EXPECT_LT(std::fabs(turned), most_turn) << deg;
    // The chip measures its noise. From 48 readings, the variance is accurate to a fifth.
    EXPECT_NEAR(found.north_16 / 16.0, step_of(*compiled, "north"), 0.25 * step_of(*compiled, "north"))
        << deg;
    EXPECT_GE(found.north_16 / 16.0, 6.0);
  }
  std::printf("48 angles: off by %.2f of %.2f degrees, turned by %.3f of %.3f degrees\n", worst_off, most_off,
              worst_turn, most_turn);
}

/// The speed is 25 rad/s, 0.3 of the no-load speed. At 12 rad/s, the drive would lose the crossings of such a
/// salient hub motor after any kind of start. After the pulses, the ramp moves the rotor in the requested
/// direction. The rotor may turn back by at most the rotation from the pulses plus the error of the angle. An
/// alignment would turn it back by up to half a turn.
TEST(SensorlessPulses, StartsWithoutTurningBack) {
  for (const double way : {1.0, -1.0})
    for (const double deg : {1.0, 59.0, 95.0, 170.0, 242.0, 299.0}) {
      Scenario s = hub(deg, way * 25.0);
      ask(s, over(way > 0 ? MetricKind::minimum : MetricKind::maximum, Signal::position, 0.0, 1.5));
      ask(s, over(MetricKind::mean, Signal::speed, 1.4, 1.5));
      const Outcome out = outcome_of(s);
      ASSERT_FALSE(out.fault) << to_string(*out.fault);
      EXPECT_TRUE(out.notes.empty()) << out.notes[0];
      const auto compiled = compile(s);
      ASSERT_TRUE(compiled);
      const double back = -way * (out.comparisons[0].measured * pairs - deg);
      EXPECT_LT(back, step_of(*compiled, "turned")) << deg << " " << way;
      EXPECT_NEAR(out.comparisons[1].measured, way * 25.0, 0.02 * 25.0) << deg << " " << way;
    }
  // With an alignment, the rotor exceeds this bound: the angle of the aligning pair is 120 degrees.
  Scenario aligned = hub(242.0, 25.0);
  aligned.control.sensorless.starts_by = StartsBy::alignment;
  ask(aligned, over(MetricKind::minimum, Signal::position, 0.0, 1.5));
  EXPECT_LT(outcome_of(aligned).comparisons[0].measured * pairs, 242.0 - 90.0);
}

TEST(SensorlessPulses, StartsInEveryArithmetic) {
  for (const Arithmetic a :
       {Arithmetic::float32, Arithmetic::q15, Arithmetic::q14, Arithmetic::q31, Arithmetic::q30}) {
    Scenario s = hub(130.0, 25.0);
    s.control.arithmetic = a;
    if (a == Arithmetic::q15 || a == Arithmetic::q14) s.sensors.capture_Hz = 1e6;
    ask(s, over(MetricKind::mean, Signal::speed, 1.4, 1.5));
    const Outcome out = outcome_of(s);
    ASSERT_FALSE(out.fault) << to_string(*out.fault);
    EXPECT_TRUE(out.notes.empty()) << out.notes[0];
    EXPECT_NEAR(out.comparisons[0].measured, 25.0, 0.5) << static_cast<int>(a);
  }
}

/// Pulses cannot find the angle of the round rotor of the 251601. The drive aligns the rotor and starts it,
/// and a note states the reason.
TEST(SensorlessPulses, AlignsWhatShowsNothingAndSaysSo) {
  Scenario s = maxon_scenario(Mode::speed, 100.0);
  s.sheet.nominal_current_A = {2.33, "terminal", ""};
  s.control.drive = FirmwareKind::sensorless;
  s.control.sensorless.starts_by = StartsBy::pulses;
  s.control.speed.settle_s = 0.1;
  s.control.speed.damping = 0.9;
  s.pwm.alignment = Alignment::centre;
  s.pwm.sample = SampleAt::middle;
  s.sensors.capture_Hz = 16e6;
  s.sensors.currents = rig::CurrentMeasurement::phases;
  s.sensors.current_range_A = 25.0;
  s.load.coulomb_Nm = 0.01;
  s.duration_s = 1.5;
  ask(s, over(MetricKind::mean, Signal::speed, 1.3, 1.5));
  const Outcome out = outcome_of(s);
  ASSERT_FALSE(out.fault) << to_string(*out.fault);
  EXPECT_NEAR(out.comparisons[0].measured, 100.0, 1.0);
  ASSERT_EQ(out.notes.size(), 1u);
  EXPECT_THAT(out.notes[0], HasSubstr("the pulses did not show which end of the magnet is north"));
  EXPECT_THAT(out.notes[0], HasSubstr("the drive aligned the rotor"));
}

TEST(SensorlessPulses, AreOffUnlessAskedFor) {
  Scenario s = hub(0.0, 5.0);
  s.control.sensorless.starts_by = StartsBy::alignment;
  const auto compiled = compile(s);
  ASSERT_TRUE(compiled);
  EXPECT_EQ(compiled->sensorless->pulses, control::PulsePositionConfig{});
}

TEST(SensorlessPulses, SayWhatTheyNeed) {
  const auto refused = [](const Scenario& s, const std::string& where) {
    const base::Problems found = check(s);
    ASSERT_EQ(found.size(), 1u) << where;
    EXPECT_EQ(found[0].where, where) << to_string(found[0]);
    EXPECT_THAT(found[0].cure, HasSubstr("alignment"));
  };
  Scenario s = hub(0.0, 5.0);
  EXPECT_TRUE(check(s).empty());
  s.sensors.currents = rig::CurrentMeasurement::ideal;
  refused(s, "sensors.currents");
  s = hub(0.0, 5.0);
  s.sensors.currents = rig::CurrentMeasurement::dc_link;
  refused(s, "sensors.currents");
  s = hub(0.0, 5.0);
  s.sensors.current_range_A = 0.5;
  const auto narrow = compile(s);
  ASSERT_FALSE(narrow);
  EXPECT_EQ(narrow.problems()[0].where, "sensors.current_range_A");
  s = hub(0.0, 5.0);
  s.control.sensorless.overload = 0.1;
  s.control.sensorless.greatest_load = 0.0;
  const auto weak = compile(s);
  ASSERT_FALSE(weak);
  EXPECT_EQ(weak.problems()[0].where, "control.sensorless.overload");
}

}  // namespace SIXSTEP_TEST_FILE
