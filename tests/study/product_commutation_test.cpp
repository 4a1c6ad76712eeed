// SPDX-License-Identifier: Apache-2.0
// The product drive changes the pair before the Hall edge, at the edge, or after the delay of its Hall
// filter, which suppresses glitches. The tests use the full switching simulation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/arithmetic.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::Arithmetic;
using study::Scenario;
using ::testing::HasSubstr;

constexpr double T = 30e-6, w = 500.0;
constexpr double edge_s = base::pi / 24 / w;  // duration of a sector with 8 pole pairs
constexpr double tick = T / edge_s;           // a control period, in sectors
constexpr double count = 1e-6 / edge_s;       // a count of the capture timer, in sectors

/// Gates change only with the driven pair, because the duty is 1. The large inertia keeps the speed constant.
Scenario flywheel() {
  Scenario s = product_scenario(Mode::duty, 1.0);
  s.initial.speed_rad_s = w;
  s.load.inertia_kg_m2 = 1.0;
  s.protection.over_speed_rad_s = 700.0;
  return s;
}

/// Positions of the changes of the pair, in sectors after the Hall edge; negative before the edge. The first
/// turn is omitted, because the drive does not know the direction of rotation yet.
std::vector<double> changes(const Scenario& s) {
  static const std::size_t gates = column("gate_T1"), angle = column("angle_rad");
  std::vector<double> after;
  int before = 0;
  const auto out = study::run(s, {.on_event = [&](study::Row row) {
                                int now = 0;
                                for (std::size_t k = 0; k < 6; ++k) now |= (row[gates + k] != 0) << k;
                                if (now != before && now != 0 && before != 0)
                                  after.push_back(std::remainder(row[angle] * 24 / base::pi, 1.0));
                                if (now != 0) before = now;
                              }});
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  EXPECT_TRUE(out && !out->fault);
  after.erase(after.begin(), after.begin() + 6);
  return after;
}

TEST(ProductCommutation, WithoutAdvanceThePairChangesAtTheEdge) {
  const std::vector<double> after = changes(flywheel());
  EXPECT_GT(after.size(), 50u);
  for (const double x : after) EXPECT_NEAR(x, 0.0, 1e-9);
}

TEST(ProductCommutation, AdvanceIsTheAngleBeforeTheEdge) {
  // The advance is a constant angle plus a gain times the speed, up to a limit. The pair changes at the first
  // tick after this angle is reached. The angle since the last edge is a ratio of two counts, and each count
  // is the difference of two rounded-down counts. In 16-bit fixed point, this angle and the advance are each
  // rounded to a digit of 2^-14. Q14 is used because it represents the duty 1.
  struct Case {
    double angle_deg, gain, limit_deg, expected_deg;
  };
  for (const Arithmetic a : {Arithmetic::float64, Arithmetic::float32, Arithmetic::q14, Arithmetic::q30})
    for (const Case c :
         {Case{15, 0, 30, 15}, Case{0, 0.02, 30, 10}, Case{10, 0.01, 30, 15}, Case{15, 0.01, 18, 18}}) {
      Scenario s = flywheel();
      s.control.arithmetic = a;
      s.control.advance = {c.angle_deg, c.gain, c.limit_deg};
      // The gain multiplies the measured speed. This speed is w, apart from an error of one count in a
      // sector.
      const double wanted = c.expected_deg / 60, of_speed = c.gain * w / 60 * count;
      const double error = 2 * count + of_speed + 0x1p-13;
      const std::vector<double> after = changes(s);
      EXPECT_GT(after.size(), 50u);
      for (const double x : after) {
        EXPECT_GE(-x, wanted - tick - error) << c.angle_deg << " " << c.gain;
        EXPECT_LE(-x, wanted + error) << c.angle_deg << " " << c.gain;
      }
    }
}

TEST(ProductCommutation, TheHallFilterDelaysAnEdgeByItsSamplesLessOne) {
  for (const int samples : {2, 3}) {
    Scenario s = flywheel();
    s.sensors.hall_stable_samples = samples;
    const std::vector<double> after = changes(s);
    EXPECT_GT(after.size(), 50u);
    for (const double x : after) {  // the first sample after the edge is within a period
      EXPECT_GE(x, (samples - 1) * tick - 1e-9);
      EXPECT_LE(x, samples * tick + 1e-9);
    }
  }
}

