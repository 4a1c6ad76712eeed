// SPDX-License-Identifier: Apache-2.0
// A header is refused in two cases although the run meets every requirement: the verdict on the design is
// bad, or a loop is unstable with a large inertia. The remedy in the message must make the refusal disappear.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/study/run/export_gate.hpp"
#include "sixstep/study/run/loop_stability.hpp"
#include "tests/support/bench.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::Scenario;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ExportVerdict, WhatItsDesignFoundStandsAgainstIt) {
  Scenario s = maxon_scenario(Mode::current, 3.0);
  s.not_usable = "the loop never settles";
  const base::Problems found = study::never_measured(s);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].where, "not_usable");
  EXPECT_THAT(found[0].limit, HasSubstr("the loop never settles"));
  s.duration_s = 1e-3;
  EXPECT_THAT(study::run(s)->remarks, Contains(HasSubstr("NOT USABLE: the loop never settles")));
}

/// The loop as a recurrence, sample by sample: i' = a i + (1 - a)/R u and u' = u + d1 e + d0 e_before
/// (current i, voltage u, error e), with `late` periods of delay. Returns whether the current grows.
bool grows(double d1, double d0, double R, double L, double T, int late) {
  const double a = std::exp(-R * T / L), b = (1 - a) / R;
  double i = 1.0, u = 0.0, e_before = 0.0, waits = 0.0, first = 0.0, last = 0.0;
  for (int n = 0; n < 4000; ++n) {
    const double e = -i;
    u += d1 * e + d0 * e_before;
    e_before = e;
    i = a * i + b * (late ? waits : u);
    waits = u;
    (n < 2000 ? first : last) = std::max(n < 2000 ? first : last, std::fabs(i));
    if (!(last < 1e6 && first < 1e6)) return true;
  }
  return last > first;
}

TEST(ExportVerdict, ALoopIsUnstableWhereItsRecurrenceGrows) {
  const auto motor = design::motor_model(maxon_scenario(Mode::current, 1.0).sheet);
  ASSERT_TRUE(motor);
  const double R = 2 * motor->machine.R_ohm, L = 2 * motor->machine.L_H;
  int unstable = 0;
  for (const int late : {0, 1})
    for (const double d1 : {2.0, 8.0, 14.0, 17.0, 21.0, 30.0, 34.0, 42.0}) {
      Scenario s = maxon_scenario(Mode::current, 1.0);
      s.pwm.delay_periods = late;
      const study::LoopGains gains{"current", d1, -0.95 * d1, "given as d1, d0", {}};
      const bool told = study::unstable_current_loop(s, *motor, gains).has_value();
      EXPECT_EQ(told, grows(d1, -0.95 * d1, R, L, s.pwm.period_s, late)) << d1 << ", late " << late;
      unstable += told;
    }
  EXPECT_GT(unstable, 3);
  EXPECT_LT(unstable, 13);
}

/// The speed is steady although the current oscillates.
TEST(ExportVerdict, AnUnstableCurrentLoopStandsAgainstIt) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.duration_s = 0.1;
  s.pwm.delay_periods = 1;
  s.bridge.dead_time_s = 500e-9;
  s.sensors.current_range_A = 60.0;
  s.require.push_back({measure(study::MetricKind::maximum, study::Signal::speed), {}, 150.0});
  for (const double settle_s : {1e-3, 0.1e-3}) {
    s.control.current.settle_s = settle_s;
    s.control.current.damping = 0.9;
    const auto run = study::clear_for_export(s);
    ASSERT_TRUE(run) << to_string(run.problems()[0]);
    EXPECT_TRUE(run->outcome.passed());
    std::string all;
    for (const base::Problem& p : run->unheld) all += to_string(p) + "\n";
    if (settle_s < 1e-3)
      EXPECT_THAT(all, HasSubstr("the current loop is unstable"));
    else
      EXPECT_THAT(all, IsEmpty());
  }
}

/// The drive brakes, and the bus cannot sink the energy. The advised larger capacitor removes the problem. A
/// smaller braking current does not.
TEST(ExportVerdict, TheCureOfAStopThatRaisesTheBusHolds) {
  Scenario s = braking_onto_a_small_bus();
  s.supply.sinks = false;
  const auto unheld = [](const Scenario& x) {
    const auto run = study::clear_for_export(x);
    EXPECT_TRUE(run) << to_string(run.problems()[0]);
    return run ? run->unheld : base::Problems{};
  };
  const base::Problems before = unheld(s);
  ASSERT_EQ(before.size(), 1u);
  EXPECT_THAT(before[0].cure,
              ::testing::AllOf(HasSubstr("capacitance_F"), HasSubstr("brake_resistance_ohm")));
  s.protection.brake_current_A = 1.0;
  EXPECT_EQ(unheld(s).size(), 1u) << "a weaker brake feeds it longer";
  s.protection.brake_current_A = 2.0;
  s.supply.capacitance_F = 20e-3;
  EXPECT_THAT(unheld(s), IsEmpty());
}

