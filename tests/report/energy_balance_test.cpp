// SPDX-License-Identifier: Apache-2.0
// The residuals of the energy balance, on the page and in the JSON, are equal to the differences of the
// balance's rows.
#include "report/energy_balance.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "files/scenario_on_disk.hpp"
#include "report/figures.hpp"
#include "report/groups.hpp"
#include "report/kept_rows.hpp"
#include "report/windows.hpp"
#include "tests/support/scenarios.hpp"
#include "text/results/json_summary.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using sixstep::testing::maxon_scenario;
using ::testing::HasSubstr;
using ::testing::Not;

/// A turning flywheel stores much more energy than the energy that moves in the run.
study::Scenario flywheel(double inertia_kg_m2) {
  study::Scenario s = maxon_scenario(control::Mode::duty, 0.3);
  s.load.inertia_kg_m2 = inertia_kg_m2;
  s.initial.speed_rad_s = 100;
  return s;
}

std::string page(const study::EnergyBook& book) { return report::energy_section(book, {}, {}); }

TEST(Ledger, residuals_are_parts_of_the_scale_and_the_page_says_what_that_is) {
  for (const double inertia : {0.0, 1e-3, 10.0}) {
    const study::Scenario s = flywheel(inertia);
    const auto outcome = study::run(s);
    ASSERT_TRUE(outcome);
    const auto e = nlohmann::json::parse(text::json_summary(s, *outcome))["energy"];
    const auto of = [&](const char* name) { return e[std::string(name) + "_J"].get<double>(); };
    const double electrical = of("supplied") - of("copper") - of("devices") - of("air_gap") - of("magnetic");
    const double mechanical = of("air_gap") - of("friction") - of("load") - of("kinetic");
    const auto expect = [&](double joule, const char* residual) {
      // The residual was divided by the scale, and the test multiplies it by the scale again. This causes two
      // roundings.
      EXPECT_NEAR(e[residual].get<double>() * of("scale"), joule, std::abs(joule) * 5e-16) << inertia;
    };
    expect(electrical, "electrical_residual");
    expect(mechanical, "mechanical_residual");
    const double stored = 0.5 * (135e-7 + inertia) * 100 * 100;
    EXPECT_GE(of("scale"), of("moved"));
    EXPECT_GE(of("scale"), stored * (1 - 1e-12));
    EXPECT_EQ(of("scale") > of("moved"), inertia > 0.0);
    const std::string html = page(*outcome->energy);
    for (const char* residual : {"electrical_residual", "mechanical_residual"})
      EXPECT_THAT(html, HasSubstr("difference of the two sides</small></th><td class=\"num\">" +
                                  report::computed(e[residual].get<double>() * of("scale"), "J") + "<"));
    EXPECT_THAT(html, HasSubstr(inertia > 0.0 ? "of the energy stored" : "of the energy moved"));
    EXPECT_THAT(html, Not(HasSubstr(inertia > 0.0 ? "of the energy moved" : "of the energy stored")));
  }
}

/// All gates are off, so no terminal has a current. The copper loss is the loss of the three branches of the
/// delta. Each branch carries a third of the sum of the branch currents.
TEST(Ledger, the_copper_of_a_delta_is_that_of_its_branches) {
  const auto s = files::read_scenario(SIXSTEP_SOURCE_DIR "/data/scenarios/gallery/delta-loop.toml");
  ASSERT_TRUE(s);
  report::KeptRows kept(*s);
  const auto outcome = study::run(*s, {.on_event = [&](study::Row row) { kept.add(row); }});
  ASSERT_TRUE(outcome);
  const study::Trace trace = kept.trace();
  const auto &t = *report::find_column(trace, "t_s"), &sum = *report::find_column(trace, "loop_A");
  const double R_x = 1.5 * outcome->motor.machine.R_ohm * 2;  // between two terminals: twice the phase
                                                              // resistance of the equivalent star
  double joule = 0.0;
  for (std::size_t n = 1; n < t.size(); ++n)
    joule += (t[n] - t[n - 1]) * 3 * R_x * (sum[n] * sum[n] + sum[n - 1] * sum[n - 1]) / 18;
  EXPECT_NEAR(outcome->energy->copper, joule, 1e-3 * joule);
  EXPECT_THAT(report::energy_section(*outcome->energy, {}, {.delta = true}),
              HasSubstr("∫ R<sub>x</sub> Σj² dt"));
  const report::Groups groups = report::chart_groups(trace, *s);
  EXPECT_NE(std::ranges::find(groups.charts, "loop-current", &report::Group::id), groups.charts.end());
}

/// The current rises at the start, so the junction becomes warmer. Its mean temperature is therefore below
/// its final temperature. The mean temperature rise is 40 K/W times the mean power.
TEST(Ledger, the_table_of_switches_has_the_mean_of_the_junction) {
  const auto s = files::read_scenario(SIXSTEP_SOURCE_DIR "/data/scenarios/gallery/losses-20-khz.toml");
  ASSERT_TRUE(s);
  const auto outcome = study::run(*s);
  ASSERT_TRUE(outcome && outcome->devices.size() == 6);
  const study::DeviceLoss& T1 = outcome->devices[0];
  const double watt = T1.conduction_W + T1.turn_on_W + T1.turn_off_W + T1.diode_W + T1.recovery_W;
  EXPECT_NEAR(T1.junction_degC, 25 + 40 * watt, 1e-9);
  EXPECT_LT(T1.junction_degC, outcome->verdicts[2].measured) << "the end, as required";
  EXPECT_THAT(report::device_section(outcome->devices), HasSubstr("junction, mean</th>"));
}

TEST(Ledger, what_is_far_below_every_rounding_is_nothing) {
  study::EnergyBook book{.supplied = 2.0,
                         .copper = 2.0,
                         .air_gap = 0.0,
                         .friction = 3e-24,
                         .moved = 2.0,
                         .scale = 2.0,
                         .mechanical_residual = -1.5e-24};
  const std::string nothing =
      "Residual<small>difference of the two sides</small></th><td class=\"num\">0.000\u00a0J<";
  std::string html = page(book);
  EXPECT_THAT(html, HasSubstr("closes to <b>0</b>"));
  EXPECT_THAT(html, Not(HasSubstr("·10")));
  EXPECT_NE(html.find(nothing), html.rfind(nothing)) << "both accounts";
  book.friction = 3e-16;
  book.mechanical_residual = -1.5e-16;
  html = page(book);
  EXPECT_EQ(html.find(nothing), html.rfind(nothing));
  EXPECT_THAT(html, HasSubstr("closes to <b>1.5·10⁻¹⁶</b> of the energy moved"));
}

}  // namespace SIXSTEP_TEST_FILE
