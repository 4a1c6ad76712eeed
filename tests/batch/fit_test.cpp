// SPDX-License-Identifier: Apache-2.0
// Motors are fitted to simulated recordings. The results are compared with the true constants.
#include "batch/fit/fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/batch/drawn_bench.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::Fit;
using analysis::FittedValue;
using batch::FitBench;
using study::ColumnId;
using ::testing::HasSubstr;

const FittedValue* value_of(const Fit& fit, const std::string& key) {
  for (const FittedValue& v : fit.values)
    if (v.key == key) return &v;
  return nullptr;
}
double fitted(const Fit& fit, const std::string& key) {
  const FittedValue* const v = value_of(fit, key);
  return v ? v->value.value : NAN;
}
const analysis::Undetermined* undetermined(const Fit& fit, const std::string& key) {
  for (const auto& u : fit.undetermined)
    if (u.key == key) return &u;
  return nullptr;
}

const BenchMotor truth{1.2, 0.6, 30.0, 60.0, 2e-6, 4.0}, guess{1.0, 0.8, 36.0, 45.0, 3e-6, 2.5};

FitBench bench(Bench kind, const std::vector<ColumnId>& columns, double interval_s,
               const std::vector<Instrument>& by, Draw& draw) {
  FitBench b{"log", bench_scenario(kind, truth), {}, 0.0};
  b.log = recorded(b.scenario, columns, interval_s, by, draw);
  b.scenario.sheet = sheet_of(guess);
  return b;
}

// Without noise the fit finds the constants of the simulation to the accuracy of its arithmetic.
TEST(Fit, ExactRecordingsGiveTheExactConstants) {
  Draw draw(1);
  batch::FitRequest request;
  request.benches = {bench(Bench::locked_pulse, {ColumnId::i_a}, 20e-6, {{}}, draw),
                     bench(Bench::run_up, {ColumnId::i_a, ColumnId::speed}, 200e-6, {{}, {}}, draw),
                     bench(Bench::coast_down, {ColumnId::speed}, 1e-3, {{}}, draw)};
  const auto found = batch::fit(request);
  ASSERT_TRUE(found) << to_string(found.problems()[0]);
  EXPECT_TRUE(found->converged);
  EXPECT_NEAR(fitted(*found, "motor_override.resistance_ohm"), truth.R_ohm, 1e-5 * truth.R_ohm);
  EXPECT_NEAR(fitted(*found, "motor_override.inductance_mH"), truth.L_mH, 1e-5 * truth.L_mH);
  EXPECT_NEAR(fitted(*found, "motor_override.torque_constant_mNm_A"), truth.K_mNm_A, 1e-5 * truth.K_mNm_A);
  EXPECT_NEAR(fitted(*found, "motor_override.inertia_gcm2"), truth.J_gcm2, 1e-5 * truth.J_gcm2);
  EXPECT_NEAR(fitted(*found, "motor_override.viscous_friction_Nm_s"), truth.viscous_Nm_s,
              1e-4 * truth.viscous_Nm_s);
  EXPECT_NEAR(fitted(*found, "motor_override.coulomb_friction_mNm"), truth.coulomb_mNm,
              1e-4 * truth.coulomb_mNm);
  EXPECT_TRUE(found->undetermined.empty());
  std::printf("%zu simulations\n", found->simulations);
}

// The current of a locked rotor depends on R and L only.
TEST(Fit, SaysWhatARecordingDoesNotDetermine) {
  Draw draw(2);
  batch::FitRequest request;
  request.benches = {
      bench(Bench::locked_pulse, {ColumnId::i_a}, 20e-6, {{.noise = 0.05, .offset = 0.1}}, draw)};
  const auto found = batch::fit(request);
  ASSERT_TRUE(found) << to_string(found.problems()[0]);
  EXPECT_TRUE(value_of(*found, "motor_override.resistance_ohm")->value.holds(truth.R_ohm));
  EXPECT_TRUE(value_of(*found, "motor_override.inductance_mH")->value.holds(truth.L_mH));
  EXPECT_NEAR(fitted(*found, "offset.i_a_A"), 0.1, 0.02);
  for (const char* key :
       {"torque_constant_mNm_A", "inertia_gcm2", "viscous_friction_Nm_s", "coulomb_friction_mNm"}) {
    const auto* const out = undetermined(*found, std::string("motor_override.") + key);
    ASSERT_TRUE(out) << key;
    EXPECT_THAT(out->reason, HasSubstr("depends")) << key;
    EXPECT_FALSE(out->recording.empty()) << key;
  }
}

