// SPDX-License-Identifier: Apache-2.0
// A user's controller in a scenario. The library's drive through this interface is equal to the built-in
// drive to the last bit. The controller's design receives its numbers and the values of the board. An answer
// that no timer can produce ends the run with a message.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "data/controllers/six_step_again.cpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/check/own.hpp"
#include "sixstep/study/scenario/own_numbers.hpp"
#include "sixstep/study/session/session.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using study::Scenario;

Scenario with(const sixstep_controller* own, Scenario s) {
  s.control.drive = study::FirmwareKind::own;
  s.control.own.controller = "in this file";
  s.control.own.loaded = own;
  return s;
}

std::uint64_t digest_of(const Scenario& s) {
  const auto out = study::run(s);
  if (!out) {
    ADD_FAILURE() << to_string(out.problems()[0]);
    return 0;
  }
  EXPECT_FALSE(out->fault) << to_string(*out->fault);
  return out->digest;
}

std::vector<Scenario> six_step_scenarios() {
  std::vector<Scenario> all{maxon_scenario(control::Mode::duty, -0.4), current_square(), cascade(),
                            maxon_scenario(control::Mode::position, 90.0)};
  all[3].control.position.gain_rad_s_per_deg = 0.5;
  const std::size_t plain = all.size();
  for (std::size_t n = 0; n < plain; ++n) {
    Scenario s = all[n];
    s.pwm.delay_periods = 1;
    s.pwm.chopping = n % 2 == 0 ? control::Chopping::hard : control::Chopping::complementary;
    s.bridge.dead_time_s = 0.5e-6;
    all.push_back(s);
    s.pwm.delay_periods = 0;
    s.pwm.alignment = study::Alignment::centre;
    s.pwm.sample = study::SampleAt::middle;
    s.sensors.currents = rig::CurrentMeasurement::phases;
    s.sensors.current_range_A = 40.0;
    s.sensors.current_noise_A = 0.02;
    s.sensors.rotor = study::RotorSensing::hall;
    all.push_back(s);
    s.pwm.commutation = study::CommutationAt::sample;
    s.sheet.back_emf = design::BackEmfShape::sine;
    s.sensors.hall_offset_deg = 1.5;  // needs the general kernel
    all.push_back(s);
  }
  return all;
}

TEST(OwnController, TheLibrarysDriveByThisDoorHasItsBits) {
  int turned = 0;
  for (const Scenario& s : six_step_scenarios()) {
    const std::uint64_t built_in = digest_of(s);
    EXPECT_EQ(digest_of(with(sixstep_own_controller(), s)), built_in) << "scenario " << turned;
    ++turned;
  }
  EXPECT_EQ(turned, 16);
}

/// The answer that a test sets, and the last inputs of the design function and of the step function.
sixstep_answer told{};
sixstep_given last_given{};
sixstep_measured last_seen{};
double last_values[2];
constexpr sixstep_parameter two_numbers[] = {{"first", "A", "one", 1.0, 0.0, 5.0},
                                             {"second", "", "other", -2.0, -3.0, 3.0}};

struct Puppet {
  struct Config {};
  struct State {};
  static constexpr const sixstep_parameter (&parameters)[2] = two_numbers;
  static const char* design(const sixstep_given& given, const double* values, Config&) {
    last_given = given;
    for (int n = 0; n < 2; ++n) last_values[n] = values[n];
    return values[0] == 5.0 ? "cannot have five" : nullptr;
  }
  static void step(const Config&, State&, const sixstep_measured& seen, double, sixstep_answer& answer) {
    last_seen = seen;
    answer = told;
  }
};

constexpr sixstep_controller pair_puppet =
    control::own_controller<Puppet>(SIXSTEP_ANSWERS_PAIR, "puppet", "it does as it is told");
constexpr sixstep_controller legs_puppet =
    control::own_controller<Puppet>(SIXSTEP_ANSWERS_LEGS, "puppet", "it does as it is told");

