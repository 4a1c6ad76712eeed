// SPDX-License-Identifier: Apache-2.0
// Walks of the measurements of commissioning without a scalar: steps between two levels, fast turns, Hall
// lines, and their vectors. Each walk draws a motor, measures it to the end, and then draws the next motor.
#pragma once
#include "sixstep/control/commissioning/flux_turn.hpp"
#include "sixstep/control/commissioning/hall_survey.hpp"
#include "sixstep/control/commissioning/vector_angle.hpp"
#include "tests/target/walk/counted.hpp"
#include "tests/target/walk/digest.hpp"
#include "tests/target/walk/terminals.hpp"

namespace target {

inline constexpr std::uint16_t zero_counts = 2048;  ///< reading of a 12-bit current converter at zero current

constexpr std::int32_t signed_bits(Random& r, std::uint8_t right) {
  return static_cast<std::int32_t>(r.long_bits()) / (std::int32_t{1} << right);
}

struct VectorAngleWalk {
  void draw(Random&) {}
  static std::int64_t coordinate(Random& r) {
    const std::uint64_t high = r.long_bits(), low = r.long_bits();
    const auto any = static_cast<std::int64_t>(high << 32 | low) / 64;
    return any / (std::int64_t{1} << r.below(57));
  }
  void step(Random& r, Digest& mix) {
    const bool none = r.one_in(64);
    const std::int64_t x = none ? 0 : coordinate(r);
    const std::int64_t y = none || r.one_in(64) ? 0 : coordinate(r);
    const BinaryAngle angle = counted<0>("vector_angle", [&] { return vector_angle(x, y); });
    mix(angle);
    saw("no vector", x == 0 && y == 0);
    saw("along the axis", x > 0 && y == 0);
    saw("the first quarter", angle >> 30 == 0 && y > 0);
    saw("the second quarter", angle >> 30 == 1);
    saw("the third quarter", angle >> 30 == 2);
    saw("the fourth quarter", angle >> 30 == 3);
  }
};

struct SeenVectorWalk {
  void draw(Random&) {}
  void step(Random& r, Digest& mix) {
    std::int32_t eighths[3]{};
    for (std::int32_t& e : eighths) e = signed_bits(r, 16);  // 12 bits and a sign, in eighths
    const BinaryAngle angle = r.long_bits();
    const FieldVector seen = counted<0>("seen_along", [&] { return seen_along(eighths, angle); });
    const std::int32_t x = signed_bits(r, r.below(31)), y = signed_bits(r, r.below(31));
    const std::uint32_t length = counted<1>("length_of", [&] { return length_of(x, y); });
    mix(seen.along, seen.across, length);
    saw("along", seen.along > 0);
    saw("against", seen.along < 0);
    saw("beyond 30 bits", length > 0x3fffffffu);
    saw("short", length < 256);
  }
};

/// A winding. In each tick, its current changes by a part of its distance to the current of the level.
struct LevelStepsWalk {
  LevelStepsConfig config{};
  LevelStepsState state{};
  std::int32_t low = 0, high = 0, current = 0;
  std::int32_t per_part = 1;  ///< in 2^-8 of 1/24 count per part of the bus
  std::uint8_t slow = 2, noise = 1;
  bool begun = false;

  void begin(Random& r) {
    config.ticks = static_cast<std::uint16_t>(4 * (2 + r.below(8)));
    config.pairs = static_cast<std::uint16_t>(1 + r.below(2));
    config.late_half_ticks = r.below(3);
    high = 60000 + r.bits();
    low = high / 2;
    per_part = r.one_in(4) ? r.below(12) : 20 + r.below(100);
    slow = static_cast<std::uint8_t>(2 + r.below(6));
    noise = static_cast<std::uint8_t>(1 + r.below(24));
    state = {};
    begun = true;
  }
  void draw(Random& r) {
    if (!begun) begin(r);
  }
  void step(Random& r, Digest& mix) {
    const std::int32_t target = (state.high ? high : low) / 256 * per_part;
    current += (target - current) / slow;
    const std::int32_t along = r.one_in(512) ? signed_bits(r, 10) : current + r.below(noise);
    const auto bus = static_cast<std::uint16_t>(3000 + r.below(16));
    const bool over =
        counted<0>("level_steps_tick", [&] { return level_steps_tick(config, state, along, bus); });
    mix(over, state.level[0].all, state.level[1].tail, state.level[1].bus, state.steps, state.high);
    if (!over) return;
    const LevelStepsReading reading =
        counted<1>("level_steps_reading", [&] { return level_steps_reading(config, state, low, high); });
    mix(reading.usable, reading.resistance, reading.tau, reading.lost, reading.higher, reading.lower);
    saw("usable", reading.usable);
    saw("levels too near to each other", !reading.usable);
    saw("answered at once", reading.usable && config.late_half_ticks == 0);
    saw("answered a tick later", reading.usable && config.late_half_ticks == 2);
    begin(r);
  }
};

struct FluxTurnWalk {
  FluxTurnState state{};
  LevelStepsReading winding{};
  FieldCurrent seen{};
  std::uint8_t ticks = 1;

