// SPDX-License-Identifier: Apache-2.0
// Tests which scenarios run in the general kernel, what they need, and the outputs of these runs: energy
// balance, figures of merit, columns and checks.
#include "sixstep/study/compile/general_plant.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <span>
#include <vector>

#include "sixstep/design/sheet/thermal.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/general_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using study::Scenario;

Scenario duty() { return maxon_scenario(control::Mode::duty, 0.5); }

TEST(GeneralPlant, IsChosenByWhatOnlyItHas) {
  EXPECT_FALSE(study::needs_general_plant(duty()));
  for (const AsksForGeneral& ask : asks_for_general) {
    Scenario s = duty();
    ask.make(s);
    EXPECT_TRUE(study::needs_general_plant(s)) << ask.what;
  }
}

TEST(GeneralPlant, RunsAllOfThemWithBooksThatClose) {
  for (const AsksForGeneral& ask : asks_for_general) {
    Scenario s = duty();
    s.duration_s = 0.02;
    ask.make(s);
    const auto out = study::run(s);
    ASSERT_TRUE(out) << ask.what << ": " << base::to_string(out.problems()[0]);
    EXPECT_FALSE(out->fault) << ask.what;
    EXPECT_GT(out->energy->supplied, 0.1) << ask.what;
    EXPECT_LT(std::fabs(out->energy->electrical_residual), 1e-13) << ask.what;
    EXPECT_LT(std::fabs(out->energy->mechanical_residual), 1e-13) << ask.what;
  }
}

/// The capacitor stores a part of the returned energy, C (u^2 - U^2)/2. The rest becomes heat in the brake
/// resistor. While the bus is at 24 V, the source supplies a small part.
TEST(GeneralPlant, ABrakeResistorTakesWhatTheCapacitorDoesNotKeep) {
  Scenario s = maxon_scenario(control::Mode::current, -2.0);
  s.pwm.chopping = control::Chopping::complementary;
  s.duration_s = 0.03;
  s.initial.speed_rad_s = 300;
  s.supply.resistance_ohm = 0.05;
  s.supply.capacitance_F = 2e-3;
  s.supply.sinks = false;
  s.supply.brake_resistance_ohm = 5;
  s.supply.brake_on_V = 28;
  s.supply.brake_off_V = 27;
  s.compare = {{measure(study::MetricKind::final_value, study::Signal::bus_voltage), 0.0, ""},
               {measure(study::MetricKind::mean, study::Signal::source_current), 0.0, ""}};
  const auto out = study::run(s);
  ASSERT_TRUE(out) << base::to_string(out.problems()[0]);
  const double u = out->comparisons.at(0).measured, kept = 2e-3 * (u * u - 24.0 * 24.0) / 2;
  const double fed = 24.0 * s.duration_s * out->comparisons.at(1).measured;
  EXPECT_GT(out->energy->brake_resistor, 0.1);
  EXPECT_NEAR(out->energy->brake_resistor, fed - out->energy->supplied - kept, 1e-5);
}

/// The current U/(2 R) determines the initial heating of the winding, before heat flows to the housing. Later
/// the current follows R.
TEST(GeneralPlant, ALockedRotorWarmsUpAsTheSheetSays) {
  Scenario s = maxon_scenario(control::Mode::duty, 1.0);
  s.supply.voltage_V = 3;
  s.duration_s = 2;
  s.load.locked = true;
  give_thermal_lines(s);
  s.heat.motor = true;
  s.heat.ambient_degC = 30;
  s.record.columns = {"winding_degC", "housing_degC", "i_a_A"};
  s.record.grid_s = 0.5;
  std::vector<double> row;
  study::Listeners listeners;
  listeners.on_record = [&](std::span<const double> r) { row.assign(r.begin(), r.end()); };
  const auto out = study::run(s, listeners);
  ASSERT_TRUE(out) << base::to_string(out.problems()[0]);
  const auto model = design::thermal_model(s.sheet);
  ASSERT_TRUE(model);
  const double R = 2 * out->motor.machine.R_ohm, hot = 1 + design::copper_per_K * 5;
  const double I = 3 / (R * hot), P = I * I * R * hot, C_w = model->winding_s / model->winding_housing_K_W;
  const double rise = P / C_w * 2;  // the temperature rise before heat flows to the housing
  ASSERT_EQ(row.size(), 4u);
  EXPECT_NEAR(row[1] - 30, rise, 0.1 * rise);
  EXPECT_GT(row[1], 30.5);
  EXPECT_NEAR(row[3], 3 / (R * (1 + design::copper_per_K * (row[1] - 25))), 1e-4 * row[3]) << "R follows";
}