/// A run at 100 rad/s. With a glitch, the line H1 is high for 50 us in sector 3, so the code is 111, which is
/// not the code of any sector.
Scenario glitch(bool there, int samples) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.duration_s = 0.2;
  static const double sector_3_s = [] {
    static const std::size_t angle = column("angle_rad");
    double at = 0.0;
    Scenario plain = product_scenario(Mode::speed, 100.0);
    plain.duration_s = 0.2;
    int before = 0;
    const auto out = study::run(plain, {.on_event = [&](study::Row row) {
                                  const int sector =
                                      static_cast<int>(std::floor(row[angle] * 24 / base::pi)) % 6;
                                  if (sector == 3 && before == 2 && row[0] < 0.19) at = row[0];
                                  before = sector;
                                }});
    EXPECT_TRUE(out);
    return at;
  }();
  s.duration_s = sector_3_s + 20e-3;  // at least ten edges of each line
  s.sensors.hall_stable_samples = samples;
  const auto line = [&](double at_s, study::PinLevel level) {
    study::At at;
    at.time_s = at_s;
    at.sensors.hall_break = study::AtHallBreak{1, level};
    s.at.push_back(at);
  };
  if (there) line(sector_3_s + 400e-6, study::PinLevel::high);
  if (there) line(sector_3_s + 450e-6, study::PinLevel::probe);
  return s;
}

TEST(ProductCommutation, AGlitchShorterThanTheFilterIsNoEdge) {
  // A control period is 30 us, so at most two samples are within 50 us.
  const auto taken = study::run(glitch(true, 1));
  ASSERT_TRUE(taken && taken->fault);
  EXPECT_THAT(taken->fault->limit, HasSubstr("Hall"));
  std::vector<std::vector<double>> with, without;
  const auto keep = [](std::vector<std::vector<double>>& rows) {
    return [&rows](study::Row row) { rows.emplace_back(row.begin(), row.end()); };
  };
  Scenario filtered = glitch(true, 3), whole = glitch(false, 3);
  for (Scenario* s : {&filtered, &whole}) s->record.columns = {"i_a_A", "i_b_A", "i_c_A", "speed_rad_s"};
  ASSERT_FALSE(study::run(filtered, {.on_record = keep(with)})->fault);
  ASSERT_FALSE(study::run(whole, {.on_record = keep(without)})->fault);
  ASSERT_EQ(with.size(), without.size());
  // Both runs are equal, apart from rounding: the two edges of the glitch split segments. The bound is the
  // bound of the reference cases, 2e-13 of the largest value. A fault or a wrong pair would change the
  // currents by amperes.
  for (std::size_t c = 0; c < 5; ++c) {
    double largest = 0.0;
    for (const std::vector<double>& row : without) largest = std::max(largest, std::fabs(row[c]));
    for (std::size_t n = 0; n < with.size(); ++n)
      ASSERT_NEAR(with[n][c], without[n][c], 2e-13 * largest) << c << " at " << with[n][0];
  }
}

TEST(ProductCommutation, SaysWhatCannotBe) {
  Scenario s = flywheel();
  s.sensors.hall_stable_samples = 7;  // 210 us; at 700 rad/s a sector lasts 187 us
  s.control.advance = {25.0, 0.0, 20.0};
  std::string all;
  for (const base::Problem& p : study::check(s)) all += to_string(p) + "\n";
  EXPECT_THAT(all, HasSubstr("sensors.hall_stable_samples = 7 last longer than a sector"));
  EXPECT_THAT(all, HasSubstr("lower this value to 6 at most"));
  EXPECT_THAT(all, HasSubstr("control.advance.angle_deg = 25 is above limit_deg = 20"));
  s = flywheel();
  s.sensors.hall_stable_samples = 6;
  s.control.advance = {20.0, 0.0, 20.0};
  EXPECT_TRUE(study::check(s).empty());
  s.control.drive = study::FirmwareKind::lean;
  s.protection = {};
  all.clear();
  for (const base::Problem& p : study::check(s)) all += to_string(p) + "\n";
  EXPECT_THAT(all, HasSubstr("control.advance applies to the product drive only"));
  EXPECT_THAT(all, HasSubstr("sensors.hall_stable_samples = 6 applies to the product drive only"));
}

TEST(ProductCommutation, FullScaleMayBeChosenForTheProductToo) {
  Scenario s = flywheel();
  s.control.arithmetic = Arithmetic::q31;
  s.control.full_scale.current_A = 64.0;
  const auto product = study::product_in<control::Q31>(s, *study::compile(s));
  ASSERT_TRUE(product);
  EXPECT_EQ(product->bases.current_A, 64.0);
  EXPECT_TRUE(study::run(s));
  s.control.full_scale.current_A = 16.0;  // converters span 20.48 A
  const auto refused = study::run(s);
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.problems()[0]), HasSubstr("current"));
  EXPECT_THAT(to_string(refused.problems()[0]), HasSubstr("control.full_scale"));
}

}  // namespace SIXSTEP_TEST_FILE
