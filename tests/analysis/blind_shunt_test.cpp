// SPDX-License-Identifier: Apache-2.0
// A single shunt measures the current only above a certain duty. These tests compare the design's warning
// about smaller currents with the formula for this duty, and with a run.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/analysis/verify/blind_shunt.hpp"
#include "sixstep/analysis/verify/run_warnings.hpp"
#include "sixstep/study/run/run.hpp"
#include "text/scenario/scenario_file.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::analysis;
using control::Mode;

base::Result<DesignStudy> designed(const char* motor, Mode mode, std::optional<double> step = {},
                                   rig::CurrentMeasurement currents = rig::CurrentMeasurement::dc_link) {
  DesignOrder order{.subject = {.motor = motor, .sheet = *text::read_sheet(motor)},
                    .spec = design::on_a_board(),
                    .advises = false};
  order.spec.mode = mode;
  order.subject.step = step;
  order.subject.currents = currents;
  return study_design(order);
}

const design::Warning* of_shunt(const DesignStudy& s) {
  for (const design::Warning& w : s.warnings)
    if (w.of == design::Concern::shunt) return &w;
  return nullptr;
}

/// The shunt's amplifier settles in 1 us, and a measurement needs two settling times. In a period of 30 us,
/// the smallest measurable duty is 2/30. The smallest measurable current is this duty times 24 V/1.03 ohm.
TEST(BlindShunt, ASmallerStepThanItSeesIsGrave) {
  const double unseen_A = 2 * 1e-6 / 30e-6 * 24 / 1.03;
  for (const double part : {0.5, 1.2}) {
    const auto study = designed("maxon-251601", Mode::current, part * unseen_A);
    ASSERT_TRUE(study) << to_string(study.problems().front());
    EXPECT_NEAR(unseen_current_A(study->design, study->scenario), unseen_A, 1e-12);
    ASSERT_TRUE(of_shunt(*study));
    EXPECT_EQ(of_shunt(*study)->grave, part < 1.0);
    EXPECT_NE(of_shunt(*study)->what.find("below 1.55 A"), std::string::npos) << of_shunt(*study)->what;
  }
}

TEST(BlindShunt, TheStepThatNobodyChoseIsSeen) {
  for (const char* motor : {"anaheim-bly172s", "maxon-251601"}) {
    const auto study = designed(motor, Mode::current);
    ASSERT_TRUE(study) << to_string(study.problems().front());
    EXPECT_GT(study->scenario.reference.value, unseen_current_A(study->design, study->scenario)) << motor;
    EXPECT_TRUE(study->usable()) << motor << ": " << study->warnings.front().what;
  }
}

/// With half the nominal torque as load, the run with one shunt passes. Without a load, the speed oscillates
/// with one shunt, but not with phase current sensors.
TEST(BlindShunt, ASpeedThatSwingsWithoutALoadIsNotUsable) {
  for (const auto currents : {rig::CurrentMeasurement::dc_link, rig::CurrentMeasurement::phases}) {
    const auto study = designed("teknic-m2310p", Mode::speed, {}, currents);
    ASSERT_TRUE(study) << to_string(study.problems().front());
    study::Scenario idle = study->scenario;
    idle.load.torque_Nm = 0.0;
    const auto run = study::run(idle);
    ASSERT_TRUE(run);
    const bool swings = figure_of(*run, "speed ripple")->measured > *study->allowed_swing_rad_s;
    EXPECT_EQ(swings, currents == rig::CurrentMeasurement::dc_link);
    EXPECT_LT(figure_of(study->outcome, "speed ripple")->measured, *study->allowed_swing_rad_s) << "loaded";
    EXPECT_EQ(study->usable(), !swings);
    EXPECT_EQ(of_shunt(*study) != nullptr, swings);
  }
}

/// Three shunts in the legs show a pair's current at every duty; two do not in every sector, and with one a third of
/// the sectors is not measured at all.
TEST(BlindShunt, ShuntsInTheLegsHideNothingIfThereAreThree) {
  using study::ShuntLegs;
  for (const ShuntLegs shunts : {ShuntLegs::abc, ShuntLegs::ab, ShuntLegs::a}) {
    study::Scenario board;
    board.motor = "maxon-251601";
    board.sheet = *text::read_sheet(board.motor);
    board.sensors.currents = rig::CurrentMeasurement::low_side;
    board.sensors.current_range_A = 20.0;
    board.sensors.shunts = shunts;
    DesignOrder order{.subject = {.motor = board.motor, .sheet = board.sheet},
                      .spec = design::on_a_board(),
                      .advises = false};
    order.spec.mode = Mode::current;
    order.subject.board = board;
    const auto study = study_design(order);
    ASSERT_TRUE(study) << to_string(study.problems().front());
    ASSERT_EQ(of_shunt(*study) != nullptr, shunts != ShuntLegs::abc);
    EXPECT_EQ(study->outcome.blind_samples, 0) << "with the rotor held, the sink's leg has a shunt";
    if (of_shunt(*study)) {
      EXPECT_EQ(of_shunt(*study)->grave, shunts == ShuntLegs::a);
    }
  }
}

}  // namespace SIXSTEP_TEST_FILE
