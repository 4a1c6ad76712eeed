// SPDX-License-Identifier: Apache-2.0
// Each damaged recording is refused with one message that names the fault and the remedy, or it gives
// numbers. SIXSTEP_FUZZ_SEED=n repeats one case, and SIXSTEP_FUZZ_COUNT sets the number of cases.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "report/emf_page.hpp"
#include "report/identify_page.hpp"
#include "tests/fuzz/broken_recording.hpp"
#include "tests/fuzz/draw.hpp"
#include "text/escape/escape.hpp"
#include "text/recording/bench_recordings.hpp"
#include "text/results/identify_text.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::Interval;

#if defined(__SANITIZE_ADDRESS__)
constexpr std::uint64_t usual_count = 300;
#else
constexpr std::uint64_t usual_count = 1000;
#endif

struct Tally {
  std::uint64_t answered = 0, refused = 0;
  std::map<std::string, std::uint64_t> kinds;
};

void expect_told(const base::Problems& problems) {
  ASSERT_GE(problems.size(), 1u);
  EXPECT_LE(problems.size(), 2u);  // two lines may be dead
  for (const base::Problem& p : problems) {
    EXPECT_FALSE(p.where.empty());
    EXPECT_FALSE(p.limit.empty());
    EXPECT_FALSE(p.cure.empty());
    const std::string shown = text::visible(to_string(p));
    EXPECT_LT(shown.size(), 3000u);
    EXPECT_EQ(shown.find('\n'), std::string::npos);
  }
}

void expect_sound(const char* what, const Interval& x) {
  EXPECT_TRUE(std::isfinite(x.value) && std::isfinite(x.low) && std::isfinite(x.high))
      << what << " " << x.low << " " << x.value << " " << x.high;
  EXPECT_LE(x.low, x.high) << what;
}
void expect_probability(const char* what, double p) {
  EXPECT_GE(p, 0.0) << what;
  EXPECT_LE(p, 1.0 + 1e-9) << what;
}

void expect_numbers(const analysis::HallIdentity& found) {
  for (const analysis::IdentifiedEdge& e : found.edges) expect_sound("own", e.own_deg);
  expect_sound("jitter", found.jitter_deg);
  expect_probability("mask", found.mask_probability);
  if (!found.place) return;
  const analysis::IdentifiedPlace& place = *found.place;
  expect_probability("wires", place.probability);
  expect_probability("order", place.order_probability);
  expect_sound("offset", place.offset_deg);
  if (place.hysteresis_deg) expect_sound("hysteresis", *place.hysteresis_deg);
  if (place.delay_s) expect_sound("delay", *place.delay_s);
  expect_sound("flux linkage", place.flux_linkage_Vs);
  EXPECT_FALSE(place.wires.empty());
}

void expect_numbers(const analysis::EmfResult& found) {
  expect_sound("frequency", found.frequency_Hz);
  for (const analysis::EmfChannelResult& c : found.channels) {
    expect_sound("peak", c.peak_V);
    expect_sound("behind", c.phase_deg);
  }
  const analysis::EmfConstants& k = found.constants;
  for (const Interval& x :
       {k.line_peak, k.line_rms, k.line_fundamental, k.phase_peak, k.phase_rms, k.phase_fundamental})
    expect_sound("constant", x);
  for (const analysis::EmfHarmonic& h : found.harmonics) expect_sound("harmonic", h.part);
  for (const double x : found.shape) EXPECT_TRUE(std::isfinite(x));
}

/// Returns whether the identification succeeds.
bool identified(const text::Recording& recording) {
  text::Notes notes;
  const auto log = text::hall_log_of(recording, {}, notes);
  if (!log) return expect_told(log.problems()), false;
  const auto found = analysis::identify(*log);
  if (!found) return expect_told(found.problems()), false;
  expect_numbers(*found);
  EXPECT_NE(text::identify_text("r.csv", *found), "");
  EXPECT_NE(text::identify_toml("r.csv", *found), "");
  EXPECT_NE(text::identify_json("r.csv", *found), "");
  EXPECT_NE(report::render_identify({"r.csv", *found, "", ""}), "");
  return true;
}

bool measured(const text::Recording& recording) {
  text::Notes notes;
  const auto record = text::emf_record_of(recording, {}, notes);
  if (!record) return expect_told(record.problems()), false;
  const auto found = analysis::measure_emf({*record, 4, {}});
  if (!found) return expect_told(found.problems()), false;
  expect_numbers(*found);
  const text::MeasuredEmf all{"r.csv", *found};
  EXPECT_NE(text::emf_text(all), "");
  EXPECT_NE(text::emf_json(all), "");
  EXPECT_NE(text::emf_shape_csv(all), "");
  EXPECT_NE(report::render_emf({all, *record, "", ""}), "");
  return true;
}

/// Both kinds of result must occur. Otherwise the test would cover only half of the readers.
TEST(BrokenRecordings, AreRefusedWithWordsOrAnsweredWithNumbers) {
  const Seeds range = seeds(usual_count);
  Tally tally;
  for (std::uint64_t seed = range.first; seed < range.first + range.count; ++seed) {
    const BrokenRecording broken = broken_recording(seed);
    SCOPED_TRACE(std::string("SIXSTEP_FUZZ_SEED=") + std::to_string(seed) + ": " + broken.kind);
    ++tally.kinds[broken.kind];
    const auto recording = text::read_recording("r.csv", broken.text);
    if (!recording) {
      expect_told(recording.problems());
      ++tally.refused;
      continue;
    }
    const bool by_codes = identified(*recording), by_voltages = measured(*recording);
    ++(by_codes || by_voltages ? tally.answered : tally.refused);
  }
  std::printf("%d answered, %d refused\n", static_cast<int>(tally.answered), static_cast<int>(tally.refused));
  if (std::getenv("SIXSTEP_FUZZ_SEED")) return;
  EXPECT_GT(tally.answered, range.count / 10);
  EXPECT_GT(tally.refused, range.count / 4);
  EXPECT_GT(tally.kinds.size(), 15u);
}

}  // namespace SIXSTEP_TEST_FILE
