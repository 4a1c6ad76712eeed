// SPDX-License-Identifier: Apache-2.0
// Measures at which rotor angles the Hall pins change, and which code they have between. A field turns the
// rotor slowly, forward and then backward, and each edge is recorded with the field's angle. The survey
// finds, without data of the probes:
// - which line is connected to which pin, and which lines are inverted,
// - whether the probes are 120 or 60 degrees apart,
// - the errors of the probes' positions.
//
// The rotor's d axis lags the field. The lag has three causes: friction divided by the torque of the current,
// the delay of the field, and half of the probes' hysteresis. All three change their sign with the direction,
// and cancel in the mean of the two directions:
//
//   edge = (forward + backward)/2,   lag = (forward - backward)/2          theta_e = theta_d + 150 degrees (model.md 7)
//
// Two causes of error do not change their sign: cogging, and a back-EMF that is not sinusoidal. In a field at
// rest a rotor whose back-EMF is a trapezoid of 120 degrees deviates by up to 1.12 degrees. At each multiple
// of 30 degrees the deviation is 0. The error is larger if six times the rotor's electrical speed is near
// sqrt(1.5 p^2 psi I/J). This is the frequency at which the rotor oscillates in the field, with pole pairs p,
// flux linkage psi, current I and inertia J.
#pragma once
#include <cstdint>

#include "sixstep/control/commutation.hpp"
#include "sixstep/control/hall.hpp"
#include "sixstep/control/sensing/hall_angle.hpp"