TEST(OwnController, IsDesignedByMotorBoardLoopsAndNumbers) {
  Scenario s = with(&pair_puppet, cascade());
  s.pwm.delay_periods = 1;
  s.control.own.number = {{"second", 2.5}};
  told = {};
  ASSERT_TRUE(study::run(s));
  EXPECT_EQ(last_values[0], 1.0);
  EXPECT_EQ(last_values[1], 2.5);
  const std::vector<study::UsedNumber> used = study::used_numbers(s.control.own);
  ASSERT_EQ(used.size(), 2u);
  for (std::size_t n = 0; n < used.size(); ++n) EXPECT_EQ(used[n].value, last_values[n]);
  EXPECT_TRUE(used[0].preset);
  EXPECT_FALSE(used[1].preset);
  EXPECT_EQ(last_given.mode, SIXSTEP_SPEED);
  EXPECT_EQ(last_given.delay_periods, 1);
  EXPECT_EQ(last_given.period_s, 30e-6);
  EXPECT_EQ(last_given.pole_pairs, 8);
  EXPECT_NEAR(last_given.R_ohm, 0.515, 1e-12);
  EXPECT_NEAR(last_given.L_H, 0.286e-3, 1e-12);
  EXPECT_NEAR(last_given.full_torque_Nm, 0.78, 1e-12);
  EXPECT_GT(last_given.current_d1, 0);
  EXPECT_LT(last_given.current_d0, 0);
  EXPECT_GT(last_given.speed_d1, 0);
  s.control.own.number = {{"first", 5.0}};
  const auto refused = study::run(s);
  ASSERT_FALSE(refused);
  EXPECT_EQ(
      to_string(refused.problems()[0]),
      "control.own puppet cannot have five; change the scenario, or the controller's numbers in control.own.number");
}

/// The magnet's direction has the accuracy of the sensors. Hall codes determine it only within a sector of 60
/// degrees.
TEST(OwnController, SeesTheMagnetAsItsSensorsDo) {
  told = {};
  const auto electrical_deg = [](study::RotorSensing rotor, rig::HallAngleFrom angle) {
    Scenario s = with(&legs_puppet, maxon_scenario(control::Mode::duty, 0.0));
    s.load.dynamometer_times_s = {0.0};
    s.load.dynamometer_rad_s = {100.0};
    s.sensors.rotor = rotor;
    s.sensors.hall_angle = angle;
    EXPECT_TRUE(study::run(s));
    const double behind = std::atan2(last_seen.magnet_sin, last_seen.magnet_cos) * 180 / base::pi + 150;
    return behind - 360 * std::floor(behind / 360);
  };
  const double last_s = std::ceil(20e-3 / 30e-6 - 1) * 30e-6, turned = 100.0 * 8 * last_s * 180 / base::pi;
  const double is = turned - 360 * std::floor(turned / 360), middle = 60 * std::floor(is / 60) + 30;
  EXPECT_NEAR(electrical_deg(study::RotorSensing::ideal, rig::HallAngleFrom::sectors), is, 1e-6);
  EXPECT_NEAR(electrical_deg(study::RotorSensing::hall, rig::HallAngleFrom::sectors), middle, 1e-9);
  EXPECT_GT(std::fabs(is - middle), 3.0);
  EXPECT_NEAR(electrical_deg(study::RotorSensing::hall, rig::HallAngleFrom::angle), is, 0.5);
}

