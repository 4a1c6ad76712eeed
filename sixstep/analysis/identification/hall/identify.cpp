// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/hall/identify.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/analysis/identification/built_machines.hpp"
#include "sixstep/analysis/identification/hall/hall_offset.hpp"
#include "sixstep/analysis/identification/hall/hall_runs.hpp"
#include "sixstep/analysis/identification/hall/motion_posterior.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/control/commutation.hpp"

namespace sixstep::analysis {
namespace {

constexpr double sector_deg = 60.0;

/// Weights of the effects in a result, which is a weighted sum of the effects.
class Weights {
 public:
  explicit Weights(const EdgeEffects& effects) : effects_(effects), values_(effects.count()) {}

  /// The mean angle of all edges.
  Weights& mean(double factor) {
    for (std::size_t n = 0; n < effects_.own; ++n) place(n, factor / static_cast<double>(effects_.own));
    return *this;
  }
  Weights& place(std::size_t n, double factor) {
    if (!effects_.relative || n + 1 < effects_.own) values_[n] += factor;
    return *this;
  }
  /// The hysteresis at standstill, without the delay's path at the usual speed.
  Weights& hysteresis() {
    values_[effects_.hysteresis_at()] = 1.0;
    if (effects_.delay) values_[effects_.delay_at()] = -2.0 * effects_.usual_speed_deg_s;
    return *this;
  }
  Weights& delay() {
    values_[effects_.delay_at()] = 1.0;
    return *this;
  }
  operator std::span<const double>() const { return values_; }

