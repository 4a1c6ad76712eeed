// SPDX-License-Identifier: Apache-2.0
// Each remark is printed only if it is true. Its numbers are compared with a hand calculation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/session/session.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::Scenario;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> remarks_on(const Scenario& s) {
  const auto out = study::run(s);
  if (!out) {
    ADD_FAILURE() << to_string(out.problems()[0]);
    return {};
  }
  return out->remarks;
}

/// A drive of any mode. If the mode has no speed loop, the torque limit is removed, because it would cause a
/// remark.
Scenario drive_of(Mode mode, double reference) {
  Scenario s = maxon_scenario(mode, reference);
  if (mode != Mode::speed && mode != Mode::position) s.control.speed.torque_limit_Nm.reset();
  return s;
}

/// The maxon 251601 with a locked rotor: 1.03 ohm and 0.572 mH between two terminals, 24 V, and a period of
/// 30 us.
Scenario held(double amps) {
  Scenario s = drive_of(Mode::current, amps);
  s.load.locked = true;
  s.duration_s = 5e-3;
  return s;
}

TEST(Remarks, AnOrdinaryDriveHasNone) {
  EXPECT_THAT(remarks_on(held(5.0)), IsEmpty());
  EXPECT_THAT(remarks_on(drive_of(Mode::current, 2.0)), IsEmpty());
}

TEST(Remarks, ABusThatNobodyChose) {
  Scenario s = held(1.0);
  s.sheet.nominal_voltage_V = base::Quantity{.value = 36.0};
  EXPECT_THAT(remarks_on(s), Contains(AllOf(HasSubstr("24 V, its default"), HasSubstr("36 V"))));
  s.supply.voltage_V = 36.0;
  EXPECT_THAT(remarks_on(s), IsEmpty());
  s.supply.voltage_V = 30.0;
  EXPECT_THAT(remarks_on(s), IsEmpty());
  s.supply.voltage_V = 24.0;
  s.sheet.nominal_voltage_V.reset();
  EXPECT_THAT(remarks_on(s), IsEmpty());
}

TEST(Remarks, ValuesOfTheReferenceBehindTheEnd) {
  Scenario s = held(1.0);
  s.duration_s = 4e-3;
  s.reference = {.shape = study::Shape::csv, .times_s = {0, 1e-3, 3e-3, 5e-3}, .values = {0, 1, 2, 1}};
  EXPECT_THAT(remarks_on(s), IsEmpty()) << "the run is on the line to the last one";
  s.reference.interpolation = study::Interpolation::hold;
  EXPECT_THAT(remarks_on(s), Contains(HasSubstr("1 of the 4 values of the reference are after the end")));
  s.duration_s = 2e-3;
  EXPECT_THAT(remarks_on(s), Contains(HasSubstr("2 of the 4 values")));
}

/// The drive controls 0.3 A. One shunt is sampled in the middle of a centred pulse.
Scenario on_one_shunt() {
  Scenario s = held(0.3);
  s.pwm.alignment = study::Alignment::centre;
  s.pwm.sample = study::SampleAt::middle;
  s.sensors.currents = rig::CurrentMeasurement::dc_link;
  s.sensors.current_range_A = 20.0;
  return s;
}

TEST(Remarks, AShuntThatSeesNoPulse) {
  Scenario s = on_one_shunt();
  // The shunt measures the current above a duty of 2 us/30 us. At standstill, this duty gives 24 V/1.03
  // ohm/15 = 1.553 A.
  EXPECT_THAT(remarks_on(s),
              Contains(AllOf(HasSubstr("above a duty of 0.0667"), HasSubstr("this duty gives 1.55 A"))));
  s.pwm.chopping = control::Chopping::complementary;
  EXPECT_THAT(remarks_on(s), Contains(HasSubstr("this duty gives 1.55 A")));
  s.pwm.chopping = control::Chopping::hard;  // no current at a duty of one half, where each pulse is seen
  EXPECT_THAT(remarks_on(s), Not(Contains(HasSubstr("at standstill"))));
  s.pwm.chopping = control::Chopping::soft;
  s.reference.value = 5.0;
  EXPECT_THAT(remarks_on(s), IsEmpty());
}