  void draw(Random& r) {
    winding.resistance = static_cast<std::int32_t>(r.long_bits() >> 13);
    winding.tau = static_cast<std::int32_t>(r.long_bits() >> 13);
    winding.lost = static_cast<std::int32_t>(r.bits());
    seen = {{signed_bits(r, 14), signed_bits(r, 14)}, {signed_bits(r, 26), signed_bits(r, 26)}};
    ticks = static_cast<std::uint8_t>(1 + r.below(30));
  }
  void step(Random& r, Digest& mix) {
    FieldCurrent now = seen;
    now.current.along += signed_bits(r, 20);
    now.current.across += signed_bits(r, 20);
    const auto bus = static_cast<std::uint16_t>(3000 + r.below(200));
    counted<0>("flux_turn_tick", [&] { flux_turn_tick(state, now, bus); });
    mix(state.along, state.across, state.signs_along, state.signs_across, state.bus, state.ticks);
    if (state.ticks < ticks) return;
    const auto v = static_cast<std::int32_t>(r.long_bits() % longest_vector);
    const std::uint32_t speed = r.one_in(16) ? 0 : r.long_bits() >> (4 + r.below(12));
    const FluxTurnReading reading =
        counted<1>("flux_turn_reading", [&] { return flux_turn_reading(winding, state, v, speed); });
    mix(reading.applied, reading.emf, reading.flux);
    state = {};
    saw("a back-EMF", reading.emf > 0);
    saw("more than half of the vector", 2 * static_cast<std::int64_t>(reading.emf) > reading.applied);
    saw("a field that stands", speed == 0);
    saw("more than 32 bits hold", reading.flux == 0x7fffffff);
  }
};

/// Three Hall lines with any connection. The field turns forward and back, past one edge in each step.
struct HallSurveyWalk {
  HallSurveyConfig config{};
  HallSurveyState state{};
  BinaryAngle beside[6]{}, lag = 0, jitter = 1;
  std::uint8_t probe[3]{}, inverted = 0, stuck = 0, sector = 0;
  std::uint16_t passed = 0;
  bool shorted = false, begun = false;

  void hang(Random& r) {
    const std::uint8_t way = r.below(3), first = r.below(3);
    for (std::uint8_t k = 0; k < 3; ++k) probe[k] = way == 0 ? k : static_cast<std::uint8_t>((first + k) % 3);
    inverted = way == 0 ? std::uint8_t{0} : r.below(8);
    if (way == 2) {  // straight probes 60 degrees apart, as in hall.hpp
      probe[0] = 0;
      probe[1] = 2;
      probe[2] = 1;
      inverted = 2;
    }
    stuck = r.one_in(8) ? static_cast<std::uint8_t>(1u << r.below(3)) : std::uint8_t{0};
    shorted = r.one_in(8);
  }
  std::uint8_t pins() const {
    const std::uint8_t code = hall_of_sector(sector);
    unsigned read = 0;
    for (std::uint8_t k = 0; k < 3; ++k) read = read << 1 | (code >> (2 - probe[k]) & 1u);
    read = (read ^ inverted) & ~static_cast<unsigned>(stuck);
    if (shorted) read = (read & 6u) | (read >> 1 & 1u);
    return static_cast<std::uint8_t>(read);
  }
  void begin(Random& r) {
    config.turns = static_cast<std::uint8_t>(2 + r.below(2));
    for (BinaryAngle& b : beside) b = r.long_bits() >> 6;  // up to 5.6 degrees
    lag = r.long_bits() >> 7;
    jitter = r.one_in(6) ? 0x20000000u : 0x01000000u;  // 45 or 1.4 degrees
    hang(r);
    sector = r.below(6);
    passed = 0;
    state = {};
    hall_survey_edge(config, state, pins(), 0, 0);
    begun = true;
  }
  void draw(Random& r) {
    if (!begun) begin(r);
  }
  void step(Random& r, Digest& mix) {
    const auto edges = static_cast<std::uint16_t>(6 * config.turns);
    const std::int8_t direction = passed < edges ? std::int8_t{1} : std::int8_t{-1};
    const auto next = static_cast<std::uint8_t>((sector + 6 + direction) % 6);
    const std::uint8_t edge = direction > 0 ? next : sector;
    sector = next;
    const BinaryAngle late = direction > 0 ? lag : 0u - lag;
    const BinaryAngle field =
        sector_angle(edge) + beside[edge] + late + r.long_bits() % jitter - electrical_ahead;
    const std::uint8_t read = pins();
    counted<0>("hall_survey_edge", [&] { hall_survey_edge(config, state, read, direction, field); });
    mix(state.pins, state.torn, state.edge[read].first[0], state.edge[read].sum[1], state.edge[read].before);
    if (++passed < 2 * edges) return;
    tell(mix);
    begin(r);
  }
  void tell(Digest& mix) {
    const HallSurveyReading reading =
        counted<1>("hall_survey_reading", [&] { return hall_survey_reading(config, state); });
    mix(static_cast<std::uint8_t>(reading.verdict), reading.dead_pins, reading.plain, reading.offset,
        reading.lag, static_cast<std::uint8_t>(reading.config.arrangement), reading.lines.inverted);
    for (const std::uint8_t s : reading.lines.sector) mix(s);
    for (const std::uint8_t p : reading.lines.probe) mix(p);
    for (const BinaryAngle at : reading.edges.at) mix(at);
    const bool degrees_60 = reading.config.arrangement == HallArrangement::degrees_60;
    saw("good", reading.verdict == HallSurvey::good);
    saw("a dead line", reading.verdict == HallSurvey::dead_line);
    saw("other codes", reading.verdict == HallSurvey::other_codes);
    saw("not steady", reading.verdict == HallSurvey::not_steady);
    saw("straight, 120 degrees apart", reading.plain && !degrees_60);
    saw("straight, 60 degrees apart", reading.plain && degrees_60);
    saw("a line that is inverted", reading.lines.inverted != 0);
  }
};

}  // namespace target
