// SPDX-License-Identifier: Apache-2.0
// The design's values for Hall probes are sufficient, but not too cautious. The tests use six motors of the
// motor library from the smallest to the largest inertia, with speeds measured over one edge and over six
// edges.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/analysis/verify/design_study.hpp"
#include "sixstep/analysis/verify/robust.hpp"
#include "sixstep/design/sheet/thermal.hpp"
#include "sixstep/study/run/run.hpp"
#include "text/scenario/scenario_file.hpp"

namespace sixstep::analysis {
namespace SIXSTEP_TEST_FILE {

using study::ComparisonResult, study::Outcome, study::Scenario;

struct Drawn {
  const char* motor;
  double bus_V;
  int edges;
};
void PrintTo(const Drawn& d, std::ostream* out) { *out << d.motor << ", " << d.edges << " edges"; }

design::DesignSpec spec_of(const Drawn& d) {
  design::DesignSpec spec = design::on_a_board();
  spec.mode = control::Mode::speed;
  spec.voltage_V = d.bus_V;
  spec.rotor.edges = d.edges;
  return spec;
}

double figure(const Outcome& o, const std::string& name) {
  for (const ComparisonResult& c : o.comparisons)
    if (c.figure == name) return c.measured;
  ADD_FAILURE() << name;
  return NAN;
}

/// Counts the motors within the tolerances for which a design fails. It fails if the speed oscillates, or has
/// not settled after twice the time. (With the doubled inertia, ideal sensors also need this time.)
struct Field {
  int motors = 0, swing = 0, late = 0;
};

Field field_of(const DesignSubject& subject, const design::DesignSpec& spec, bool until_one_swings) {
  const auto d = design::design_drive(*design::motor_model(subject.sheet), spec);
  EXPECT_TRUE(d);
  const Scenario nominal = design_scenario(*d, subject);
  const auto ideal = run(with_ideal_sensors(nominal));
  EXPECT_TRUE(ideal);
  const double allowed = allowed_swing_rad_s(figure(*ideal, "speed ripple"), nominal.reference.values[1]);
  const auto tolerances = sheet_tolerances(subject.sheet, control::Mode::speed);
  Field found;
  for (const Variation& v : variations(tolerances)) {
    const auto outcome = run(varied_scenario(nominal, d->motor, tolerances, v));
    EXPECT_TRUE(outcome && !outcome->fault) << v.words;
    ++found.motors;
    if (!(figure(*outcome, "speed ripple") <= allowed)) ++found.swing;
    if (until_one_swings && found.swing > 0) break;
    if (!until_one_swings && !(figure(*outcome, "settling time") <= 2 * *spec.settle_s)) ++found.late;
  }
  return found;
}

class HallDesign : public ::testing::TestWithParam<Drawn> {
 protected:
  void SetUp() override {
    const auto sheet = text::read_sheet(GetParam().motor);
    ASSERT_TRUE(sheet);
    subject_.motor = GetParam().motor;
    subject_.sheet = *sheet;
  }

  Field field(double settle_s, bool until_one_swings) {
    design::DesignSpec spec = spec_of(GetParam());
    spec.settle_s = settle_s;
    return field_of(subject_, spec, until_one_swings);
  }

  DesignSubject subject_;
};

TEST_P(HallDesign, SettlesAsNamedAtEveryCornerAndNotAtAThird) {
  const auto d = design::design_drive(*design::motor_model(subject_.sheet), spec_of(GetParam()));
  ASSERT_TRUE(d);
  const double named_s = d->loop("speed").placed->settle_s;
  const Field held = field(named_s, false);
  EXPECT_EQ(held.motors, design::thermal_model(subject_.sheet) ? 26 : 25) << "one more with warm magnets";
  EXPECT_EQ(held.swing, 0);
  EXPECT_EQ(held.late, 0);
  EXPECT_GT(field(named_s / 3, true).swing, 0);
}

INSTANTIATE_TEST_SUITE_P(SixMotors, HallDesign,
                         ::testing::Values(Drawn{"dji-2212-920kv", 12, 1}, Drawn{"dji-2212-920kv", 12, 6},
                                           Drawn{"anaheim-bly172s", 24, 1}, Drawn{"anaheim-bly172s", 24, 6},
                                           Drawn{"maxon-251601", 24, 1}, Drawn{"maxon-251601", 24, 6},
                                           Drawn{"mjbots-mj5208", 24, 1}, Drawn{"mjbots-mj5208", 24, 6},
                                           Drawn{"baldor-bsm90n-175", 200, 1},
                                           Drawn{"baldor-bsm90n-175", 200, 6}, Drawn{"hoverboard-hub", 36, 1},
                                           Drawn{"hoverboard-hub", 36, 6}));

TEST(HallTable, EachOfItsEntriesHoldsAtEveryCorner) {
  const DesignSubject subject{.motor = "maxon-251601", .sheet = *text::read_sheet("maxon-251601")};
  const auto d = design::design_drive(*design::motor_model(subject.sheet), spec_of({"maxon-251601", 24, 0}));
  ASSERT_TRUE(d);
  ASSERT_EQ(d->limits.size(), 9u);
  for (const design::SettlingLimit& limit : d->limits) {
    SCOPED_TRACE(design::edges_words(limit.sensing) + " at " + std::to_string(limit.lowest_speed_rad_s));
    design::DesignSpec spec = spec_of({"maxon-251601", 24, limit.sensing.edges});
    spec.lowest_speed_rad_s = limit.lowest_speed_rad_s;
    spec.settle_s = limit.settle_s;
    const Field held = field_of(subject, spec, false);
    EXPECT_EQ(held.motors, design::thermal_model(subject.sheet) ? 26 : 25) << "one more with warm magnets";
    EXPECT_EQ(held.swing, 0);
    EXPECT_EQ(held.late, 0);
  }
}

TEST(HallDesigned, DefaultEdgesHoldWhereSixWouldNot) {
  // The speed loop that is designed for adaptive edges must fail on the same drive with six edges at every
  // speed.
  const DesignSubject subject{.motor = "maxon-251601", .sheet = *text::read_sheet("maxon-251601")};
  const auto adaptive = study_design({.subject = subject, .spec = spec_of({"maxon-251601", 24, 0})});
  ASSERT_TRUE(adaptive);
  EXPECT_TRUE(adaptive->usable());
  design::DesignSpec six = spec_of({"maxon-251601", 24, 6});
  six.settle_s = adaptive->design.loop("speed").placed->settle_s;
  const auto fixed = study_design({.subject = subject, .spec = six});
  ASSERT_TRUE(fixed);
  EXPECT_FALSE(fixed->usable());
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace sixstep::analysis
