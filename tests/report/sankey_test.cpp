// SPDX-License-Identifier: Apache-2.0
// The energy diagram of a run is equal to the run's energy balance. The width of a band is its energy, and
// the inflow of a node is equal to its outflow.
#include "report/sankey.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "sixstep/base/random.hpp"

namespace SIXSTEP_TEST_FILE {

using report::energy_sankey;
using sixstep::study::EnergyBook;
using ::testing::HasSubstr;
using ::testing::Not;

struct Band {
  double wide, x0, y0, x1, y1;
};

std::vector<Band> bands(const std::string& svg) {
  std::vector<Band> out;
  for (std::size_t at = svg.find("stroke-width"); at != std::string::npos;
       at = svg.find("stroke-width", at + 1)) {
    Band b{};
    EXPECT_EQ(std::sscanf(svg.c_str() + at, "stroke-width=\"%lf\" d=\"M%lf %lfC%*f %*f %*f %*f %lf %lf",
                          &b.wide, &b.x0, &b.y0, &b.x1, &b.y1),
              5);
    out.push_back(b);
  }
  return out;
}

double height(const std::string& svg) {
  double h = 0.0;
  EXPECT_EQ(std::sscanf(svg.c_str() + svg.find("viewBox"), "viewBox=\"0 0 %*f %lf", &h), 1);
  return h;
}

/// A closed balance of random energies: the inputs are equal to the outputs and the stored energy.
EnergyBook book(double copper, double devices, double magnetic, double friction, double load,
                double kinetic) {
  EnergyBook b{.copper = copper,
               .devices = devices,
               .magnetic = magnetic,
               .friction = friction,
               .load = load,
               .kinetic = kinetic};
  b.air_gap = friction + load + kinetic;
  b.supplied = copper + devices + magnetic + b.air_gap;
  return b;
}

/// The bar of each node is at x = 340 or 560 and is 10 wide. The width of a band is rounded to 0.005 and is
/// at least one pixel.
void expect_kirchhoff(const std::string& svg) {
  for (const double node : {340.0, 560.0}) {
    double in = 0.0, out = 0.0, slack = 1e-9;
    for (const Band& b : bands(svg)) {
      if (b.x1 == node) in += b.wide;
      if (b.x0 == node + 10.0) out += b.wide;
      slack += b.wide > 1.0 ? 0.005 : 1.005;
      EXPECT_GE(b.wide, 1.0);
      for (const double y : {b.y0, b.y1}) {
        EXPECT_GE(y - b.wide / 2, 0.0) << svg;
        EXPECT_LE(y + b.wide / 2, height(svg)) << svg;
      }
    }
    EXPECT_NEAR(in, out, slack) << svg;
  }
}

TEST(Sankey, a_motoring_run_goes_from_the_bus_to_the_load) {
  const std::string svg = energy_sankey(book(0.4, 0.1, 0.0, 0.05, 1.0, 0.45));
  expect_kirchhoff(svg);
  EXPECT_THAT(
      svg, HasSubstr("role=\"img\" aria-label=\"Energy of the run, from left to right. Sources: Supplied by "
                     "the bus 2.000 J. Sinks: Load 1.000 J, Into kinetic energy 0.4500 J, Friction 0.05000 "
                     "J, Copper 0.4000 J, Switches and diodes 0.1000 J.\""));
  EXPECT_THAT(svg, HasSubstr("across the air gap 1.500 J"));
  EXPECT_THAT(svg, Not(HasSubstr("magnetic")));  // no energy remained in the field
}

TEST(Sankey, a_braking_run_feeds_back_what_the_rotor_gave) {
  const std::string svg = energy_sankey(book(0.2, 0.05, 0.01, 0.04, 0.0, -1.0));
  expect_kirchhoff(svg);
  EXPECT_THAT(svg,
              HasSubstr("Sources: From kinetic energy 1.000 J. Sinks: Fed back to the bus 0.7000 J, Into the "
                        "magnetic field 0.01000 J, Copper 0.2000 J, Switches and diodes 0.05000 J, Friction "
                        "0.04000 J."));
}

TEST(Sankey, a_locked_rotor_has_no_air_gap_to_show) {
  const std::string svg = energy_sankey(book(10.0, 0.0, 0.15, 0.0, 0.0, 0.0));
  expect_kirchhoff(svg);
  EXPECT_THAT(svg, Not(HasSubstr("air gap")));
  EXPECT_THAT(svg, Not(HasSubstr("rotor and shaft")));
}

/// The signs of the energies are random. Sources are on the left, sinks are on the right, and bands end at
/// their nodes. Labels have a height of 36 and do not overlap.
TEST(Sankey, any_book_that_closes_is_drawn_whole) {
  for (std::uint64_t n = 0; n < 300; ++n) {
    std::uint64_t count = 0;
    const auto drawn = [&](double from, double to) {
      return from + (to - from) * sixstep::base::uniform({20261122, n, count++});
    };
    const double copper = drawn(0.0, 1.0), devices = drawn(0.0, 0.3), friction = drawn(0.0, 1.0);
    const std::string svg =
        energy_sankey(book(copper, devices, drawn(-0.2, 0.2), friction, drawn(-2.0, 2.0), drawn(-2.0, 2.0)));
    SCOPED_TRACE(n);
    expect_kirchhoff(svg);
    std::vector<double> left, right;
    for (const Band& b : bands(svg)) {
      if (b.x0 == 190.0) left.push_back(b.y0);
      if (b.x1 == 750.0) right.push_back(b.y1);
    }
    for (auto* column : {&left, &right}) {
      std::ranges::sort(*column);
      for (std::size_t k = 1; k < column->size(); ++k) EXPECT_GE((*column)[k] - (*column)[k - 1], 36.0);
    }
    EXPECT_EQ(left.size() + right.size() + (svg.find("air gap") != std::string::npos), bands(svg).size());
  }
}

TEST(Sankey, nothing_is_drawn_that_is_not_so) {
  EXPECT_EQ(energy_sankey({}), "");
  EnergyBook open = book(0.4, 0.1, 0.0, 0.05, 1.0, 0.45);
  open.copper += 0.02;  // 1 % of the energy: more than one of the 130 pixels of the full width
  EXPECT_EQ(energy_sankey(open), "");
  open.copper = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(energy_sankey(open), "");
}

}  // namespace SIXSTEP_TEST_FILE