/// The stall current is lowered as the message says. It must then pass the check, even with a coarse
/// converter.
TEST(ExportVerdict, TheCureOfAStallThatIsNeverPassedHolds) {
  for (const int bits : {12, 6, 5, 4}) {
    Scenario s = product_scenario(Mode::speed, 100.0);
    s.pwm.delay_periods = 1;
    s.bridge.dead_time_s = 500e-9;
    s.sensors.adc_bits = bits;
    s.sensors.current_range_A = 33.0;
    s.control.current.limit_A = 6.0;
    s.protection.stall_current_A = 5.9;
    s.protection.stall_s = 0.05;
    s.require.push_back({measure(study::MetricKind::maximum, study::Signal::speed), {}, 150.0});
    const auto of_stall = [](const base::Problems& all) {
      for (const base::Problem& p : all)
        if (p.where == "protection.stall_current_A") return p.cure;
      return std::string();
    };
    const std::string cure = of_stall(study::never_measured(s));
    ASSERT_NE(cure, "") << bits;
    constexpr std::string_view lower = "lower this value, for example to ";
    if (!cure.starts_with(lower)) {
      EXPECT_THAT(cure, HasSubstr("raise sensors.adc_bits")) << bits;
      continue;
    }
    s.protection.stall_current_A = std::stod(cure.substr(lower.size()));
    EXPECT_EQ(of_stall(study::never_measured(s)), "") << bits << ": " << cure;
  }
}

/// Until shortly after the trip, braking and the energy of the windings raise the bus. Then the load turns
/// the coasting rotor backwards, J dw/dt = M - B w (load M, friction B). If the back-EMF raises the bus
/// further, the message must name the load as the cause of the highest voltage.
TEST(ExportVerdict, ABusThatALoadRaisesAfterATripIsNotBlamedOnBraking) {
  Scenario s = product_scenario(Mode::speed, 0.0);
  s.pwm.delay_periods = 1;
  s.bridge.dead_time_s = 500e-9;
  s.reference = {};
  s.reference.shape = study::Shape::steps;
  s.reference.times_s = {0.0, 0.3};
  s.reference.values = {400.0, 50.0};
  s.supply.resistance_ohm = 0.05;
  s.supply.capacitance_F = 100e-6;
  s.supply.sinks = false;
  s.sensors.bus_range_V = 100.0;
  s.protection.over_voltage_V = 30.0;
  s.protection.over_speed_rad_s = 700.0;
  s.control.speed.settle_s = 40e-3;
  s.load.coulomb_Nm = 0.0;
  s.require.push_back({measure(study::MetricKind::maximum, study::Signal::current), {}, 15.0});
  const double B = s.sheet.viscous_friction_Nm_s->value;
  for (const double torque_Nm : {0.02, 0.0})
    for (const double coasting_s : {0.05, 2.5}) {
      s.load.torque_Nm = torque_Nm;
      s.duration_s = 0.3 + coasting_s;
      const auto c = study::clear_for_export(s);
      ASSERT_TRUE(c) << to_string(c.problems()[0]);
      ASSERT_TRUE(c->outcome.trip);
      EXPECT_EQ(c->outcome.trip->reasons, std::vector<std::string>{"over-voltage"});
      const auto bus = std::find_if(c->unheld.begin(), c->unheld.end(),
                                    [](const base::Problem& p) { return p.where == "the bus"; });
      ASSERT_NE(bus, c->unheld.end());
      const double last_rad_s = torque_Nm / B, lasts_s = 1.35e-5 / B;
      const double speed_rad_s = last_rad_s - (last_rad_s + 400.0) * std::exp(-coasting_s / lasts_s);
      const double by_load_V = 33.5e-3 * speed_rad_s;
      const bool later = by_load_V > 45.0;
      EXPECT_EQ(later, torque_Nm > 0 && coasting_s > 1);
      EXPECT_THAT(bus->limit, HasSubstr(later ? "after the trip at 0.3" : "was raised by braking"));
      if (!later) continue;
      EXPECT_THAT(bus->limit, HasSubstr("load.torque_Nm = 0.02 turns the shaft"));
      EXPECT_NEAR(std::stod(bus->value) / by_load_V, 1, 0.1);
    }
}

}  // namespace SIXSTEP_TEST_FILE