/// The voltage drops of the bridge's devices reduce the current. A delayed reading needs a longer pulse.
TEST(Remarks, AShuntBehindARealBridge) {
  Scenario s = on_one_shunt();
  const double R = 1.03 / 2, d = 2e-6 / 30e-6;
  s.bridge.diode_drop_V = 0.7;
  EXPECT_NEAR(study::unseen_at_rest_A(s, R), (24 * d - 0.7 * (1 - d)) / 1.03, 1e-12);
  s.bridge.diode_drop_V = 0.0;
  s.bridge.on_resistance_ohm = 0.2;
  EXPECT_NEAR(study::unseen_at_rest_A(s, R), 24 * d / (1.03 + 0.2 * (1 + d)), 1e-12);
  s.pwm.chopping = control::Chopping::complementary;
  EXPECT_NEAR(study::unseen_at_rest_A(s, R), 24 * d / (1.03 + 0.4), 1e-12);
  s.bridge.on_resistance_ohm = 0.0;
  s.sensors.current_delay_s = 3e-6;
  EXPECT_NEAR(study::unseen_at_rest_A(s, R), 24 * 8e-6 / 30e-6 / 1.03, 1e-12);
  EXPECT_THAT(remarks_on(s),
              Contains(AllOf(HasSubstr("above a duty of 0.267"), HasSubstr("this duty gives 6.21 A"),
                             HasSubstr("sensors.current_delay_s = 3 us"))));
  s.sensors.current_delay_s = 0.0;
  s.pwm.minimum_pulse_s = 3e-6;
  EXPECT_NEAR(study::unseen_at_rest_A(s, R), 24 * 0.1 / 1.03, 1e-12);
  s.pwm.minimum_pulse_s = 0.0;
  s.sensors.current_bandwidth_Hz = 2e4;
  // 1 - exp(-1 us 2 pi 20 kHz) is 0.118, and ln 10/(2 pi 20 kHz) is 18.3 us.
  EXPECT_THAT(remarks_on(s),
              Contains(AllOf(HasSubstr("shows 11.8 %"), HasSubstr("after 18.3 us the sensor shows 90 %"))));
  s.sensors.current_bandwidth_Hz.reset();
}

/// With complementary chopping, the upper switch turns on after the dead time, so of a pulse of 4 us around
/// its sample, 3 us are left. After the dead time, 1 us is left before the sample, which is the settling time
/// of the amplifier.
TEST(Remarks, AShuntBehindADeadTime) {
  Scenario s = on_one_shunt();
  s.pwm.chopping = control::Chopping::complementary;
  s.bridge.dead_time_s = 1e-6;
  EXPECT_NEAR(study::least_visible_duty(s), 4.0 / 30, 1e-15);
  const double hidden_A = study::unseen_at_rest_A(s, 1.03 / 2);
  EXPECT_NEAR(hidden_A, 24 * 3e-6 / 30e-6 / 1.03, 1e-12);
  // A current above hidden_A is measured and can be controlled. A smaller current is not measured.
  s.reference.value = 1.1 * hidden_A;
  EXPECT_THAT(remarks_on(s), Not(Contains(HasSubstr("the shunt"))));
  s.reference.value = 0.5 * hidden_A;
  EXPECT_THAT(remarks_on(s),
              Contains(AllOf(HasSubstr("above a duty of 0.133"), HasSubstr("bridge.dead_time_s = 1 us"),
                             HasSubstr("this duty gives 2.33 A"))));
  s.pwm.chopping = control::Chopping::soft;  // no other switch of the leg to wait for
  EXPECT_NEAR(study::least_visible_duty(s), 2.0 / 30, 1e-15);
}

/// The drive omits pulses below 3 us. The sample of a pulse would be valid from 2 us on, because half of the
/// pulse is the configured settling time.
TEST(Remarks, SamplesThatTheDriveTakesTooSoon) {
  Scenario s = on_one_shunt();
  s.pwm.minimum_pulse_s = 3e-6;
  s.reference.value = 1.0;
  EXPECT_THAT(remarks_on(s), Contains(AllOf(HasSubstr("from a duty of 0.0667 on the drive uses such samples"),
                                            HasSubstr("set sensors.shunt_settle_s = 1.5 us"))));
  s.sensors.shunt_settle_s = 1.5e-6;
  EXPECT_THAT(remarks_on(s), Contains(AllOf(HasSubstr("above a duty of 0.1"), Not(HasSubstr("uses such")))));
}

