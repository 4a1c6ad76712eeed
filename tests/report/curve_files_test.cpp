// SPDX-License-Identifier: Apache-2.0
// The table, the columns, the JSON and the page of a curve have the same numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "batch/curve.hpp"
#include "batch/for_each.hpp"
#include "report/curve_page.hpp"
#include "tests/support/bench.hpp"
#include "text/results/curve_columns.hpp"
#include "text/results/curve_json.hpp"
#include "text/results/curve_table.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

struct Made {
  analysis::CurveRequest request;
  analysis::Curve curve;
};

Made made(bool thermal, double duty = 1.0) {
  analysis::CurveRequest r{
      .sheet = thermal ? curve_sheet() : maxon_sheet(), .bench = maxon_bench(), .points = 5};
  r.bench.duty = duty;
  base::Result<analysis::Curve> curve = batch::torque_speed_curve(r, batch::on_threads(1));
  EXPECT_TRUE(curve);
  return {r, std::move(*curve)};
}

TEST(CurveColumns, AreNamedOnceAndWithUnits) {
  std::set<std::string> names;
  for (const text::CurveColumn& c : text::curve_columns()) {
    EXPECT_TRUE(names.insert(c.column.name).second) << c.column.name;
    EXPECT_FALSE(c.column.meaning.empty());
    EXPECT_TRUE(c.column.unit == "1" || c.column.name.find('_') != std::string::npos) << c.column.name;
  }
  EXPECT_EQ(text::curve_columns()[0].column.name, "speed_rad_s");
}

TEST(CurveColumns, HoldThePointsNumbers) {
  const Made m = made(true);
  const auto rows = text::curve_rows(m.request, m.curve);
  ASSERT_EQ(rows.size(), 5u);
  const auto value = [&](std::size_t n, std::string_view name) {
    for (const text::CurveColumn& c : text::curve_columns())
      if (c.column.name == name) return c.value(rows[n]);
    ADD_FAILURE() << name;
    return 0.0;
  };
  for (std::size_t n = 0; n < 5; ++n) {
    const analysis::OperatingPoint& p = m.curve.points[n];
    EXPECT_EQ(value(n, "torque_Nm"), p.shaft_torque_Nm);
    EXPECT_EQ(value(n, "air_gap_torque_Nm"), p.torque_Nm);
    EXPECT_EQ(value(n, "copper_W"), p.copper_W);
    EXPECT_EQ(value(n, "torque_10s_Nm"), m.curve.limits[n].short_Nm[0]);
    EXPECT_EQ(value(n, "torque_60s_Nm"), m.curve.limits[n].short_Nm[1]);
  }
  EXPECT_TRUE(std::isnan(value(0, "efficiency")));
  EXPECT_TRUE(std::isnan(value(0, "winding_degC"))) << "stall runs away";
  EXPECT_TRUE(std::isinf(value(4, "permissible_s")));
}

TEST(CurveJson, HasEveryColumnOfEveryPoint) {
  for (const bool thermal : {true, false}) {
    const Made m = made(thermal);
    const auto json = nlohmann::json::parse(text::curve_json(m.request, m.curve));
    ASSERT_EQ(json["points"].size(), 5u);
    const auto rows = text::curve_rows(m.request, m.curve);
    for (std::size_t n = 0; n < 5; ++n)
      for (const text::CurveColumn& c : text::curve_columns()) {
        const double x = c.value(rows[n]);
        const auto& there = json["points"][n].at(c.column.name);
        EXPECT_EQ(there.is_null(), !std::isfinite(x)) << c.column.name;
        EXPECT_EQ(there.is_number() ? there.get<double>() : 0.0, std::isfinite(x) ? x : 0.0) << c.column.name;
      }
    EXPECT_EQ(json["bench"]["chopping"], "soft");
    EXPECT_EQ(json["no_load"]["speed_rad_s"].get<double>(), m.curve.no_load.point.speed_rad_s);
    EXPECT_EQ(json["nominal"].is_null(), !thermal);
    EXPECT_EQ(json["for_ever_from"].is_null(), !thermal);
    EXPECT_EQ(json["best_efficiency"]["efficiency"].get<double>(),
              *m.curve.marks.best_efficiency->efficiency);
    EXPECT_NEAR(json["locked"]["phase_rms_A"].get<double>(), 24 / 1.03, 1e-12);
    EXPECT_EQ(json["thermal"].is_null(), !thermal);
    EXPECT_EQ(json["thermal_missing"].is_null(), thermal);
  }
}

