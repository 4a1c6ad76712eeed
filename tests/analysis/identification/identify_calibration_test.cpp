// SPDX-License-Identifier: Apache-2.0
// Reliability of identify() over random logs. The 95 % intervals contain the true value in 93 to 97 of 100
// cases. Results with the stated probability p are right in the fraction p of the cases.
#include "sixstep/analysis/identification/hall/identify.hpp"
#include "tests/analysis/identification/counted.hpp"
#include "tests/analysis/identification/drawn_hall_log.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::HallIdentity;
using analysis::Interval;

/// The codes at the pins, from the true wiring of the log.
analysis::PinCodes true_codes(const HallTruth& t, int turned_sectors = 0) {
  analysis::PinCodes codes{};
  for (int sector = 0; sector < 6; ++sector)
    codes[static_cast<std::size_t>(sector)] = static_cast<std::uint8_t>(pin_code(t, sector - turned_sectors));
  return codes;
}

/// The common offset of all edges in the log's direction. If the log has only one direction, the offset
/// includes half the hysteresis and the rotation during the delay.
double shown_offset_deg(const DrawnLog& drawn, const HallIdentity& found) {
  const HallTruth& t = drawn.truth;
  if (found.place->hysteresis_deg) return t.offset_deg;
  const double way = drawn.forward_turns >= drawn.backward_turns ? 1.0 : -1.0;
  return t.offset_deg + way * (0.5 * t.hysteresis_deg + found.place->usual_speed_deg_s * t.delay_s);
}

double whole_sectors(double deg) { return std::floor((deg + 30.0) / 60.0); }

/// The true angle error of the edge between two codes, found by the pins' codes before and after the edge.
double true_own_deg(const HallTruth& t, std::uint8_t before, std::uint8_t after, bool& mirrored) {
  for (int n = 0; n < 6; ++n) {
    const int behind = pin_code(t, n - 1), ahead = pin_code(t, n);
    mirrored = behind == after && ahead == before;
    if (mirrored || (behind == before && ahead == after)) return t.own_deg[static_cast<std::size_t>(n)];
  }
  return NAN;
}

TEST(IdentifyCalibration, EdgesOfLogsWithoutVoltages) {
  const int count = drawn_count(90);
  HeldOften own("own place of an edge, no voltages"), jitter("bound of the jitter, no voltages");
  for (int seed = 1; seed <= count; ++seed) {
    const HallTruth truth = drawn_truth(static_cast<std::uint64_t>(seed), false);
    const auto found = analysis::identify(drawn_log(truth).log);
    ASSERT_TRUE(found) << "seed " << seed << ": " << to_string(found.problems()[0]);
    for (const analysis::IdentifiedEdge& edge : found->edges) {
      bool mirrored = false;
      const double deg = true_own_deg(truth, edge.before, edge.after, mirrored);
      own.count(edge.own_deg.holds(mirrored ? -deg : deg), truth.seed);
    }
    jitter.count(found->jitter_deg.holds(truth.jitter_deg), truth.seed);
  }
  own.expect_95(count);
  jitter.expect_95();
}