TEST(Remarks, HallEdgesRarerThanTheTimeout) {
  Scenario s = drive_of(Mode::speed, 2.0);
  s.duration_s = 10e-3;
  s.sensors.rotor = study::RotorSensing::hall;
  // With eight pole pairs at 2 rad/s, an edge occurs every (pi/3)/(8 x 2) = 65.4 ms. The slowest measurable
  // speed is (pi/3)/8/50 ms = 2.618 rad/s.
  EXPECT_THAT(remarks_on(s), Contains(AllOf(HasSubstr("every 65.4 ms"), HasSubstr("timeout_s = 50 ms"),
                                            HasSubstr("slowest measurable speed is 2.62 rad/s"))));
  s.reference.value = 5.0;
  EXPECT_THAT(remarks_on(s), IsEmpty());
}

TEST(Remarks, GainsPerSecondTakenForGainsPerSample) {
  Scenario s = held(5.0);
  // The gains are per second, as in other programs: kp = L 1000/s and ki = R 1000/s.
  s.control.current.kp = 0.572;
  s.control.current.ki = 1030.0;
  const std::vector<std::string> told = remarks_on(s);
  EXPECT_THAT(told, Contains(AllOf(HasSubstr("ki_per_s = 1030"), HasSubstr("ki = 0.0309"))));
  EXPECT_THAT(told, Contains(HasSubstr("current loop is unstable")));
  s.control.current.ki.reset();
  s.control.current.ki_per_s = 1030.0;
  EXPECT_THAT(remarks_on(s), IsEmpty());
}

TEST(Remarks, GainsPerSecondAreThoseOfASampleTimesThePeriod) {
  Scenario per_sample = held(5.0), per_second = held(5.0);
  per_sample.control.current.kp = per_second.control.current.kp = 0.572;
  per_sample.control.current.ki = 1030.0 * per_sample.pwm.period_s;
  per_second.control.current.ki_per_s = 1030.0;
  const auto a = study::run(per_sample), b = study::run(per_second);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->digest, b->digest);
  per_second.control.current.ki = 0.03;
  const auto twice = study::run(per_second);
  ASSERT_FALSE(twice);
  EXPECT_THAT(to_string(twice.problems()[0]), HasSubstr("remove ki or ki_per_s"));
}

TEST(Remarks, ASettlingTimeThatIsSlowerThanTheRotorItself) {
  Scenario s = drive_of(Mode::speed, 100.0);
  s.duration_s = 2e-3;
  s.control.speed.settle_s = 20.0;  // J/B is 1.85 s: the user meant 20 ms
  EXPECT_THAT(remarks_on(s), Contains(AllOf(HasSubstr("negative"), HasSubstr("control.speed.settle_s"))));
  s.control.speed.settle_s = 20e-3;
  EXPECT_THAT(remarks_on(s), IsEmpty());
}

/// The proportional gain at which the loop becomes unstable is computed by hand. Without delay, z - a + b kp
/// = 0 at z = -1 gives kp = (1 + a)/b. With one period of delay, z^2 - a z + b kp = 0 has |z| = 1 at kp =
/// 1/b.
TEST(Remarks, TheGainAtWhichALoopBecomesUnstable) {
  const double R = 1.03, L = 0.572e-3, T = 30e-6, a = std::exp(-R * T / L), b = (1 - a) / R;
  for (const bool delayed : {false, true}) {
    const double edge = delayed ? 1 / b : (1 + a) / b;
    for (const double part : {0.9, 1.1}) {
      Scenario s = held(5.0);
      s.pwm.delay_periods = delayed ? 1 : 0;
      s.control.current.d1 = part * edge;
      s.control.current.d0 = -part * edge * (1 - 1e-6);  // almost no integral part
      const auto told = remarks_on(s);
      if (part > 1.0)
        EXPECT_THAT(told, Contains(HasSubstr("current loop is unstable"))) << delayed;
      else
        EXPECT_THAT(told, IsEmpty()) << delayed;
    }
  }
}

