// SPDX-License-Identifier: Apache-2.0
// Each member of a specification has an effect. In each mode, method and kind of sensor, a changed member
// changes the design or its run, or the member is refused by name.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sixstep/analysis/verify/design_scenario.hpp"
#include "sixstep/design/loops/spec_use.hpp"
#include "tests/support/bench.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using control::Mode;
using design::DesignSpec;
using design::DriveDesign;
using design::GainMethod;

const analysis::DesignSubject subject{"maxon-251601", sixstep::testing::maxon_sheet(), {}};

struct Member {
  const char* name;
  void (*change)(DesignSpec&);
};

const Member members[] = {
    {"settle_s", [](DesignSpec& w) { w.settle_s = w.mode == Mode::current ? 2e-3 : 60e-3; }},
    {"current_settle_s", [](DesignSpec& w) { w.current_settle_s = 2e-3; }},
    {"damping", [](DesignSpec& w) { w.damping = 0.8; }},
    {"bandwidth_rad_s", [](DesignSpec& w) { w.bandwidth_rad_s = 777.0; }},
    {"period_s", [](DesignSpec& w) { w.period_s = 25e-6; }},
    {"voltage_V", [](DesignSpec& w) { w.voltage_V = 30.0; }},
    {"torque_limit_Nm", [](DesignSpec& w) { w.torque_limit_Nm = 0.3; }},
    {"load_inertia_kg_m2", [](DesignSpec& w) { w.load_inertia_kg_m2 = 5e-6; }},
    {"delay_periods", [](DesignSpec& w) { w.delay_periods = 0; }},
    {"chopping", [](DesignSpec& w) { w.chopping = control::Chopping::complementary; }},
    {"edges", [](DesignSpec& w) { w.rotor.edges = 3; }},
    {"lowest_speed_rad_s", [](DesignSpec& w) { w.lowest_speed_rad_s = 55.0; }},
};

/// Results of a design without the values that the specification requests: gains and figures of each loop,
/// the number of warnings, and the values of the run.
std::vector<double> result_of(const DesignSpec& w) {
  const auto d = design::design_drive(*design::motor_model(subject.sheet), w);
  if (!d) return {};
  std::vector<double> out;
  for (const design::LoopDesign& loop : d->loops) {
    for (const double x : {loop.gains.d1, loop.gains.d0, loop.figures.crossover_rad_s.value_or(0),
                           loop.built.crossover_rad_s.value_or(0), loop.built.phase_rad.value_or(0),
                           loop.other.phase_rad.value_or(0), loop.step.settling_s})
      out.push_back(x);
  }
  out.push_back(static_cast<double>(d->warnings.size()));
  const study::Scenario s = analysis::design_scenario(*d, subject);
  for (const double x :
       {s.duration_s, s.pwm.period_s, s.supply.voltage_V, s.reference.value, s.load.torque_Nm,
        static_cast<double>(s.pwm.delay_periods), static_cast<double>(s.pwm.chopping)})
    out.push_back(x);
  return out;
}

void walk(const DesignSpec& w, const std::string& where) {
  const std::vector<double> before = result_of(w);
  ASSERT_FALSE(before.empty()) << where;
  for (const Member& m : members) {
    SCOPED_TRACE(std::string(m.name) + where);
    DesignSpec changed = w;
    m.change(changed);
    // Impossible designs are refused by name in tests/design/drive_design_test.cpp.
    const std::vector<double> after = result_of(changed);
    if (const auto idle = design::without_use(changed, m.name)) {
      EXPECT_EQ(idle->where, m.name);
      EXPECT_FALSE(idle->limit.empty() || idle->cure.empty());
    } else {
      EXPECT_NE(after, before) << "given, and without effect";
    }
  }
}

TEST(SpecUse, EachMemberChangesTheDesignOrIsRefusedByName) {
  for (const Mode mode : {Mode::current, Mode::speed, Mode::position})
    for (const GainMethod method :
         {GainMethod::pole_placement, GainMethod::cancellation, GainMethod::symmetrical_optimum})
      for (const bool hall : {true, false})
        for (const bool bandwidth : {false, true}) {
          if (method == GainMethod::symmetrical_optimum && mode == Mode::current) continue;
          if (method == GainMethod::pole_placement && bandwidth) continue;
          // A position loop contains the speed loop of the same method. These methods are therefore tested in
          // speed mode only.
          if (method != GainMethod::pole_placement && mode == Mode::position) continue;
          DesignSpec w = design::on_a_board();
          w.mode = mode;
          w.method = method;
          w.rotor.hall = hall;
          if (bandwidth) w.bandwidth_rad_s = method == GainMethod::cancellation ? 4000.0 : 500.0;
          walk(w, " in mode " + std::to_string(static_cast<int>(mode)) + ", method " +
                      std::to_string(static_cast<int>(method)) + (hall ? ", Hall" : ", ideal") +
                      (bandwidth ? ", by bandwidth" : ""));
        }
}

/// A member that is refused as unused must change no result.
TEST(SpecUse, WhatIsRefusedChangesNothing) {
  for (const Mode mode : {Mode::current, Mode::speed, Mode::position})
    for (const bool hall : {true, false}) {
      DesignSpec w = design::on_a_board();
      w.mode = mode;
      w.rotor.hall = hall;
      for (const Member& m : members) {
        DesignSpec changed = w;
        m.change(changed);
        if (design::without_use(changed, m.name)) {
          EXPECT_EQ(result_of(changed), result_of(w)) << m.name << ' ' << static_cast<int>(mode) << hall;
        }
      }
    }
}

}  // namespace SIXSTEP_TEST_FILE
