// SPDX-License-Identifier: Apache-2.0
// Bench runs of all 36 ways to connect a motor. The measured behaviour is equal to the theory, although the
// runs do not use the theory.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/analysis/wiring/wiring_study.hpp"
#include "sixstep/study/check/check.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::WiringCase;
using analysis::WiringDoes;
using analysis::WiringMeasured;
using analysis::WiringStudy;

design::Sheet nominal_sheet() {
  design::Sheet s = maxon_sheet();
  s.nominal_current_A = base::Quantity{2.33, "terminal", ""};
  return s;
}

WiringStudy studied(const design::Sheet& sheet) {
  const base::Result<WiringStudy> s = analysis::study_wiring({.subject = {.motor = "m", .sheet = sheet}});
  if (!s) ADD_FAILURE() << to_string(s.problems()[0]);
  return s ? *s : WiringStudy{};
}

/// The torque per ampere differs from theory only during a commutation, which takes five time constants L/R
/// in each sector.
void expect_theory_and_runs_agree(const WiringStudy& s) {
  ASSERT_EQ(s.cases.size(), 36u);
  const double straight = s.cases.front().measured.torque_Nm_A;
  const double commutating =
      5 * (s.bench.motor.machine.L_H / s.bench.motor.machine.R_ohm) / (s.bench.turned_s / 6);
  EXPECT_NEAR(straight, s.cases.front().theory.mean_Nm_A, commutating * straight);
  for (const WiringCase& c : s.cases) {
    SCOPED_TRACE(::testing::Message()
                 << static_cast<int>(c.wiring.phases) << static_cast<int>(c.wiring.probes));
    EXPECT_TRUE(c.agrees()) << static_cast<int>(c.theory.does) << " " << static_cast<int>(c.measured.does);
    EXPECT_NEAR(c.measured.part, c.theory.part, commutating);
    for (const analysis::FreeRun& run : c.measured.runs) {
      EXPECT_LT(run.phase_rms_A, 1.25 * s.bench.current_A) << "nothing is burnt";
      if (c.theory.does != WiringDoes::hums) continue;
      double nearest = 360;
      for (const double rest : c.theory.rests_deg)
        nearest = std::min(nearest, std::fabs(std::remainder(run.rest_deg - rest, 360.0)));
      EXPECT_LT(nearest, 30) << "half a sector";
      EXPECT_GT(run.phase_rms_A, 0.7 * s.bench.current_A)
          << "as stalled: sqrt(2/3) of it where the pairs take turns";
    }
  }
}

TEST(WiringRuns, OfATrapezoidDoWhatTheorySays) {
  const WiringStudy s = studied(nominal_sheet());
  expect_theory_and_runs_agree(s);
  EXPECT_EQ(s.bench.from, analysis::BenchCurrent::nominal);
  EXPECT_NEAR(s.bench.duty, 2.33 / (24 / 1.03), 1e-15);
  EXPECT_EQ(s.symptom(WiringDoes::hums).ways, 18u);
  // The symptom on a bench is the current without load. A motor with a rough wiring draws half of the stalled
  // current; a motor with straight wires draws almost no current.
  EXPECT_NEAR(s.symptom(WiringDoes::forward_late).phase_rms_A, std::sqrt(2.0 / 3) * 0.5 * 2.33, 0.05 * 2.33);
  EXPECT_LT(s.symptom(WiringDoes::forward).phase_rms_A, 0.05 * 2.33);
  // A motor at constant speed takes from its supply exactly the losses of friction and copper.
  for (const WiringDoes does : {WiringDoes::forward, WiringDoes::backward, WiringDoes::forward_early,
                                WiringDoes::forward_late, WiringDoes::backward_early}) {
    const analysis::Symptom told = s.symptom(does);
    const double friction_W = s.bench.motor.shaft.B_Nm_s * told.speed_rad_s * told.speed_rad_s;
    const double copper_W = 3 * 0.515 * told.phase_rms_A * told.phase_rms_A;
    EXPECT_NEAR(24 * told.supply_A, friction_W + copper_W, 0.01 * (friction_W + copper_W)) << int(does);
  }
  EXPECT_GT(s.symptom(WiringDoes::forward_early).speed_rad_s,
            s.symptom(WiringDoes::forward_late).speed_rad_s);
}