/// Each key without an effect on the drive causes a remark. A key with an effect causes no remark.
TEST(Remarks, KeysWithoutEffectAreNamed) {
  const std::pair<const char*, void (*)(Scenario&)> keys[] = {
      {"sensors.current_noise_A (sensors.currents is ideal)",
       [](Scenario& s) { s.sensors.current_noise_A = 0.1; }},
      {"sensors.bus_noise_V", [](Scenario& s) { s.sensors.bus_noise_V = 0.1; }},
      {"sensors.adc_bits", [](Scenario& s) { s.sensors.adc_bits = 10; }},
      {"sensors.capture_Hz", [](Scenario& s) { s.sensors.capture_Hz = 2e6; }},
      {"sensors.encoder.lines", [](Scenario& s) { s.sensors.encoder.lines = 500; }},
      {"sensors.hall_break.line", [](Scenario& s) { s.sensors.hall_break.line = 2; }},
      {"heat.ambient_degC (nothing warms up)", [](Scenario& s) { s.heat.ambient_degC = 60.0; }},
      {"supply.mains_Hz (no mains)", [](Scenario& s) { s.supply.mains_Hz = 60.0; }},
      {"protection.align.sector (no protection.align.current_A)",
       [](Scenario& s) { s.protection.align.sector = 3; }},
      {"control.current.band_A", [](Scenario& s) { s.control.current.band_A = 0.3; }},
      {"control.current.on", [](Scenario& s) { s.control.current.on = study::HysteresisOn::phase; }},
      {"control.speed.law", [](Scenario& s) { s.control.speed.law = study::SpeedLaw::sliding_mode; }},
      {"control.speed.form", [](Scenario& s) { s.control.speed.form = study::SpeedForm::positional; }},
      {"sensors.current_delay_s", [](Scenario& s) { s.sensors.current_delay_s = 1e-6; }},
      {"sensors.hall_calibration_turns", [](Scenario& s) { s.sensors.hall_calibration_turns = 20; }},
      {"sensors.hall_break.level", [](Scenario& s) { s.sensors.hall_break.level = study::Level01::high; }},
      {"sensors.resolver.reading",
       [](Scenario& s) { s.sensors.resolver.reading = rig::ResolverReading::tracking; }},
      {"load.torque_Nm (load.locked is true)", [](Scenario& s) { s.load.torque_Nm = 0.1; }},
      {"load.viscous_Nm_s", [](Scenario& s) { s.load.viscous_Nm_s = 1e-3; }},
      {"load.coulomb_Nm", [](Scenario& s) { s.load.coulomb_Nm = 0.1; }},
      {"load.static_Nm", [](Scenario& s) { s.load.static_Nm = 0.1; }},
      {"load.inertia_kg_m2", [](Scenario& s) { s.load.inertia_kg_m2 = 1e-4; }},
      {"control.smooth_chopping.soft_above_A",
       [](Scenario& s) { s.control.smooth_chopping.soft_above_A = 1.0; }},
  };
  for (const auto& [name, give] : keys) {
    Scenario s = held(5.0);
    const auto without = run(s);
    give(s);
    const auto with = run(s);
    ASSERT_TRUE(with && without) << name;
    EXPECT_THAT(with->remarks, Contains(HasSubstr(std::string("keys without effect: ") + name))) << name;
    EXPECT_EQ(with->digest, without->digest) << name;
  }
  Scenario s = held(5.0);
  s.sensors.currents = rig::CurrentMeasurement::phases;
  s.sensors.current_range_A = 30.0;
  s.sensors.current_noise_A = 0.01;
  EXPECT_THAT(remarks_on(s), ::testing::Not(Contains(HasSubstr("without effect"))));
}

