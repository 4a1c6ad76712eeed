// SPDX-License-Identifier: Apache-2.0
// Controllers from shared objects. The controllers of data/ behave in scenarios as documented. Other files
// are refused with the reason.
#include "files/controller_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "files/scenario_on_disk.hpp"
#include "files/text_file.hpp"
#include "sixstep/study/run/run.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;

const std::string folder = SIXSTEP_CONTROLLERS;

std::string told(const std::string& file) {
  const auto loaded = files::load_controller(folder + "/" + file);
  return loaded ? std::string("loaded ") + loaded->controller->name : to_string(loaded.problems()[0]);
}

TEST(ControllerFile, WhatIsNoneIsToldAsSuch) {
  EXPECT_EQ(told("sine_voltage.so"), "loaded sine voltage");
  EXPECT_EQ(told("nowhere.so").find(folder + "/nowhere.so cannot be read: "), 0u) << told("nowhere.so");
  EXPECT_EQ(
      told("no_symbol.so"),
      folder +
          "/no_symbol.so cannot be loaded: it has no function sixstep_own_controller; compile the controller with -shared -fPIC for this machine (docs/howto/write-a-controller.md)");
  EXPECT_EQ(
      told("answers_nothing.so")
          .find(folder + "/answers_nothing.so cannot be loaded: sixstep_own_controller returned a null"),
      0u);
  EXPECT_EQ(
      told("other_interface.so"),
      folder +
          "/other_interface.so has a controller whose interface = 2 is not 1, the interface of this program: compile the controller with this program's own_controller.h; correct this member as sixstep/control/own/own_controller.h describes it");
  EXPECT_EQ(told("in_float.so"),
            folder +
                "/in_float.so has a controller whose interface = 257 is compiled for float, and this program "
                "needs double; compile the controller without -DSIXSTEP_REAL=float");
  const std::string text = ::testing::TempDir() + "text.so";
  std::ofstream(text) << "no machine code\n";
  const auto loaded = files::load_controller(text);
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.problems()[0].limit.find("is not a compiled library"), std::string::npos)
      << loaded.problems()[0].limit;
}

base::Result<study::Scenario> read(const std::string& controller, const std::string& more) {
  const std::string path = folder + "/scenario.toml";
  return files::read_scenario_text(path, "motor = \"maxon-251601\"\nduration_s = 0.02\n" + more +
                                             "\n[control.own]\ncontroller = \"" + controller + "\"\n");
}

double final_of(const study::Scenario& given, study::MetricKind metric, study::Signal signal, double from_s) {
  study::Scenario s = given;
  study::Measure measure;
  measure.metric = metric;
  measure.signal = signal;
  measure.from_s = from_s;
  s.compare.push_back({measure, 0.0, ""});
  const auto out = study::run(s);
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  if (out && out->fault) ADD_FAILURE() << to_string(*out->fault);
  return out ? out->comparisons[0].measured : NAN;
}

/// The drive controls current and speed. The tolerance is the steps of the integers, in mA, and half the PWM
/// ripple, which a sample does not contain.
TEST(ControllerFile, IntegersHoldCurrentAndSpeed) {
  for (const double wanted : {3.0, -2.0}) {
    const auto current = read("pi_in_integers.so",
                              "[control]\ndrive = \"own\"\nmode = \"current\"\n[load]\nlocked = true\n"
                              "[reference]\nvalue = " +
                                  std::to_string(wanted));
    ASSERT_TRUE(current) << to_string(current.problems()[0]);
    EXPECT_NEAR(final_of(*current, study::MetricKind::mean, study::Signal::current, 0.01), wanted, 0.25);
  }
  const auto speed = read("pi_in_integers.so",
                          "[control]\ndrive = \"own\"\nmode = \"speed\"\n[control.speed]\nsettle_s = 5e-3\n"
                          "torque_limit_Nm = 0.3\n[reference]\nvalue = 100");
  ASSERT_TRUE(speed) << to_string(speed.problems()[0]);
  EXPECT_NEAR(final_of(*speed, study::MetricKind::mean, study::Signal::speed, 0.015), 100.0, 0.5);
}

/// The rotor is locked at angle 0, so only the winding has an effect. The current across the magnet is half
/// the bus voltage times the duty, divided by R. The magnet is 150 degrees behind the axis of phase a.
TEST(ControllerFile, ThreeLegsMakeAVectorAcrossTheMagnet) {
  const auto s =
      read("sine_voltage.so",
           "[control]\ndrive = \"own\"\nmode = \"duty\"\n[pwm]\nalignment = \"centre\"\n[load]\nlocked = "
           "true\n[reference]\nvalue = 0.2");
  ASSERT_TRUE(s) << to_string(s.problems()[0]);
  const double amplitude_A = 0.2 * 12.0 / 0.515, magnet = -5 * 3.14159265358979 / 6;
  const auto mean = [&](study::Signal phase) {
    return final_of(*s, study::MetricKind::mean, phase, 0.0199800);
  };
  EXPECT_NEAR(mean(study::Signal::phase_a), -amplitude_A * std::sin(magnet), 0.01);
  EXPECT_NEAR(mean(study::Signal::phase_b), -amplitude_A * std::sin(magnet - 2 * 3.14159265358979 / 3), 0.01);
}

TEST(ControllerFile, ScenariosTellWhatTheyCannotHave) {
  const auto first = [](const base::Result<study::Scenario>& read) {
    return read ? std::string("read") : to_string(read.problems()[0]);
  };
  const std::string drive = "[control]\ndrive = \"own\"\nmode = \"current\"\n[reference]\nvalue = 1";
  EXPECT_NE(first(read("nowhere.so", drive)).find("names " + folder + "/nowhere.so, which"),
            std::string::npos)
      << first(read("nowhere.so", drive));
  EXPECT_NE(first(read("sine_voltage.so", drive + "\n[control.current]\ntype = \"hysteresis\""))
                .find("control.current.type"),
            std::string::npos);
  const auto refused = study::run(*read("sine_voltage.so", drive));
  ASSERT_FALSE(refused);
  EXPECT_EQ(
      to_string(refused.problems()[0]),
      "control.own sine voltage has no loop: set control.mode = \"duty\"; change the scenario, or the controller's numbers in control.own.number");
}

/// The digest of the inputs includes the bytes of the controller. A store therefore detects a recompiled
/// controller.
TEST(ControllerFile, ItsBytesCountAsRead) {
  const auto digest = [](const std::string& controller) {
    files::ReadLog log;
    EXPECT_TRUE(files::load_controller(folder + "/" + controller));
    return log.digest();
  };
  EXPECT_EQ(digest("sine_voltage.so"), digest("sine_voltage.so"));
  EXPECT_NE(digest("sine_voltage.so"), digest("pi_in_integers.so"));
}

}  // namespace SIXSTEP_TEST_FILE