/// A drone motor's winding current decays within a PWM period of 50 us. Its torque per ampere is still equal
/// to the theory.
TEST(WiringRuns, OfAShortTimeConstantHaveTheTorqueOfTheory) {
  design::Sheet sheet = nominal_sheet();
  sheet.inductance_mH->value = 0.02;
  sheet.inertia_gcm2->value = 20;  // reaches its speed quickly
  const base::Result<analysis::WiringBench> bench = analysis::wiring_bench({.motor = "m", .sheet = sheet});
  ASSERT_TRUE(bench);
  EXPECT_LT(bench->turned_pwm_s, bench->motor.machine.L_H / bench->motor.machine.R_ohm / 2.9);
  const WiringStudy s = studied(sheet);
  for (const WiringCase& c : s.cases) {
    EXPECT_TRUE(c.agrees());
    EXPECT_NEAR(c.measured.part, c.theory.part, 0.015)
        << static_cast<int>(c.wiring.phases) << static_cast<int>(c.wiring.probes);
  }
}

TEST(WiringRuns, OfADeltaWithHarmonicsDoWhatTheorySays) {
  design::Sheet sheet = nominal_sheet();
  sheet.connection = design::WindingConnection::delta;
  sheet.back_emf = design::BackEmfShape::sine;
  sheet.harmonic_orders = {5, 7};
  sheet.harmonic_sizes = {0.08, -0.04};
  expect_theory_and_runs_agree(studied(sheet));
}

TEST(WiringRuns, OfASalientMotorWithCoggingDoWhatTheorySays) {
  design::Sheet sheet = nominal_sheet();
  sheet.back_emf = design::BackEmfShape::sine;
  sheet.inductance_mH.reset();
  sheet.d_axis_inductance_mH = base::Quantity{0.24, "phase", ""};
  sheet.q_axis_inductance_mH = base::Quantity{0.34, "phase", ""};
  sheet.cogging_orders = {48};
  sheet.cogging_mNm = {3};
  expect_theory_and_runs_agree(studied(sheet));
}

/// Half of the torque does not overcome this friction, although the theory without friction predicts
/// rotation. The study reports the contradiction.
TEST(WiringRuns, ThatFrictionHoldsDisagreeAndSayHow) {
  design::Sheet sheet = nominal_sheet();
  // At this current, the full torque of the motor is 78 mN m.
  sheet.coulomb_friction_mNm = base::Quantity{60, "", ""};
  const WiringStudy s = studied(sheet);
  EXPECT_EQ(s.agreeing(), 24u);
  for (const WiringCase& c : s.cases)
    EXPECT_EQ(c.measured.does, analysis::runs_well(c.theory.does) ? c.theory.does : WiringDoes::hums);
}

/// Results of six starts, each with `turns` electrical turns in total. Half of these turns are within the
/// evaluated time.
WiringMeasured measured(std::array<double, 6> turns, double torque, std::array<float, 2> halves) {
  WiringMeasured m;
  for (std::size_t n = 0; n < 6; ++n) {
    m.runs[n].way_turns = turns[n];
    m.runs[n].turns = turns[n] / 2;
  }
  m.torque_Nm_A = torque;
  for (std::size_t n = 0; n < analysis::turned_rows; ++n) m.torque_over_turn.push_back(halves[n % 30 / 15]);
  return m;
}