/// With a locked rotor, no law of a load changes a figure of the run. A remark names each such law.
TEST(Remarks, LawsOfALoadThatCannotMoveAreNamed) {
  const std::pair<const char*, void (*)(study::Load&)> keys[] = {
      {"load.torques_Nm",
       [](study::Load& l) {
         l.times_s = {0, 1e-3};
         l.torques_Nm = {0.1, 0.2};
       }},
      {"load.at_speeds_Nm",
       [](study::Load& l) {
         l.at_speeds_rad_s = {0, 100};
         l.at_speeds_Nm = {0.1, 0.2};
       }},
      {"load.fan_Nm_s2", [](study::Load& l) { l.fan_Nm_s2 = 1e-5; }},
      {"load.gravity_Nm", [](study::Load& l) { l.gravity_Nm = 0.1; }},
      {"load.gear", [](study::Load& l) { l.gear = 3; }}};
  for (const auto& [name, give] : keys) {
    Scenario s = held(5.0);
    s.compare = {{measure(study::MetricKind::final_value, study::Signal::current), 0.0, ""},
                 {measure(study::MetricKind::maximum, study::Signal::speed), 0.0, ""}};
    const auto without = run(s);
    give(s.load);
    const auto with = run(s);
    ASSERT_TRUE(with && without) << name;
    EXPECT_THAT(with->remarks, Contains(HasSubstr(std::string(name) + " (load.locked is true)")));
    for (std::size_t n = 0; n < 2; ++n)
      EXPECT_NEAR(with->comparisons[n].measured, without->comparisons[n].measured, 1e-9) << name;
    for (const bool elastic : {false, true}) {  // released later, or free behind an elastic shaft
      Scenario moves = s;
      if (elastic) {
        moves.load.inertia_kg_m2 = 1e-5;
        moves.load.stiffness_Nm_rad = 1.0;
      } else {
        moves.at.resize(1);
        moves.at[0].time_s = 2e-3;
        moves.at[0].load.locked = false;
      }
      EXPECT_THAT(remarks_on(moves), Not(Contains(HasSubstr("load.locked is true")))) << name;
    }
  }
}

/// The rotor is locked, but its speed loop is designed with the inertia of the load. This inertia changes the
/// gains.
TEST(Remarks, TheInertiaOfAHeldRotorCountsInTheDesignOfItsSpeedLoop) {
  Scenario s = drive_of(Mode::speed, 0.5);
  s.load.locked = true;
  s.duration_s = 5e-3;
  s.control.current.settle_s = 1e-3;
  s.control.speed.settle_s = 20e-3;
  const auto without = run(s);
  s.load.inertia_kg_m2 = 1e-4;
  const auto with = run(s);
  ASSERT_TRUE(with && without);
  EXPECT_NE(with->digest, without->digest);
  EXPECT_THAT(with->remarks, Not(Contains(HasSubstr("without effect"))));
}

/// A comparator switches only by the current, whatever the keys of PWM pulses say.
TEST(Remarks, PulsesThatComparatorsDoNotMakeAreNamed) {
  const std::pair<const char*, void (*)(Scenario&)> keys[] = {
      {"pwm.alignment", [](Scenario& s) { s.pwm.alignment = study::Alignment::centre; }},
      {"pwm.minimum_pulse_s", [](Scenario& s) { s.pwm.minimum_pulse_s = 1e-6; }}};
  for (const auto& [name, give] : keys)
    for (const bool compares : {true, false}) {
      Scenario s = drive_of(Mode::current, 5.0);
      s.duration_s = 5e-3;
      if (compares) s.control.current.type = study::CurrentLoopType::hysteresis;
      const auto without = run(s);
      give(s);
      const auto with = run(s);
      ASSERT_TRUE(with && without) << name;
      EXPECT_EQ(std::count_if(with->remarks.begin(), with->remarks.end(),
                              [&](const std::string& text) { return text.find(name) != text.npos; }),
                compares ? 1 : 0)
          << name;
      EXPECT_TRUE(!compares || with->digest == without->digest) << name;
    }
}

TEST(Remarks, ABackEmfAboveTheBus) {
  Scenario s = drive_of(Mode::off, 0.0);
  s.duration_s = 2e-3;
  s.initial.speed_rad_s = 800.0;
  // At 800 rad/s, 33.5 mV s/rad give 26.8 V between two terminals.
  EXPECT_THAT(remarks_on(s), Contains(AllOf(HasSubstr("back-EMF of 26.8 V"), HasSubstr("bus of 24 V"))));
  s.initial.speed_rad_s = 700.0;
  EXPECT_THAT(remarks_on(s), IsEmpty());
}