/// The run checks the first answer in step 1. The message names the field of the answer and its value.
TEST(OwnController, WhatNoTimerDoesEndsTheRun) {
  const auto fault = [](const sixstep_controller& is, const sixstep_answer& answer) {
    told = answer;
    Scenario s = with(&is, maxon_scenario(control::Mode::duty, 0.2));
    s.control.own.controller = "puppet.so";
    const auto out = study::run(s);
    if (!out) return to_string(out.problems()[0]);
    return out->fault ? out->fault->limit : std::string("runs");
  };
  const auto answered = [](const std::string& what) { return "puppet.so: the controller answered " + what; };
  const sixstep_answer off{};
  EXPECT_EQ(fault(pair_puppet, off), "runs");
  EXPECT_EQ(fault(legs_puppet, off), "runs");
  sixstep_answer pair{};
  pair.enabled = 1, pair.source = 0, pair.sink = 1, pair.duty = 0.5;
  EXPECT_EQ(fault(pair_puppet, pair), "runs");
  const std::pair<double, const char*> duties[] = {{-0.1, "-0.1"},
                                                   {1.1, "1.1"},
                                                   {std::numeric_limits<double>::quiet_NaN(), "not a number"},
                                                   {HUGE_VAL, "infinite"}};
  for (const auto& [duty, written] : duties) {
    sixstep_answer wrong = pair;
    wrong.duty = duty;
    const std::string rest = std::string(written) + " in step 1, which must lie in 0 to 1";
    EXPECT_EQ(fault(pair_puppet, wrong), answered("duty = " + rest));
    sixstep_answer legs{};
    legs.enabled = 1, legs.leg[2] = {SIXSTEP_LEG_PWM, SIXSTEP_PWM_UPPER, duty};
    EXPECT_EQ(fault(legs_puppet, legs), answered("leg[2].duty = " + rest));
  }
  sixstep_answer wrong = pair;
  wrong.overlap = -1.5;
  EXPECT_EQ(fault(pair_puppet, wrong), answered("overlap = -1.5 in step 1, which must lie in -1 to 1"));
  wrong = pair;
  wrong.sink = 0;
  EXPECT_EQ(fault(pair_puppet, wrong), answered("sink = 0 in step 1, which is the same leg as source"));
  wrong.sink = 3;
  EXPECT_EQ(fault(pair_puppet, wrong), answered("sink = 3 in step 1, which is not a leg"));
  wrong = pair;
  wrong.chopping = 3;
  EXPECT_EQ(fault(pair_puppet, wrong),
            answered("chopping = 3 in step 1, which is not a value that own_controller.h defines"));
  wrong = {};
  wrong.enabled = 1, wrong.leg[0].state = 4;
  EXPECT_EQ(fault(legs_puppet, wrong),
            answered("leg[0].state = 4 in step 1, which is not a value that own_controller.h defines"));
  wrong = {};
  wrong.fault = 1;
  EXPECT_EQ(fault(pair_puppet, wrong), answered("fault = 1 in step 1: the controller reported a fault"));
  EXPECT_EQ(fault(legs_puppet, wrong), answered("fault = 1 in step 1: the controller reported a fault"));
}

/// The remark is printed if the current exceeds the given limit by a quarter or more. With a locked rotor,
/// the current is the duty times U/R.
TEST(OwnController, ACurrentBeyondWhatItWasGivenIsRemarked) {
  const auto remarks = [](double duty, std::optional<double> range_A) {
    Scenario s = with(&pair_puppet, cascade());
    told = {};
    told.enabled = 1, told.source = 0, told.sink = 1, told.duty = duty;
    s.load.locked = true;
    s.control.speed.torque_limit_Nm = 0.195;
    if (range_A) s.sensors.currents = rig::CurrentMeasurement::phases;
    s.sensors.current_range_A = range_A;
    const auto out = study::run(s);
    EXPECT_TRUE(out) << (out ? "" : to_string(out.problems()[0]));
    int given = 0, converters = 0;
    for (const std::string& text : out ? out->remarks : std::vector<std::string>{}) {
      given += text.find("the controller itself must keep") != std::string::npos;
      converters += text.find("the converters show at most") != std::string::npos;
    }
    return std::pair(given, converters);
  };
  const double limit_A = 0.195 / 0.0335, stall_A = 24 / (2 * 0.515);
  EXPECT_EQ(remarks(1.1 * limit_A / stall_A, {}), std::pair(0, 0));
  EXPECT_NEAR(last_given.current_limit_A, limit_A, 1e-9);
  EXPECT_EQ(remarks(1.4 * limit_A / stall_A, {}), std::pair(1, 0));
  EXPECT_EQ(remarks(0.29, 0.3 * stall_A), std::pair(0, 0));
  EXPECT_EQ(remarks(0.303, 0.3 * stall_A), std::pair(0, 1));
}

