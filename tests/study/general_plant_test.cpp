// SPDX-License-Identifier: Apache-2.0
// Which scenarios the general kernel runs, what it is given, and that everything around a run knows it: books, figures,
// columns, sessions, checks.
#include "sixstep/study/compile/general_plant.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/session/session.hpp"
#include "tests/support/scenarios.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;
using study::Scenario;

Scenario duty() { return maxon_scenario(control::Mode::duty, 0.5); }

struct Asks {
  const char* what;
  std::function<void(Scenario&)> make;
};
const Asks asks[] = {
    {"gear", [](Scenario& s) { s.load.gear = 2; }},
    {"elastic shaft",
     [](Scenario& s) {
       s.load.stiffness_Nm_rad = 2;
       s.load.inertia_kg_m2 = 1e-5;
     }},
    {"fan", [](Scenario& s) { s.load.fan_Nm_s2 = 1e-8; }},
    {"weight", [](Scenario& s) { s.load.gravity_Nm = 0.01; }},
    {"IGBT", [](Scenario& s) { s.bridge.device = study::Device::igbt; }},
    {"bus inductance",
     [](Scenario& s) {
       s.supply.resistance_ohm = 0.1;
       s.supply.capacitance_F = 1e-3;
       s.supply.inductance_H = 1e-6;
     }},
    {"brake chopper",
     [](Scenario& s) {
       s.supply.resistance_ohm = 0.1;
       s.supply.capacitance_F = 1e-3;
       s.supply.brake_resistance_ohm = 2;
       s.supply.brake_on_V = 30;
       s.supply.brake_off_V = 28;
     }},
    {"delta", [](Scenario& s) { s.sheet.connection = design::WindingConnection::delta; }},
    {"harmonics",
     [](Scenario& s) {
       s.sheet.back_emf = design::BackEmfShape::sine;
       s.sheet.harmonic_orders = {3, 5};
       s.sheet.harmonic_sizes = {0.1, 0.05};
     }},
    {"phases that stray",
     [](Scenario& s) {
       s.sheet.phase_resistance_deviation = {0.05, -0.05, 0};
     }},
    {"cogging",
     [](Scenario& s) {
       s.sheet.cogging_orders = {48};
       s.sheet.cogging_mNm = {5};
     }},
    {"saliency",
     [](Scenario& s) {
       s.sheet.inductance_mH.reset();
       s.sheet.d_axis_inductance_mH = base::Quantity{0.24, "phase", ""};
       s.sheet.q_axis_inductance_mH = base::Quantity{0.34, "phase", ""};
     }},
    {"broken wire",
     [](Scenario& s) {
       study::At at;
       at.time_s = 0.01;
       at.motor.broken_wire = study::Wire::b;
       s.at.push_back(at);
     }},
};

TEST(GeneralPlant, IsChosenByWhatOnlyItHas) {
  EXPECT_FALSE(study::needs_general_plant(duty()));
  for (const Asks& ask : asks) {
    Scenario s = duty();
    ask.make(s);
    EXPECT_TRUE(study::needs_general_plant(s)) << ask.what;
  }
}

TEST(GeneralPlant, RunsAllOfThemWithBooksThatClose) {
  for (const Asks& ask : asks) {
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

TEST(GeneralPlant, NoSessionRunsItYetAndSaysSo) {
  Scenario s = duty();
  s.load.gear = 2;
  const auto session = study::Session::open(s);
  ASSERT_FALSE(session);
  EXPECT_THAT(base::to_string(session.problems()[0]), ::testing::HasSubstr("no session runs yet"));
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

}  // namespace