TEST(WiringRuns, AreJudgedByWhatIsMeasuredAlone) {
  const auto all = [](double turns) {
    return std::array<double, 6>{turns, turns, turns, turns, turns, turns};
  };
  const auto seen = [](const WiringMeasured& m) { return analysis::seen_in(m, 1.0); };
  EXPECT_EQ(seen(measured(all(3), 0.9, {0.9F, 0.9F})), WiringDoes::forward);
  EXPECT_EQ(seen(measured(all(-3), -0.9, {-0.9F, -0.9F})), WiringDoes::backward);
  EXPECT_EQ(seen(measured(all(3), 0.5, {0.2F, 0.8F})), WiringDoes::forward_early);
  EXPECT_EQ(seen(measured(all(3), 0.5, {0.8F, 0.2F})), WiringDoes::forward_late);
  EXPECT_EQ(seen(measured(all(-3), -0.5, {-0.8F, -0.2F})), WiringDoes::backward_early);
  EXPECT_EQ(seen(measured(all(-3), -0.5, {-0.2F, -0.8F})), WiringDoes::backward_late);
  EXPECT_EQ(seen(measured(all(0.9), 0.9, {0.9F, 0.9F})), WiringDoes::hums) << "it did not get round";
  WiringMeasured held = measured(all(3), 0.9, {0.9F, 0.9F});
  for (analysis::FreeRun& run : held.runs) run.turns = 0.1;
  EXPECT_EQ(seen(held), WiringDoes::hums) << "it went round, and stands";
  EXPECT_EQ(seen(measured({3, 3, 3, 0, 3, 3}, 0.5, {0.2F, 0.8F})), WiringDoes::unclear);
  EXPECT_EQ(seen(measured({3, 3, 3, 3, 3, -3}, 0.9, {0.9F, 0.9F})), WiringDoes::unclear);
}

TEST(WiringBench, IsChosenFromTheSheet) {
  analysis::WiringSubject subject{.motor = "m", .sheet = maxon_sheet()};
  base::Result<analysis::WiringBench> b = analysis::wiring_bench(subject);
  ASSERT_TRUE(b);
  EXPECT_EQ(b->from, analysis::BenchCurrent::tenth_of_stall);
  EXPECT_NEAR(b->duty, 0.1, 1e-15);
  subject.voltage_V = 12;
  subject.current_A = 2.33;
  b = analysis::wiring_bench(subject);
  ASSERT_TRUE(b);
  EXPECT_EQ(b->from, analysis::BenchCurrent::asked_for);
  EXPECT_NEAR(b->duty * 12 / 1.03, 2.33, 1e-15);
  for (const rig::Wiring& w : analysis::all_wirings()) {
    EXPECT_TRUE(study::check(analysis::free_run(*b, subject, w, 30)).empty());
    EXPECT_TRUE(study::check(analysis::turned_run(*b, subject, w)).empty());
  }
}

TEST(WiringBench, TellsWhatItCannotBeOf) {
  const auto where = [](const analysis::WiringSubject& subject) {
    const auto b = analysis::wiring_bench(subject);
    return b ? std::string("nothing") : b.problems()[0].where;
  };
  design::Sheet silent = maxon_sheet(), heavy = maxon_sheet(), left_out = maxon_sheet();
  silent.nominal_voltage_V.reset();
  heavy.inertia_gcm2 = {135e6, "", ""};
  left_out.simulatable = false;
  left_out.not_simulatable_because = "nobody knows it";
  EXPECT_EQ(where({.motor = "m", .sheet = silent}), "voltage_V");
  EXPECT_EQ(where({.motor = "m", .sheet = maxon_sheet(), .voltage_V = -1.0}), "voltage_V");
  EXPECT_EQ(where({.motor = "m", .sheet = maxon_sheet(), .current_A = 0.0}), "current_A");
  EXPECT_EQ(where({.motor = "m", .sheet = maxon_sheet(), .current_A = 23.4}), "current_A");
  EXPECT_EQ(where({.motor = "m", .sheet = maxon_sheet(), .current_A = std::nan("")}), "current_A");
  EXPECT_EQ(where({.motor = "m", .sheet = heavy}), "current_A") << "252 runs of hours";
  EXPECT_EQ(where({.motor = "m", .sheet = left_out}), "simulatable");
}

TEST(WiringBench, RunsThatAreToldToStopEndAtOnce) {
  const auto s = analysis::study_wiring(
      {.subject = {.motor = "m", .sheet = maxon_sheet()}, .keep_going = [] { return false; }});
  ASSERT_FALSE(s);
  EXPECT_EQ(s.problems()[0].limit, "was interrupted");
}

}  // namespace SIXSTEP_TEST_FILE