/// A remark names each key that has no effect on the controller. With and without such a key, the controller
/// receives the same values.
TEST(OwnController, KeysThatNothingReachesItFromAreNamed) {
  told = {};
  const auto remarks = [](const Scenario& s) {
    const auto out = study::run(s);
    EXPECT_TRUE(out) << (out ? "" : to_string(out.problems()[0]));
    std::string all;
    for (const std::string& text : out ? out->remarks : std::vector<std::string>{}) all += text + '\n';
    return all;
  };
  Scenario s = with(&pair_puppet, maxon_scenario(control::Mode::current, 3.0));
  s.control.speed.torque_limit_Nm.reset();
  s.duration_s = 1e-3;
  EXPECT_EQ(remarks(s).find("without effect"), std::string::npos);
  const double limit_A = last_given.current_limit_A;
  s.control.current.limit_A = 2.0;
  EXPECT_NE(remarks(s).find("keys without effect: control.current.limit_A (control.mode has no speed loop)"),
            std::string::npos);
  EXPECT_EQ(last_given.current_limit_A, limit_A);
  s = with(&pair_puppet, cascade());
  s.control.current.limit_A = 2.0;
  EXPECT_EQ(remarks(s).find("without effect"), std::string::npos);
  EXPECT_EQ(last_given.current_limit_A, 2.0) << "a cascade gives it to the controller";
}

std::vector<std::string> places(const base::Problems& problems) {
  std::vector<std::string> out;
  for (const base::Problem& p : problems) out.push_back(p.where);
  return out;
}

TEST(OwnController, WhatDoesNotGoWithItIsTold) {
  using Places = std::vector<std::string>;
  Scenario s = with(&pair_puppet, current_square());
  EXPECT_EQ(places(study::check(s)), Places{});
  s.control.own.number = {{"third", 1.0}, {"first", 6.0}, {"second", 0.0}, {"second", 1.0}};
  EXPECT_EQ(places(study::check(s)), (Places{"control.own.number[0].name", "control.own.number[1].value",
                                             "control.own.number[3].name"}));
  s.control.own.number.clear();
  s.control.arithmetic = study::Arithmetic::q15;
  s.control.current.feedback = study::CurrentFeedback::staying_phase;
  s.control.slew = 100.0;
  EXPECT_EQ(places(study::check(s)),
            (Places{"control.arithmetic", "control.current.feedback", "control.slew"}));
  s = with(&legs_puppet, current_square());
  ask(s, measure(study::MetricKind::commutation_error, study::Signal::current));
  EXPECT_EQ(places(study::check(s)), Places{"compare[0].metric"});
  s.control.own.loaded = &pair_puppet;
  EXPECT_EQ(places(study::check(s)), Places{});
  s = with(nullptr, current_square());
  EXPECT_EQ(places(study::check(s)), Places{"control.own.controller"});
  s.control.drive = study::FirmwareKind::lean;
  EXPECT_EQ(places(study::check(s)), Places{"control.own"});
}

TEST(OwnController, WhatItSaysOfItselfIsLookedAt) {
  using Places = std::vector<std::string>;
  EXPECT_EQ(places(study::check_controller(pair_puppet)), Places{});
  sixstep_controller is = pair_puppet;
  is.interface = 2;
  EXPECT_EQ(places(study::check_controller(is)), Places{"interface"});
  is = pair_puppet;
  is.answers = 2, is.name = "", is.state_bytes = 70000, is.step = nullptr;
  EXPECT_EQ(places(study::check_controller(is)), (Places{"answers", "name", "state_bytes", "step"}));
  const sixstep_parameter wrong[] = {{"a b", "", "", 0, 0, 1}, {"b", "", nullptr, 2, 0, 1}};
  is = pair_puppet;
  is.parameter = wrong;
  EXPECT_EQ(places(study::check_controller(is)),
            (Places{"parameter[0].name", "parameter[1].meaning", "parameter[1].preset"}));
}

/// A copied session continues like the original, because the controller's state and configuration are copied
/// as bytes.
TEST(OwnController, ASessionIsCutWhereOneLikes) {
  const Scenario s = with(sixstep_own_controller(), cascade());
  auto session = study::Session::open(s);
  ASSERT_TRUE(session);
  session->advance(2.5e-3);
  study::Session kept = *session;
  session->advance(s.duration_s);
  kept.advance(s.duration_s);
  const std::uint64_t uncut = digest_of(s);
  EXPECT_EQ(session->close()->digest, uncut);
  EXPECT_EQ(kept.close()->digest, uncut);
}

}  // namespace SIXSTEP_TEST_FILE