TEST(GeneralPlant, TellsWhatTheSwitchesLose) {
  Scenario s = maxon_scenario(control::Mode::duty, 0.5);
  s.load.locked = true;
  s.duration_s = 0.03;
  s.bridge = {.on_resistance_ohm = 0.02,
              .diode_drop_V = 0.7,
              .turn_on_J = 30e-6,
              .turn_off_J = 20e-6,
              .recovery_J = 5e-6,
              .energies_at_V = 48,
              .energies_at_A = 10,
              .junction_K_W = 2};
  study::Requirement r;
  r.measure = {.metric = study::MetricKind::switching_loss, .from_s = 0.024, .to_s = 0.027};
  r.min = 0;
  s.require = {r};
  std::vector<double> extremes;
  study::Requirement low = r, high = r;
  low.measure = {
      .metric = study::MetricKind::minimum, .signal = study::Signal::phase_a, .from_s = 0.024, .to_s = 0.027};
  high.measure = {
      .metric = study::MetricKind::maximum, .signal = study::Signal::phase_a, .from_s = 0.024, .to_s = 0.027};
  s.require.push_back(low);
  s.require.push_back(high);
  const auto out = study::run(s);
  ASSERT_TRUE(out) << base::to_string(out.problems()[0]);
  // The rotor is locked in sector 0, and leg a has soft chopping. Once per period, its upper switch turns on
  // at the minimum of the ripple and off at the maximum.
  const double bottom = out->verdicts[1].measured, top = out->verdicts[2].measured, per = 24.0 / 48 / 10;
  EXPECT_NEAR(out->verdicts[0].measured, (35e-6 * bottom + 20e-6 * top) * per / 30e-6, 1e-9);
  ASSERT_EQ(out->devices.size(), 6u);
  EXPECT_GT(out->devices[0].conduction_W, 0.5);
  EXPECT_GT(out->devices[1].diode_W, 1) << "a freewheels on its lower diode";
  EXPECT_GT(out->devices[1].recovery_W, 0);
  EXPECT_EQ(out->devices[1].turn_on_W, 0);
  const study::DeviceLoss& lower = out->devices[1];  // the diode and the switch are on the same chip
  EXPECT_NEAR(lower.junction_degC, 25 + 2 * (lower.conduction_W + lower.diode_W + lower.recovery_W), 1e-9);
  double all = 0;
  for (const auto& d : out->devices) all += (d.conduction_W + d.diode_W) * 0.03;
  EXPECT_NEAR(all, out->energy->devices, 1e-12);
}

TEST(GeneralPlant, IsGivenTheLeanOnesNumbersWhereItHasNoOthers) {
  Scenario s = duty();
  s.load.gear = 3;
  s.load.inertia_kg_m2 = 9e-5;
  const auto c = study::compile(s);
  ASSERT_TRUE(c && c->general);
  EXPECT_EQ(c->general->machine.R_ohm[1], c->motor.machine.R_ohm);
  EXPECT_EQ(c->general->machine.K_e_V_s[2], c->motor.machine.K_e_V_s);
  EXPECT_EQ(c->general->machine.L_H, c->motor.machine.L_H);
  EXPECT_NEAR(c->shaft.J_kg_m2, c->motor.shaft.J_kg_m2 + 1e-5, 1e-20) << "what design goes by";
}

TEST(GeneralPlant, GivesADeltasBranchesSixSeventhsOfTheTorqueConstant) {
  Scenario s = duty();
  s.sheet.connection = design::WindingConnection::delta;
  const auto c = study::compile(s);
  ASSERT_TRUE(c && c->general);
  EXPECT_NEAR(c->general->machine.K_e_V_s[0], c->motor.K_t_Nm_A * 6 / 7, 1e-17);
  EXPECT_NEAR(c->general->machine.R_ohm[0], 1.5 * 2 * c->motor.machine.R_ohm, 1e-15);
}

TEST(GeneralPlant, FiguresOfTheLoadAreThoseOfItsOwnSide) {
  Scenario s = duty();
  s.load.gear = 2;
  s.load.torque_Nm = 0.06;
  s.duration_s = 0.05;
  for (const study::Signal signal : {study::Signal::load_power, study::Signal::speed}) {
    study::Requirement r;
    r.measure.metric = study::MetricKind::mean;
    r.measure.signal = signal;
    r.measure.from_s = 0.04;
    r.min = -1e9;
    s.require.push_back(r);
  }
  const auto out = study::run(s);
  ASSERT_TRUE(out);
  EXPECT_NEAR(out->verdicts[0].measured, 0.06 * out->verdicts[1].measured / 2, 1e-9);
}

TEST(GeneralPlant, WhatContradictsIsNamed) {
  const auto first = [](const std::function<void(Scenario&)>& make) {
    Scenario s = duty();
    make(s);
    const base::Problems problems = study::check(s);
    return problems.empty() ? std::string() : problems[0].where;
  };
  EXPECT_EQ(first([](Scenario& s) { s.supply.inductance_H = 1e-6; }), "supply.inductance_H");
  EXPECT_EQ(first([](Scenario& s) { s.supply.brake_on_V = 30; }), "supply.brake_on_V");
  EXPECT_EQ(first([](Scenario& s) { s.load.stiffness_Nm_rad = 2; }), "load.stiffness_Nm_rad");
  EXPECT_EQ(first([](Scenario& s) { s.bridge.saturation_V = 1; }), "bridge.saturation_V");
  EXPECT_EQ(first([](Scenario& s) { s.sheet.harmonic_orders = {3}; }), "harmonic_sizes");
  EXPECT_EQ(first([](Scenario& s) {
              s.sheet.cogging_orders = {50};
              s.sheet.cogging_mNm = {1};
            }),
            "cogging_orders");
  EXPECT_EQ(first([](Scenario& s) { s.sheet.phase_resistance_deviation = {0.1}; }),
            "phase_resistance_deviation");
}

}  // namespace SIXSTEP_TEST_FILE
