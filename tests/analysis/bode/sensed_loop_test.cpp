// SPDX-License-Identifier: Apache-2.0
// If the speed or position comes from a sensor, the loop includes the sensor's delay.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/bode/bode_study.hpp"
#include "sixstep/base/angle.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::BodeStudy;
using analysis::LoopPoint;

constexpr double degree = base::pi / 180;

/// The load keeps the current continuous with each kind of chopping.
study::Scenario speed_by(study::RotorSensing rotor) {
  study::Scenario s = cascade(0.2);
  s.control.speed.settle_s = 37e-3;
  s.load.torque_Nm = 0.039;
  s.reference.value = 71;
  s.sensors.rotor = rotor;
  s.pwm.commutation = study::CommutationAt::sample;
  return s;
}

study::Scenario position_by(study::RotorSensing rotor) {
  study::Scenario s = maxon_scenario(control::Mode::position, 1000.0);
  s.control.current.settle_s = 1e-3;
  s.control.speed.settle_s = 37e-3;
  s.control.position.gain_rad_s_per_deg = 0.35;
  s.duration_s = 1.0;
  s.sensors.rotor = rotor;
  s.pwm.commutation = study::CommutationAt::sample;
  return s;
}

BodeStudy study_of(const study::Scenario& s) {
  const auto b = analysis::study_bode(s);
  EXPECT_TRUE(b) << (b ? "" : to_string(b.problems()[0]));
  return b ? *b : BodeStudy{};
}

/// The designed response of the true speed is T. With the transfer function H of the sensor, the loop is L H
/// = T H/(1 - T H). For a speed from k edges, H is a delay of (k + 1)/2 sectors. The measured loop is equal
/// to the designed loop up to the frequency that the edges resolve.
TEST(SensedLoop, ASpeedFromASensorIsMeasuredAsTheControllerIsTold) {
  for (const auto rotor :
       {study::RotorSensing::ideal, study::RotorSensing::hall, study::RotorSensing::encoder}) {
    SCOPED_TRACE(static_cast<int>(rotor));
    const BodeStudy b = study_of(speed_by(rotor));
    ASSERT_EQ(b.lag.has_value(), rotor != study::RotorSensing::ideal);
    ASSERT_TRUE(b.figures && b.measured.crossover_rad_s && b.measured.phase_rad);
    EXPECT_NEAR(*b.measured.crossover_rad_s / *b.figures->crossover_rad_s, 1.0, 0.06);
    EXPECT_NEAR(*b.measured.phase_rad, *b.figures->phase_rad, 2 * degree);
    for (std::size_t k = 0; k < b.points.size(); ++k) {
      const LoopPoint& p = b.points[k];
      const double designed = b.designed_at(p.w_rad_s)->size();
      if (designed > 10 || designed < 0.1) continue;
      EXPECT_NEAR(20 * std::log10(p.gain / designed), 0.0, 1.0) << p.w_rad_s;
      EXPECT_NEAR(p.phase_rad, b.designed_phase_rad[k], 4 * degree) << p.w_rad_s;
    }
  }
}

/// The delay of a speed from one edge interval is (1 + 1)/2 = 1 sector. At the crossover, the phase is lower
/// by this delay than with the true speed.
TEST(SensedLoop, TheSensorCostsItsDelay) {
  const BodeStudy ideal = study_of(speed_by(study::RotorSensing::ideal)),
                  hall = study_of(speed_by(study::RotorSensing::hall));
  ASSERT_TRUE(hall.lag && ideal.measured.phase_rad && hall.measured.phase_rad);
  const double sector_s = base::pi / 3 / (hall.pole_pairs * 71);
  EXPECT_NEAR(hall.lag->delay_s(), sector_s, 1e-9);
  const double cost = *hall.measured.crossover_rad_s * sector_s;
  EXPECT_NEAR(*ideal.measured.phase_rad - *hall.measured.phase_rad, cost, 3 * degree);
}

double between(const std::vector<LoopPoint>& points, double w_rad_s) {
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (points[k].w_rad_s < w_rad_s) continue;
    const double from = std::log(points[k - 1].w_rad_s), to = std::log(points[k].w_rad_s);
    return points[k - 1].phase_rad +
           (std::log(w_rad_s) - from) / (to - from) * (points[k].phase_rad - points[k - 1].phase_rad);
  }
  return 0.0;
}

/// A position from Hall probes has steps, so the phase at the lowest frequency is noise. A whole turn in this
/// phase must not be added to the phases at the other frequencies.
TEST(SensedLoop, PhasesStandWithinATurnAndTheMarginIsOfThem) {
  for (const study::Scenario& s :
       {position_by(study::RotorSensing::hall), speed_by(study::RotorSensing::hall)}) {
    const BodeStudy b = study_of(s);
    ASSERT_EQ(b.designed_phase_rad.size(), b.points.size());
    EXPECT_GT(b.designed_phase_rad[0], -base::turn_rad);
    EXPECT_LE(b.designed_phase_rad[0], 0.0);
    for (std::size_t k = 0; k < b.points.size(); ++k) {
      const double designed = b.designed_phase_rad[k];
      EXPECT_LE(std::fabs(b.points[k].phase_rad - designed), base::pi * (1 + 1e-12));
      const double turns = (designed - b.designed_at(b.points[k].w_rad_s)->angle_rad()) / base::turn_rad;
      EXPECT_NEAR(turns, std::round(turns), 1e-9);
      if (k == 0) continue;
      EXPECT_LE(std::fabs(designed - b.designed_phase_rad[k - 1]), base::pi * (1 + 1e-12));
      EXPECT_LT(std::fabs(b.points[k].phase_rad - b.points[k - 1].phase_rad), base::pi);
    }
    ASSERT_TRUE(b.measured.phase_rad && b.measured.delay_s);
    EXPECT_GT(*b.measured.phase_rad, -base::pi);
    EXPECT_LE(*b.measured.phase_rad, base::pi);
    const double turns =
        (*b.measured.phase_rad - base::pi - between(b.points, *b.measured.crossover_rad_s)) / base::turn_rad;
    EXPECT_NEAR(turns, std::round(turns), 1e-9);
    EXPECT_DOUBLE_EQ(*b.measured.delay_s, std::max(0.0, *b.measured.phase_rad) / *b.measured.crossover_rad_s);
    EXPECT_NEAR(*b.measured.phase_rad, *b.figures->phase_rad, 30 * degree);
  }
}

/// Adding whole turns to all phases does not change a margin.
TEST(SensedLoop, MarginsAreTheSameATurnFurther) {
  std::vector<LoopPoint> points;
  for (const double w : {10.0, 20.0, 40.0, 80.0})
    points.push_back(
        {.w_rad_s = w, .closed = {}, .coherence = 1.0, .gain = 30 / w, .phase_rad = -2.0 - w / 100});
  const double margin = *analysis::margins_of(points).phase_rad;
  EXPECT_GT(margin, 0.0);
  for (const double turns : {-2.0, -1.0, 1.0}) {
    std::vector<LoopPoint> turned = points;
    for (LoopPoint& p : turned) p.phase_rad += turns * base::turn_rad;
    EXPECT_NEAR(*analysis::margins_of(turned).phase_rad, margin, 1e-12);
    EXPECT_NEAR(*analysis::margins_of(turned).delay_s, margin / 30, 1e-3 * margin);
  }
}

}  // namespace SIXSTEP_TEST_FILE