namespace sixstep::control {

/// Angle by which theta_e is ahead of the rotor's d axis, which follows the field.
inline constexpr BinaryAngle electrical_ahead = 1789569707u;  // 150 degrees

struct HallSurveyConfig {
  std::uint8_t turns = 2;                   ///< electrical turns that are recorded in each direction
  BinaryAngle widest = binary_degrees(15);  ///< largest distance between repeated edges of the same code
  bool operator==(const HallSurveyConfig&) const = default;
};

/// The edge at which a code begins when the rotor turns forward. When the rotor turns backward, the code ends
/// at this edge.
struct SurveyedEdge {
  BinaryAngle first[2]{};  ///< theta_e at the first record of the edge, forward and backward
  std::int64_t sum[2]{};   ///< sum of the angles by which later records are ahead of the first record
  std::uint8_t count[2]{};
  std::uint8_t before = 0xff;  ///< the code that ends at the edge when the rotor turns forward
};

struct HallSurveyState {
  SurveyedEdge edge[8]{};  ///< indexed by the code that begins at the edge when the rotor turns forward
  std::uint8_t pins = 0xff;
  bool torn = false;  ///< true: repeated edges of one code are too far apart, or the codes before them differ
};

enum class HallSurvey : std::uint8_t {
  good,
  dead_line,    ///< a pin never changed
  other_codes,  ///< the codes are not six in the same order in both directions: a line is shorted, or the
                ///< probes have another arrangement
  not_steady    ///< repeated edges of one code are too far apart, or edges were missed: the rotor does not
                ///< follow the field
};

/// Assignment of the pins to probes that are 120 degrees apart.
struct HallLines {
  std::uint8_t sector[8] = {no_sector, no_sector, no_sector, no_sector,
                            no_sector, no_sector, no_sector, no_sector};  ///< sector of each code of the pins
  std::uint8_t probe[3]{};    ///< number 1..3 of the probe at pin H1, H2, H3
  std::uint8_t inverted = 0;  ///< mask of the pins that carry the inverted signal of their probe
  bool operator==(const HallLines&) const = default;
};

struct HallSurveyReading {
  HallSurvey verdict = HallSurvey::not_steady;
  std::uint8_t dead_pins = 0;  ///< mask of the pins that never changed, as bits of a code
  HallLines lines{};
  /// True if no table is needed: hall.hpp decodes the pins with only `config`.
  bool plain = false;
  HallConfig config{};
  HallEdges edges{};        ///< electrical angle of each edge
  std::int32_t offset = 0;  ///< mean angle by which the edges are ahead of multiples of 60 degrees, signed
                            ///< angle
  std::int32_t lag = 0;     ///< mean angle by which the edges lag in each direction, signed angle
};

/// The code that correctly connected probes, 120 degrees apart, have where the pins read `pins`; 000 if no
/// sector has these pins.
constexpr std::uint8_t as_wired(const HallLines& lines, std::uint8_t pins) {
  return hall_of_sector(lines.sector[pins & 7u]);
}

/// The pins changed to `pins` while the field was at angle `field` and turned in `direction`. The first call
/// records the code without an edge.
constexpr void hall_survey_edge(const HallSurveyConfig& config, HallSurveyState& state, std::uint8_t pins,
                                std::int8_t direction, BinaryAngle field) {
  const std::uint8_t before = state.pins, now = pins & 7u;
  state.pins = now;
  if (before == 0xff || before == now || direction == 0) return;
  SurveyedEdge& edge = state.edge[direction > 0 ? now : before];
  const std::uint8_t behind = direction > 0 ? before : now;
  if (edge.before != 0xff && edge.before != behind) state.torn = true;
  edge.before = behind;
  const std::uint8_t way = direction > 0 ? 0 : 1;
  const BinaryAngle at = field + electrical_ahead;
  if (edge.count[way] == 0) edge.first[way] = at;
  const std::int32_t ahead = way_between(edge.first[way], at);
  if (ahead > static_cast<std::int32_t>(config.widest) || ahead < -static_cast<std::int32_t>(config.widest))
    state.torn = true;
  edge.sum[way] += ahead;
  if (edge.count[way] < 255) ++edge.count[way];
}

namespace detail {

constexpr BinaryAngle surveyed(const SurveyedEdge& edge, int way) {
  return edge.first[way] + static_cast<BinaryAngle>(edge.sum[way] / edge.count[way]);
}

/// Returns `good` if six codes follow each other cyclically and each edge was found in both directions.
constexpr HallSurvey survey_verdict(const HallSurveyConfig& config, const HallSurveyState& state,
                                    std::uint8_t& dead_pins) {
  unsigned seen = 0, ones = 0, zeros = 0;
  bool missed = state.torn;
  for (unsigned code = 0; code < 8; ++code) {
    const SurveyedEdge& edge = state.edge[code];
    if (edge.count[0] == 0 && edge.count[1] == 0) continue;
    ++seen;
    ones |= code;
    zeros |= ~code & 7u;
    for (const std::uint8_t count : edge.count)
      missed = missed || count + 1 < config.turns || count > config.turns + 1 || count == 0;
  }
  dead_pins = static_cast<std::uint8_t>(~(ones & zeros) & 7u);
  if (dead_pins != 0) return HallSurvey::dead_line;
  if (missed) return HallSurvey::not_steady;
  std::uint8_t code = state.pins, steps = 0;
  do {
    code = state.edge[code].before;
    ++steps;
  } while (code < 8 && code != state.pins && steps < 8);
  return seen == 6 && steps == 6 && code == state.pins ? HallSurvey::good : HallSurvey::other_codes;
}

/// Assigns a probe to each pin. Probes 1, 2, 3 rise at the begin of sectors 5, 1, 3 and fall at the begin of
/// sectors 2, 4, 0.
constexpr void name_lines(HallLines& lines) {
  for (unsigned pin = 0; pin < 3; ++pin) {
    const unsigned bit = 4u >> pin;
    unsigned high = 0;  // sectors in which the pin is high
    for (unsigned code = 0; code < 8; ++code)
      if ((code & bit) != 0 && lines.sector[code] < 6) high |= 1u << lines.sector[code];
    for (unsigned probe = 0; probe < 3; ++probe) {
      unsigned due = 0;
      for (std::uint8_t sector = 0; sector < 6; ++sector)
        if ((hall_of_sector(sector) & (4u >> probe)) != 0) due |= 1u << sector;
      if (high == due || high == (~due & 0x3fu)) lines.probe[pin] = static_cast<std::uint8_t>(probe + 1);
      if (high == (~due & 0x3fu)) lines.inverted = static_cast<std::uint8_t>(lines.inverted | bit);
    }
  }
}

/// Sets reading.plain if the lines match correctly connected probes, which need no table.
constexpr void name_arrangement(HallSurveyReading& reading) {
  constexpr HallArrangement arrangements[] = {HallArrangement::degrees_120, HallArrangement::degrees_60};
  for (const HallArrangement arrangement : arrangements) {
    bool same = true;
    for (std::uint8_t pins = 0; pins < 8; ++pins)
      if (reading.lines.sector[pins] < 6)
        same = same && as_120_degrees(arrangement, pins) == as_wired(reading.lines, pins);
    if (!same) continue;
    reading.plain = true;
    reading.config.arrangement = arrangement;
    return;
  }
}

/// Assigns sector and angle to each edge. Sector 0 begins at the edge nearest to 0 degrees. The mean offset
/// of all six edges determines this edge.
constexpr void place_edges(const HallSurveyState& state, HallSurveyReading& reading) {
  std::uint8_t ring[6]{};
  BinaryAngle at[6]{};
  std::int64_t lag = 0, ahead = 0;
  std::uint8_t code = state.pins;
  for (std::uint8_t n = 6; n-- > 0; code = state.edge[code].before) {
    const SurveyedEdge& edge = state.edge[code];
    const BinaryAngle forward = surveyed(edge, 0);
    const std::int32_t apart = way_between(surveyed(edge, 1), forward);
    ring[n] = code;
    at[n] = forward - static_cast<BinaryAngle>(apart / 2);
    lag += apart / 2;
  }
  for (std::uint8_t n = 0; n < 6; ++n) ahead += way_between(at[0] + sector_angle(n), at[n]);
  const BinaryAngle mean = at[0] + static_cast<BinaryAngle>(ahead / 6);  // position of ring[0]'s edge,
                                                                         // averaged over all edges
  const std::uint8_t first = sector_of_angle(mean + sector_angle(1) / 2);
  reading.offset = way_between(sector_angle(first), mean);
  for (std::uint8_t n = 0; n < 6; ++n) {
    const auto sector = static_cast<std::uint8_t>((first + n) % 6);
    reading.lines.sector[ring[n]] = sector;
    reading.edges.at[sector] = at[n];
  }
  reading.lag = static_cast<std::int32_t>(lag / 6);
}

}  // namespace detail

/// Result after whole turns in both directions.
constexpr HallSurveyReading hall_survey_reading(const HallSurveyConfig& config,
                                                const HallSurveyState& state) {
  HallSurveyReading reading{};
  reading.verdict = detail::survey_verdict(config, state, reading.dead_pins);
  if (reading.verdict != HallSurvey::good) return reading;
  detail::place_edges(state, reading);
  detail::name_lines(reading.lines);
  detail::name_arrangement(reading);
  return reading;
}

}  // namespace sixstep::control