TEST(Remarks, AWindingAboveItsLimit) {
  Scenario s = held(5.0);
  s.sheet.thermal_resistance_winding_housing_K_W = base::Quantity{4.0, "", ""};
  s.sheet.thermal_resistance_housing_ambient_K_W = base::Quantity{4.0, "", ""};
  s.sheet.thermal_time_constant_winding_s = base::Quantity{10.0, "", ""};
  s.sheet.thermal_time_constant_motor_s = base::Quantity{200.0, "", ""};
  s.sheet.max_winding_temperature_degC = base::Quantity{125.0, "", ""};
  s.heat.motor = true;
  s.heat.winding_degC = 130.0;
  EXPECT_THAT(remarks_on(s),
              Contains(AllOf(HasSubstr("the winding reached 13"), HasSubstr("allows 125 degC"))));
  s.heat.winding_degC = 100.0;
  EXPECT_THAT(remarks_on(s), IsEmpty());
}

/// By the values of the sheet, the winding is just below its limit. At the ends of their ranges, it is above
/// its limit. A winding that is far below its limit causes no remark.
TEST(Remarks, AWindingThatIsCoolByTheValuesAlone) {
  Scenario s = held(10.0);
  s.duration_s = 2.0;
  s.sheet.thermal_resistance_winding_housing_K_W = base::Quantity{4.0, "", ""};
  s.sheet.thermal_resistance_housing_ambient_K_W = base::Quantity{4.0, "", ""};
  base::Quantity winding_s{10.0, "", ""};
  winding_s.range = base::Interval{4.0, 10.0};
  s.sheet.thermal_time_constant_winding_s = winding_s;
  s.sheet.thermal_time_constant_motor_s = base::Quantity{200.0, "", ""};
  s.sheet.max_winding_temperature_degC = base::Quantity{125.0, "", ""};
  s.heat.motor = true;
  // 10 A in 1.03 ohm for two seconds are 206 J. The heat capacity is 2.5 J/K, or 1 J/K at the ends of the
  // ranges.
  EXPECT_THAT(remarks_on(s), Contains(AllOf(HasSubstr("the winding stayed below 125 degC"),
                                            HasSubstr("thermal_time_constant_winding_s = 4"))));
  s.duration_s = 0.2;
  EXPECT_THAT(remarks_on(s), ::testing::Not(Contains(HasSubstr("the winding stayed below"))));
}

TEST(Remarks, FewSamplesInACommutationStep) {
  Scenario s = drive_of(Mode::current, 0.0);
  s.duration_s = 2e-3;
  s.pwm.period_s = 300e-6;
  s.initial.speed_rad_s = 100.0;
  // (pi/3)/(8 x 100) = 1.309 ms are 4.36 periods of 300 us.
  EXPECT_THAT(remarks_on(s), Contains(HasSubstr("lasts 4.36 control periods")));
  s.initial.speed_rad_s = 70.0;
  EXPECT_THAT(remarks_on(s), IsEmpty());
}

/// In a field-oriented drive, three legs switch in each period. At an edge, no current is transferred from
/// one phase to another.
TEST(Remarks, AFieldOrientedDriveHasNoCommutationSteps) {
  Scenario s = drive_of(Mode::current, 0.0);
  s.sheet.back_emf = design::BackEmfShape::sine;
  s.duration_s = 2e-3;
  s.pwm.period_s = 300e-6;
  s.control.current.settle_s = 10e-3;
  s.initial.speed_rad_s = 100.0;
  for (const bool field : {false, true}) {
    s.pwm.alignment = field ? study::Alignment::centre : study::Alignment::edge;
    s.control.drive = field ? study::FirmwareKind::field : study::FirmwareKind::lean;
    const auto out = study::run(s);
    ASSERT_TRUE(out) << to_string(out.problems()[0]);
    const auto named = [](const std::string& text) { return text.find("commutation step") != text.npos; };
    EXPECT_EQ(std::count_if(out->remarks.begin(), out->remarks.end(), named), field ? 0 : 1);
  }
}

TEST(Remarks, ASessionTellsThemToo) {
  Scenario s = drive_of(Mode::off, 0.0);
  s.duration_s = 2e-3;
  s.initial.speed_rad_s = 800.0;
  auto session = study::Session::open(s);
  ASSERT_TRUE(session);
  session->advance(1e-3);
  const auto out = session->close();
  ASSERT_TRUE(out);
  EXPECT_THAT(out->remarks, Contains(HasSubstr("back-EMF")));
}

}  // namespace SIXSTEP_TEST_FILE