TEST(CurveTable, ShowsAnEngineersUnits) {
  const Made m = made(true);
  const std::string text = text::curve_table(m.request, m.curve);
  for (const char* line :
       {"maxon EC 45 flat 251601 at 24 V\n", "locked", "just turning", "no load", "best efficiency",
        "nominal torque", "780.58 mNm at standstill, 6841.3 rpm",
        "No load: 6709.5 rpm (702.613 rad/s) with 0.1531 A",
        "83.40 mNm, 5240 rpm, 2.330 A; at this torque the curve has 5078 rpm (-3.1 %)",
        "R/K_t^2 is 8.76, which neglects the commutation time",
        "The motor can run continuously on this curve from 5027 rpm (86.64 mNm) on.",
        "At 25 degC ambient the winding stays below 125 degC with 2.82 A", "for 60 s", "continuously"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
  const std::string without = text::curve_table(made(false).request, made(false).curve);
  EXPECT_NE(without.find("No thermal limits: thermal_resistance_winding_housing_K_W"), std::string::npos);
  EXPECT_NE(without.find("add the sheet's thermal lines to the motor file"), std::string::npos);
}

TEST(CurveTable, SaysWhereALockedRotorsAngleDecides) {
  Made m = made(false);
  EXPECT_EQ(text::curve_table(m.request, m.curve).find("Locked rotor:"), std::string::npos) << "flat top";
  m.request.bench = shaped(design::BackEmfShape::sine, 120);
  m.curve = *batch::torque_speed_curve(m.request, batch::on_threads(1));
  const std::string text = text::curve_table(m.request, m.curve);
  EXPECT_NE(text.find("Locked rotor: 707.9 to 817.4 mNm"), std::string::npos) << text;
}

TEST(CurvePage, ShowsTheUsableCornerAndWhatItAllows) {
  Made m = made(true);
  const auto page = [&] { return report::render_curve({m.request, m.curve, "sixstep curve x", "0.1.0"}); };
  const std::string whole = page();
  const std::size_t at = whole.find("\"corner\":");
  ASSERT_NE(at, std::string::npos);
  const analysis::ThermalLimits still = analysis::thermal_limits(*m.curve.thermal, m.request, 0.0);
  EXPECT_NEAR(std::stod(whole.substr(at + 9)), 1.1e3 * still.short_Nm[0], 1e-9)
      << "some room above ten seconds";
  for (const char* region : {"\"continuous\"", "\"short-time\""})
    EXPECT_NE(page().find(region), std::string::npos) << region;
  // Without thermal data, the nominal torque determines the page's range. If the nominal torque is also
  // missing, the page shows the whole curve.
  m.curve.thermal.reset();
  m.curve.thermal_missing = {{.where = "lines", .limit = "are missing"}};
  EXPECT_NE(page().find("\"corner\":2"), std::string::npos);
  EXPECT_EQ(page().find("\"continuous\""), std::string::npos);
  m.curve.nominal.reset();
  EXPECT_EQ(page().find("\"corner\""), std::string::npos);
}

TEST(CurveTable, SaysHowSureAChoppedMeanIs) {
  const Made m = made(false, 0.6);
  const std::string text = text::curve_table(m.request, m.curve);
  EXPECT_NE(text.find("duty 0.6, soft chopping, PWM period 30 us"), std::string::npos);
  EXPECT_NE(text.find("at 99 % (20 batches)"), std::string::npos);
}

TEST(CurvePage, IsWholeAndHarmless) {
  Made m = made(true);
  m.request.sheet.name = "<script>alert(1)</script>";
  const std::string page = report::render_curve({m.request, m.curve, "sixstep curve x", "0.1.0"});
  EXPECT_EQ(page.find("{{"), std::string::npos);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_NE(page.find("Torque-speed curve of &lt;script&gt;"), std::string::npos);
  EXPECT_NE(page.find("nominal point"), std::string::npos);
  EXPECT_EQ(page, report::render_curve({m.request, m.curve, "sixstep curve x", "0.1.0"}));
}

}  // namespace SIXSTEP_TEST_FILE
