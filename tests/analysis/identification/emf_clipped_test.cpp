// SPDX-License-Identifier: Apache-2.0
// The converter clips the peaks of a sine whose true peak is known. The recording is refused, or the bounds
// contain the true peak.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "sixstep/analysis/identification/emf/emf.hpp"
#include "tests/analysis/identification/drawn_emf.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using ::testing::HasSubstr;

constexpr double frequency_Hz = 50.0, peak_V = 3.0;
/// Peak of the line voltage divided by the electrical speed, V s per electrical rad.
constexpr double true_peak = peak_V / (2 * std::numbers::pi * frequency_Hz);

struct Cut {
  double part = 0.0;  ///< part of the peak that is cut off
  double step_V = 0.0, noise_V = 0.0;
  bool both = true;  ///< true: both peaks are clipped; false: only the upper peak
};

analysis::EmfRequest recorded(const Cut& cut) {
  Draw draw(7);
  analysis::EmfRequest out;
  out.record.between = analysis::EmfBetween::lines;
  out.record.channels.push_back({"u_ab", {}});
  const double rail = (1 - cut.part) * peak_V;
  for (int n = 0; n < 6000; ++n) {
    const double t = n / (1000.0 * frequency_Hz);
    double u = peak_V * std::cos(2 * std::numbers::pi * frequency_Hz * t + 0.3) + cut.noise_V * normal(draw);
    u = std::clamp(u, cut.both ? -rail : -2 * peak_V, rail);
    out.record.t_s.push_back(t);
    out.record.channels[0].u_V.push_back(cut.step_V * std::round(u / cut.step_V));
  }
  return out;
}

/// The converter has 12 or 8 bits over 8 V, and the noise is up to half a step. A peak that is clipped by
/// three steps or more is always refused.
TEST(EmfClipped, WhatLacksThreeStepsIsRefused) {
  for (const double step_V : {8.0 / 4096, 8.0 / 256})
    for (const double noise : {0.0, 0.3, 0.5})
      for (const double part : {0.01, 0.02, 0.05, 0.2})
        for (const bool both : {true, false}) {
          if (part * peak_V < 3 * step_V) continue;
          const auto found = analysis::measure_emf(recorded({part, step_V, noise * step_V, both}));
          ASSERT_FALSE(found) << step_V << " V, " << noise << ", " << part;
          EXPECT_THAT(found.problems()[0].limit, HasSubstr("is clipped"));
        }
}

/// A peak that is clipped by less than three steps is refused, or the bounds of peak and fundamental contain
/// the true value.
TEST(EmfClipped, WhatIsLeftIsWithinTheBounds) {
  for (const double step_V : {8.0 / 256, 8.0 / 64})
    for (const double noise : {0.3, 0.5})
      for (const double steps : {0.8, 1.0, 1.4, 1.7, 2.0, 2.4, 2.8}) {
        const double part = steps * step_V / peak_V;
        const auto found = analysis::measure_emf(recorded({part, step_V, noise * step_V, true}));
        if (!found) continue;
        SCOPED_TRACE(std::to_string(step_V) + " V, " + std::to_string(noise) + ", " + std::to_string(steps));
        EXPECT_GT(found->constants.line_peak.high, (1 - 2e-3) * true_peak);
        EXPECT_GT(found->constants.line_fundamental.high, (1 - 2e-3) * true_peak);
      }
}

/// A complete sine is not considered clipped, even with coarse steps.
TEST(EmfClipped, AWholeSineIsMeasured) {
  for (const double step_V : {8.0 / 4096, 8.0 / 256, 8.0 / 64, 8.0 / 32})
    for (const double noise : {0.0, 0.1, 0.3, 0.5, 2.0}) {
      const auto found = analysis::measure_emf(recorded({0.0, step_V, noise * step_V, true}));
      EXPECT_TRUE(found) << step_V << " V, " << noise << ": " << to_string(found.problems()[0]);
    }
}

/// The flat tops of a trapezoid, of any width, are not considered clipped.
TEST(EmfClipped, TheTopsOfATrapezoidAreItsOwn) {
  for (const double flat_deg : {60.0, 90.0, 120.0, 140.0})
    for (const double part_of_peak : {1.0 / 1000, 1.0 / 100, 1.0 / 30})
      for (const bool star : {true, false}) {
        EmfTruth t;
        t.cos_part[1] = 1.0;
        t.star = star;
        make_trapezoid(t, flat_deg);
        t.step_V = part_of_peak * true_line_peak(t) * 2 * std::numbers::pi * t.frequency_Hz;
        t.noise_V = 0.3 * t.step_V;
        const auto found = analysis::measure_emf(drawn_record(t));
        EXPECT_TRUE(found) << flat_deg << " deg, " << part_of_peak << ": " << to_string(found.problems()[0]);
      }
}

}  // namespace SIXSTEP_TEST_FILE