TEST(IdentifyCalibration, PlacesOfLogsWithVoltages) {
  const int count = drawn_count(60);
  HeldOften own("own place of an edge"), offset("offset"), jitter("jitter"), hysteresis("hysteresis"),
      delay("delay"), flux("flux linkage");
  double right = 0.0, expected = 0.0, variance = 0.0;
  for (int n = 1; n <= count; ++n) {
    const HallTruth truth = drawn_truth(static_cast<std::uint64_t>(n) + 300'000, true);
    const DrawnLog drawn = drawn_log(truth);
    const auto found = analysis::identify(drawn.log);
    ASSERT_TRUE(found) << "seed " << truth.seed << ": " << to_string(found.problems()[0]);
    const analysis::IdentifiedPlace& place = *found->place;
    const double shown = shown_offset_deg(drawn, *found), turned = whole_sectors(shown);
    const bool is_right = place.codes == true_codes(truth, static_cast<int>(turned));
    right += is_right;
    expected += place.probability;
    variance += place.probability * (1.0 - place.probability);
    if (!is_right) continue;
    if (std::fabs(drawn.forward_turns - drawn.backward_turns) > 1.0) {
      EXPECT_EQ(place.forward, drawn.forward_turns > drawn.backward_turns) << "seed " << truth.seed;
    }
    offset.count(place.offset_deg.holds(shown - 60.0 * turned), truth.seed);
    for (std::size_t edge = 0; edge < 6; ++edge) {
      const std::size_t was = (edge + 6 - static_cast<std::size_t>(static_cast<int>(turned) + 6) % 6) % 6;
      own.count(found->edges[edge].own_deg.holds(truth.own_deg[was]), truth.seed);
    }
    jitter.count(found->jitter_deg.holds(truth.jitter_deg), truth.seed);
    if (place.hysteresis_deg) hysteresis.count(place.hysteresis_deg->holds(truth.hysteresis_deg), truth.seed);
    if (place.delay_s) delay.count(place.delay_s->holds(truth.delay_s), truth.seed);
    flux.count(place.flux_linkage_Vs.holds(truth.flux_Vs), truth.seed);
  }
  own.expect_95(count);
  for (const HeldOften* held : {&offset, &jitter, &hysteresis, &delay, &flux}) held->expect_95();
  std::printf("wires and order: %.0f of %d right, %.2f expected\n", right, count, expected);
  EXPECT_NEAR(right, expected, 4.0 * std::sqrt(variance) + 1.0);
}

/// Only a log with rotation in both directions separates hysteresis from offset. Few random logs contain both
/// directions, so this test draws such logs. The difficult logs have many reversals and much jitter.
TEST(IdentifyCalibration, HysteresisOfLogsThatTurnBothWays) {
  const int count = drawn_count(40);
  HeldOften hysteresis("hysteresis, to and fro"), offset("offset, to and fro"), delay("delay, to and fro");
  double missed_by_lower = 0.0, missed_by_upper = 0.0;
  for (int n = 1; n <= count; ++n) {
    HallTruth truth = drawn_truth(static_cast<std::uint64_t>(n) + 400'000, true);
    truth.turning = Turning::to_and_fro;
    const auto found = analysis::identify(drawn_log(truth).log);
    if (!found || !found->place->hysteresis_deg) continue;  // too slow for a reversal over enough degrees
    const analysis::IdentifiedPlace& place = *found->place;
    const double turned = whole_sectors(truth.offset_deg);
    if (place.codes != true_codes(truth, static_cast<int>(turned))) continue;
    hysteresis.count(place.hysteresis_deg->holds(truth.hysteresis_deg), truth.seed);
    missed_by_lower += truth.hysteresis_deg < place.hysteresis_deg->low;
    missed_by_upper += truth.hysteresis_deg > place.hysteresis_deg->high;
    offset.count(place.offset_deg.holds(truth.offset_deg - 60.0 * turned), truth.seed);
    if (place.delay_s) delay.count(place.delay_s->holds(truth.delay_s), truth.seed);
  }
  for (const HeldOften* held : {&hysteresis, &offset, &delay}) held->expect_95();
  // Intervals must miss the true value equally often on both sides. More misses on one side show a bias.
  std::printf("hysteresis below its bounds in %.0f, above them in %.0f\n", missed_by_lower, missed_by_upper);
  const double missed = missed_by_lower + missed_by_upper;
  EXPECT_NEAR(missed_by_lower, 0.5 * missed, 2.0 * std::sqrt(missed) + 1.0);
}

/// A contact that is loose for up to a third of a sector causes a cluster of edges, which counts as one
/// event. The probabilities of impossible codes and angles remain correct.
TEST(IdentifyCalibration, BurstsOfALooseContact) {
  const int count = drawn_count(60);
  HeldOften own("own place of an edge, with bursts");
  double right = 0.0, expected = 0.0, variance = 0.0;
  for (int n = 1; n <= count; ++n) {
    Draw draw(static_cast<std::uint64_t>(n) + 80'000);
    HallTruth truth = drawn_truth(static_cast<std::uint64_t>(n) + 80'000, false);
    truth.bursts_s = truth.usual_turns_s * draw.decades(0.02, 0.5);
    truth.burst_rows = 2 + static_cast<int>(1.0 / (truth.row_s * truth.usual_turns_s * 6.0) / 3.0);
    const auto found = analysis::identify(drawn_log(truth).log);
    ASSERT_TRUE(found) << "seed " << truth.seed << ": " << to_string(found.problems()[0]);
    const unsigned never =
        static_cast<unsigned>(pin_code(truth, 0) ^ pin_code(truth, 2) ^ pin_code(truth, 4));
    const bool is_right = found->mask == never || (found->mask ^ 7U) == never;
    right += is_right;
    expected += found->mask_probability;
    variance += found->mask_probability * (1.0 - found->mask_probability);
    if (!is_right) continue;
    for (const analysis::IdentifiedEdge& edge : found->edges) {
      bool mirrored = false;
      const double deg = true_own_deg(truth, edge.before, edge.after, mirrored);
      own.count(edge.own_deg.holds(mirrored ? -deg : deg), truth.seed);
    }
  }
  own.expect_95(count);
  std::printf("codes that never occur: %.0f of %d right, %.2f expected\n", right, count, expected);
  EXPECT_NEAR(right, expected, 4.0 * std::sqrt(variance) + 1.0);
}

/// If the offset is close to half a sector, the sector is uncertain, and the stated probability is low. The
/// counted frequency agrees with this probability.
TEST(IdentifyCalibration, AnOffsetOfHalfASectorIsAsDoubtfulAsItSays) {
  const int count = std::min(drawn_count(60), 400);
  double right = 0.0, expected = 0.0, variance = 0.0, doubtful = 0.0;
  for (int n = 1; n <= count; ++n) {
    Draw draw(static_cast<std::uint64_t>(n) + 50'000);
    HallTruth t = drawn_truth(static_cast<std::uint64_t>(n) + 50'000, true);
    t.turning = Turning::drill;
    t.turns = 6.0;
    t.row_s = 1.0 / (t.usual_turns_s * 6.0 * 60.0);
    t.hysteresis_deg = t.delay_s = t.glitches_s = 0.0;
    t.jitter_deg = 1.5;
    t.offset_deg = draw.between(29.0, 31.0);
    const auto found = analysis::identify(drawn_log(t).log);
    ASSERT_TRUE(found) << "seed " << t.seed << ": " << to_string(found.problems()[0]);
    right += found->place->codes == true_codes(t, static_cast<int>(whole_sectors(t.offset_deg)));
    const double p = found->place->probability;
    expected += p;
    variance += p * (1.0 - p);
    doubtful += p < 0.95;
  }
  std::printf("near half a sector: %.0f of %d right, %.1f expected, %.0f below 95 %%\n", right, count,
              expected, doubtful);
  EXPECT_GT(doubtful, 0.2 * count);
  EXPECT_NEAR(right, expected, 4.0 * std::sqrt(variance));
}

}  // namespace SIXSTEP_TEST_FILE
