// SPDX-License-Identifier: Apache-2.0
// A note is printed if a figure of merit of the controller's samples differs from the figure of the whole
// signal. After its advice is followed, the figures agree.
#include <gtest/gtest.h>

#include <string>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using study::MetricKind;
using study::Scenario;

/// The drive controls 2 A with a locked rotor at a duty of 0.14. The ripple is 24 V 0.12 30 us/(2 0.286 mH) =
/// 0.15 A.
Scenario held(MetricKind metric) {
  Scenario s = maxon_scenario(control::Mode::current, 2.0);
  s.load.locked = true;
  s.duration_s = 20e-3;
  study::Measure m = measure(metric, study::Signal::current);
  m.sampled = true;
  m.from_s = 15e-3;
  s.require.push_back({m, {}, {}});
  return s;
}

study::Outcome ran(const Scenario& s) {
  EXPECT_TRUE(study::check(s).empty()) << base::to_string(study::check(s)[0]);
  const auto outcome = study::run(s);
  EXPECT_TRUE(outcome);
  return *outcome;
}

/// A scenario whose requirement is the figure of the samples, within a fortieth of the current.
Scenario asked_of_its_samples(MetricKind metric) {
  Scenario s = held(metric);
  s.require[0].min = -1e9;
  const double there = ran(s).verdicts[0].measured;
  s.require[0].min = there - 0.025;
  s.require[0].max = there + 0.025;
  return s;
}

constexpr const char* centred = "pwm.alignment = \"centre\" and pwm.sample = \"middle\"";
constexpr const char* all_of_it = "sampled = false";

bool says(const std::string& note, const char* words) { return note.find(words) != note.npos; }

TEST(SampleNote, ItsAdviceMakesItGoAway) {
  for (const MetricKind metric : {MetricKind::mean, MetricKind::rms, MetricKind::maximum,
                                  MetricKind::peak_to_peak, MetricKind::ripple_rms}) {
    SCOPED_TRACE(static_cast<int>(metric));
    const Scenario s = asked_of_its_samples(metric);
    const study::Outcome first = ran(s);
    ASSERT_EQ(first.notes.size(), 1u);
    EXPECT_EQ(says(first.notes[0], centred), metric == MetricKind::mean || metric == MetricKind::rms)
        << first.notes[0];
    EXPECT_TRUE(says(first.notes[0], all_of_it)) << first.notes[0];
    if (says(first.notes[0], centred)) {
      Scenario middle = s;
      middle.pwm.alignment = study::Alignment::centre;
      middle.pwm.sample = study::SampleAt::middle;
      EXPECT_TRUE(ran(middle).notes.empty());
    }
    Scenario whole = s;
    whole.require[0].measure.sampled = false;
    EXPECT_TRUE(ran(whole).notes.empty());
  }
}

/// At the start, the ripple is added to an overshoot. No position of the sample in the period shows this
/// ripple.
TEST(SampleNote, WhereTheSampleStandsAlreadyTheWholeSignalIsLeft) {
  Scenario s = asked_of_its_samples(MetricKind::maximum);
  s.pwm.alignment = study::Alignment::centre;
  s.pwm.sample = study::SampleAt::middle;
  s.require[0].min = -1e9;
  s.require[0].max = ran(s).verdicts[0].measured + 1e-3;
  const study::Outcome outcome = ran(s);
  ASSERT_EQ(outcome.notes.size(), 1u);
  EXPECT_FALSE(says(outcome.notes[0], centred)) << outcome.notes[0];
}

}  // namespace SIXSTEP_TEST_FILE
