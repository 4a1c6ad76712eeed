// SPDX-License-Identifier: Apache-2.0
// The balance's residuals on the page and in the JSON equal the differences of their rows.
#include "report/energy_balance.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/figures.hpp"
#include "tests/support/scenarios.hpp"
#include "text/results/json_summary.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using sixstep::testing::maxon_scenario;
using ::testing::HasSubstr;
using ::testing::Not;

/// A turning wheel has much stored energy and moves little.
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
      // The residual was divided and is multiplied again: two roundings.
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
      EXPECT_THAT(html, HasSubstr("what does not add up</small></th><td class=\"num\">" +
                                  report::computed(e[residual].get<double>() * of("scale"), "J") + "<"));
    EXPECT_THAT(html, HasSubstr(inertia > 0.0 ? "of the energy stored" : "of the energy moved"));
    EXPECT_THAT(html, Not(HasSubstr(inertia > 0.0 ? "of the energy moved" : "of the energy stored")));
  }
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
      "Residual<small>what does not add up</small></th><td class=\"num\">0.000\u00a0J<";
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