 private:
  const EdgeEffects& effects_;
  std::vector<double> values_;
};

base::Problem not_fixed() {
  return {.where = "hall1, hall2, hall3",
          .limit = "do not determine the angles of the edges",
          .cure = "turn the shaft by more turns without reversing"};
}

/// Number of whole sectors in an offset, rounded to nearest.
int whole_sectors(double offset_deg) {
  return static_cast<int>(std::floor((offset_deg + sector_deg / 2.0) / sector_deg));
}

/// The interval widened by an independent half width.
Interval widened(Interval x, double by) {
  const auto side = [by](double width) { return std::sqrt(width * width + by * by); };
  return {x.value, x.value - side(x.value - x.low), x.value + side(x.high - x.value)};
}

std::vector<IdentifiedEdge> edges_of(const FoundMotion& motion, const MotionPosterior& posterior,
                                     const PinCodes& codes, int shift) {
  const std::size_t own = motion.effects.own;
  const std::vector<double> in_step = in_step_deg(motion);
  std::vector<IdentifiedEdge> out(own);
  for (std::size_t n = 0; n < own; ++n) {
    const std::size_t at = repeating(static_cast<std::int64_t>(n) + shift, own);
    out[at].before = codes[(at + 5) % 6];
    out[at].after = codes[at % 6];
    out[at].own_deg =
        widened(posterior.effects(Weights(motion.effects).mean(-1.0).place(n, 1.0)), in_step[n]);
  }
  for (const Sighting& s : motion.sightings) {
    if (!s.is_edge || s.left_out) continue;
    const auto boundary = static_cast<std::int64_t>(std::floor(s.says_deg / sector_deg + 0.5));
    ++out[repeating(boundary + shift, own)].seen;
  }
  return out;
}

std::vector<EdgePassage> passages_of(const FoundMotion& motion, int shift) {
  std::vector<EdgePassage> out;
  for (std::size_t n = 0; n < motion.points.size(); ++n) {
    const Sighting& s = motion.sightings[n];
    const MotionPoint& p = motion.points[n];
    if (!s.is_edge) continue;
    const auto boundary = static_cast<std::int64_t>(std::floor(s.says_deg / sector_deg + 0.5));
    out.push_back({p.t_s, p.speed_deg_s, repeating(boundary + shift, motion.effects.own),
                   p.angle_deg - s.says_deg - sector_deg * shift, s.left_out, p.begins});
  }
  return out;
}

/// A Problem if the rotor passes an edge of the shaft's turn less than twice.
std::optional<base::Problem> too_rare(const HallEdges& edges, std::size_t own) {
  std::vector<std::size_t> seen(own);
  for (const HallEdge& e : edges.edges) ++seen[repeating(e.boundary, own)];
  const std::size_t least = *std::min_element(seen.begin(), seen.end());
  if (least >= 2) return {};
  return base::Problem{
      .where = "pole_pairs",
      .value = std::to_string(own / 6),
      .limit = "has " + std::to_string(own) +
               " edges in a turn of the shaft, and the log contains one of these edges " +
               (least == 0 ? "never" : "once"),
      .cure = "turn the shaft by at least two turns without reversing, or remove the pole pairs"};
}

/// Counts excluded sightings: edges, without the edges at reversals of the rotor, and voltage readings.
void count_left_out(const FoundMotion& motion, std::size_t at_turns, HallIdentity& out) {
  std::size_t edges = 0;
  for (const Sighting& s : motion.sightings) {
    if (!s.left_out) continue;
    ++(s.is_edge ? edges : out.voltages_left_out);
  }
  out.left_out = edges - at_turns;
}

void take_place(const HallOffsetEstimate& found, const MotionPosterior& posterior, HallIdentity& out) {
  const EdgeEffects& effects = found.motion.effects;
  const Weights mean = Weights(effects).mean(1.0);
  const double raw_deg = posterior.effects(mean).value;
  const int shift = whole_sectors(raw_deg);
  IdentifiedPlace place;
  for (std::uint8_t shown = 0; shown < 6; ++shown)
    place.codes[repeating(found.sector_of(shown) + shift, 6)] =
        static_cast<std::uint8_t>(control::hall_of_sector(shown) ^ out.mask);
  const double low = sector_deg * (shift - 0.5), high = sector_deg * (shift + 0.5);
  place.order_probability = found.mirrored_probability;
  place.probability =
      out.mask_probability * found.mirrored_probability * posterior.probability(mean, low, high);
  place.wires = wires_behind(place.codes);
  if (found.mirrored) std::swap(out.forward, out.backward);
  place.forward = out.forward >= out.backward;
  double in_step2 = 0.0;
  for (const double deg : in_step_deg(found.motion)) in_step2 += deg * deg;
  const Interval raw =
      widened(posterior.effects(mean), std::sqrt(in_step2) / static_cast<double>(effects.own));
  place.offset_deg = {raw.value - sector_deg * shift, raw.low - sector_deg * shift,
                      raw.high - sector_deg * shift};
  place.usual_speed_deg_s = effects.usual_speed_deg_s;
  place.both_ways = effects.hysteresis;
  place.at_turns = found.at_turns;
  if (effects.hysteresis && found.between_turns)
    place.hysteresis_deg = posterior.effects(Weights(effects).hysteresis());
  if (effects.delay) place.delay_s = posterior.effects(Weights(effects).delay());
  const VoltageModel& v = found.voltages;
  place.flux_linkage_Vs =
      around(std::sqrt(v.re_Vs[0] * v.re_Vs[0] + v.im_Vs[0] * v.im_Vs[0]), v.flux_half_width_Vs);
  place.explained = 1.0 - v.residual_V2 / v.still_V2;
  out.edges = edges_of(found.motion, posterior, place.codes, shift);
  out.passages = passages_of(found.motion, shift);
  count_left_out(found.motion, found.at_turns, out);
  out.jitter_deg = posterior.jitter_deg();
  out.place = std::move(place);
}

void take_codes(const FoundMotion& motion, const MotionPosterior& posterior, HallIdentity& out) {
  PinCodes codes{};
  for (std::uint8_t sector = 0; sector < 6; ++sector)
    codes[sector] = static_cast<std::uint8_t>(control::hall_of_sector(sector) ^ out.mask);
  out.edges = edges_of(motion, posterior, codes, 0);
  out.passages = passages_of(motion, 0);
  count_left_out(motion, 0, out);
  out.jitter_deg = posterior.jitter_deg();
  out.jitter_deg.low = 0.0;
}

/// The results that follow from the edges only, without uncertainties.
HallIdentity counted(const HallLog& log, const HallEdges& edges) {
  return {.rows = log.t_s.size(),
          .seconds = log.t_s.back() - log.t_s.front(),
          .sector_s = edges.sector_s,
          .rows_are_changes = rows_are_changes(log),
          .forward = edges.forward,
          .backward = edges.backward,
          .glitches = edges.glitches,
          .skipped = edges.skipped,
          .left_out = 0,
          .voltages_left_out = 0,
          .unused = edges.unused,
          .mask = edges.mask,
          .mask_probability = edges.mask_probability,
          .edges = {},
          .jitter_deg = {},
          .place = {},
          .passages = {}};
}

base::Result<HallIdentity> identified(const HallLog& log, int pole_pairs, const KeepGoing& keep_going) {
  const base::Result<HallEdges> edges = hall_edges(log);
  if (!edges) return edges.problems();
  if (pole_pairs > 1 && log.voltages == RecordedVoltages::none)
    return base::Problem{
        .where = "pole_pairs",
        .value = std::to_string(pole_pairs),
        .limit =
            "needs voltages: without them an uneven rotation of the shaft cannot be distinguished from "
            "displaced edges",
        .cure = "also record the voltages of the terminals, or remove the pole pairs"};
  const std::size_t own = 6 * static_cast<std::size_t>(pole_pairs);
  if (const std::optional<base::Problem> rare = too_rare(*edges, own)) return *rare;
  const std::optional<FoundMotion> by_edges = motion_of_edges(*edges, own, keep_going);
  if (!by_edges) return not_fixed();
  HallIdentity out = counted(log, *edges);
  const auto posterior_of = [&](const FoundMotion& m) {
    return MotionPosterior::of(m.sightings, m.effects.count(), m.sector_s, m.noise, keep_going);
  };
  if (log.voltages == RecordedVoltages::none) {
    const std::optional<MotionPosterior> posterior = posterior_of(*by_edges);
    if (!posterior) return not_fixed();
    take_codes(*by_edges, *posterior, out);
    return out;
  }
  const base::Result<HallOffsetEstimate> place = place_by_voltages(log, *edges, *by_edges);
  if (!place) return place.problems();
  const std::optional<MotionPosterior> posterior = posterior_of(place->motion);
  if (!posterior) return not_fixed();
  take_place(*place, *posterior, out);
  return out;
}

}  // namespace

base::Result<HallIdentity> identify(const HallLog& log, int pole_pairs, const KeepGoing& keep_going) {
  base::Result<HallIdentity> found = identified(log, pole_pairs, keep_going);
  if (keep_going && !keep_going()) return base::Problem{"identify", "", "was interrupted", "start it again"};
  if (!found) return found;
  const double frequency_Hz = 1.0 / (6.0 * found->sector_s);
  const int known_pairs = pole_pairs > 1 ? pole_pairs : 0;  // with pole_pairs 1, the six edges are the same
                                                            // for all pairs
  base::Problems wrong = check_built_speed(frequency_Hz, known_pairs);
  if (wrong.empty() && found->place)
    wrong =
        check_built_constant(std::sqrt(3.0) * found->place->flux_linkage_Vs.value, frequency_Hz, known_pairs);
  if (!wrong.empty()) return wrong;
  return found;
}

std::vector<CodePair> commutation_of(const PinCodes& codes) {
  std::vector<CodePair> out;
  for (std::uint8_t code = 0; code < 8; ++code)
    for (std::uint8_t sector = 0; sector < 6; ++sector)
      if (codes[sector] == code) out.push_back({code, sector, control::positive_pair(sector)});
  return out;
}

}  // namespace sixstep::analysis