// The scale of the probe is unknown. The end value U d/R then determines only the ratio of scale and R. The
// rise determines L/R, so L is also known only relative to R.
TEST(Fit, AnUnknownScaleAndTheResistanceCannotBeToldApart) {
  Draw draw(3);
  batch::FitRequest request;
  request.benches = {
      bench(Bench::locked_pulse, {ColumnId::i_a}, 20e-6, {{.noise = 0.02, .gain = 0.8}}, draw)};
  request.benches[0].scenario.bridge.diode_drop_V = 0.0;
  request.free = {"gain", "motor_override.inductance_mH", "motor_override.resistance_ohm"};
  const auto found = batch::fit(request);
  ASSERT_TRUE(found) << to_string(found.problems()[0]);
  // The scale keeps its start 1, and R follows from the end value of the current, which the probe shows as 0.8 times it.
  ASSERT_EQ(found->undetermined.size(), 1U);
  EXPECT_THAT(undetermined(*found, "gain.i_a_A")->reason, HasSubstr("motor_override.resistance_ohm"));
  // The log has diodes of 0.8 V, and the scenario has none: the end value belongs to 0.3 24 V - 0.7 0.8 V.
  EXPECT_NEAR(fitted(*found, "motor_override.resistance_ohm"), truth.R_ohm / 0.8 * 7.2 / (7.2 - 0.56),
              0.01 * truth.R_ohm);
  EXPECT_NEAR(
      fitted(*found, "motor_override.inductance_mH") / fitted(*found, "motor_override.resistance_ohm"),
      truth.L_mH / truth.R_ohm, 0.03 * truth.L_mH / truth.R_ohm);
}

// Coasting shows the ratio of friction to inertia, but neither friction nor inertia alone.
TEST(Fit, CoastingDoesNotDetermineTheInertia) {
  Draw draw(4);
  batch::FitRequest request;
  request.benches = {bench(Bench::coast_down, {ColumnId::speed}, 1e-3, {{.noise = 0.5}}, draw)};
  auto found = batch::fit(request);
  ASSERT_TRUE(found) << to_string(found.problems()[0]);
  EXPECT_TRUE(undetermined(*found, "motor_override.inertia_gcm2"));
  // The frictions hold for the inertia that the fit kept.
  const double kept = guess.J_gcm2 / truth.J_gcm2;
  EXPECT_NEAR(fitted(*found, "motor_override.viscous_friction_Nm_s"), kept * truth.viscous_Nm_s,
              0.1 * truth.viscous_Nm_s);
  EXPECT_NEAR(fitted(*found, "motor_override.coulomb_friction_mNm"), kept * truth.coulomb_mNm,
              0.03 * truth.coulomb_mNm);
  // If the scenario contains the true inertia, the fit determines the frictions.
  request.free = {"motor_override.viscous_friction_Nm_s", "motor_override.coulomb_friction_mNm", "offset"};
  request.benches[0].scenario.sheet.inertia_gcm2->value = truth.J_gcm2;
  found = batch::fit(request);
  ASSERT_TRUE(found) << to_string(found.problems()[0]);
  EXPECT_TRUE(value_of(*found, "motor_override.viscous_friction_Nm_s")->value.holds(truth.viscous_Nm_s));
  EXPECT_TRUE(value_of(*found, "motor_override.coulomb_friction_mNm")->value.holds(truth.coulomb_mNm));
}

}  // namespace SIXSTEP_TEST_FILE
