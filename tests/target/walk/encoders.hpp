// SPDX-License-Identifier: Apache-2.0
// Walks of the blocks of sensing/ without a scalar: angles of the Hall edges, lines of an encoder, and the
// tracking loop.
#pragma once
#include "sixstep/control/sensing/hall_calibration.hpp"
#include "sixstep/control/sensing/quadrature.hpp"
#include "sixstep/control/sensing/tracking.hpp"
#include "tests/target/walk/counted.hpp"
#include "tests/target/walk/digest.hpp"
#include "tests/target/walk/draw.hpp"

namespace target {

inline void mix_edges(Digest& mix, const HallEdges& edges) {
  for (const BinaryAngle at : edges.at) mix(at);
  mix(edges.half_hysteresis);
}

struct HallCalibrationWalk {
  HallCalibrationConfig config{};
  HallCalibrationState state{};
  HallDeviations before{};  ///< deviations of the preceding run
  std::uint32_t now = 0, pace = 1000, width[6]{};
  std::uint8_t edge = 0;
  std::int8_t direction = 1;

  void draw(Random& r) {
    config = {static_cast<std::uint16_t>(1 + r.below(4)), static_cast<std::uint16_t>(16 + r.below(64))};
    pace = r.one_in(8) ? 0x20000000u : 200 + std::uint32_t{r.bits()};  // sums that exceed 32 bits
    for (std::uint32_t& w : width) w = pace + pace / 256 * r.below(32);
    if (r.one_in(2)) direction = static_cast<std::int8_t>(-direction);
    state = {};
  }
  void take(Random& r, Digest& mix) {
    const HallDeviations found = counted<1>("hall_deviations", [&] { return hall_deviations(state); });
    const auto offset = static_cast<std::int32_t>(r.long_bits());
    const BinaryAngle hysteresis = r.bits();
    mix_edges(mix, counted<2>("hall_edges", [&] { return hall_edges(found, offset, hysteresis); }));
    mix_edges(mix, hall_edges(before, found, offset, static_cast<std::int32_t>(hysteresis)));
    before = found;
  }
  void step(Random& r, Digest& mix) {
    const bool slips = r.one_in(96), back = r.one_in(96);
    const std::int8_t moved = back ? static_cast<std::int8_t>(-direction) : direction;
    edge = static_cast<std::uint8_t>((edge + 6 + moved * (slips ? 2 : 1)) % 6);
    now += width[edge] + (r.one_in(64) ? pace / 4 : pace / 1024 * r.below(8));
    const HallCalibration result =
        counted<0>("hall_calibrate", [&] { return hall_calibrate(config, state, edge, moved, now); });
    mix(static_cast<std::uint8_t>(result), state.turns, state.passed, state.first,
        static_cast<std::int64_t>(state.after[0]), static_cast<std::int64_t>(state.after[5]));
    saw("done", result == HallCalibration::done);
    saw("unsteady", result == HallCalibration::unsteady);
    saw("disturbed", result == HallCalibration::disturbed);
    saw("a turn beyond 32 bits", state.after[0] > 0xffffffffu);
    if (result == HallCalibration::done) take(r, mix);
    if (result != HallCalibration::running && r.one_in(2)) state = {};
  }
};

struct QuadratureWalk {
  QuadratureConfig config{};
  QuadratureState state{}, timer{};
  std::uint32_t count = 0;  ///< the encoder's position in counts, 0..config.counts-1
  bool back = false;

  void draw(Random& r) {
    const std::uint32_t lines = r.one_in(4) ? 1 + std::uint32_t{r.bits()} : std::uint32_t{2} + r.below(30);
    config = quadrature_of_lines(lines);
    config.index_quarter = r.below(4);
    count = 0;
    state = {};
    timer = {};
    back = r.one_in(2);
  }
  void move(std::uint32_t by) { count = (count + (back ? config.counts - by : by)) % config.counts; }
  void step(Random& r, Digest& mix) {
    if (r.one_in(32)) back = !back;
    const std::uint8_t kind = r.below(64);
    move(kind < 4   ? 0
         : kind < 6 ? 2
         : kind < 8 ? 4
                    : 1);  // 4 is a missed line period, which only the index
                           // detects
    const std::uint32_t quarter = count & 3;
    const bool a = quarter < 2, b = quarter == 1 || quarter == 2, z = count < 4 || r.one_in(256);
    const std::int8_t moved =
        counted<0>("quadrature_step", [&] { return quadrature_step(config, state, a, b, z); });
    const std::int32_t passed = drawn_way(r);
    const bool index = r.one_in(8);
    const std::uint32_t at = r.long_bits() % config.counts;
    counted<1>("quadrature_moved+quadrature_index", [&] {
      quadrature_moved(config, timer, passed);
      if (index) quadrature_index(config, timer, at);
    });
    mix(moved, state.in_turn, state.turns, state.direction, state.illegal, state.corrections, state.missed);
    mix(timer.in_turn, timer.turns, timer.missed,
        counted<2>("quadrature_angle", [&] { return quadrature_angle(config, state); }));
    saw("both lines at once", moved == 2 || moved == -2);
    saw("an index", state.referenced);
    saw("an index that mends", state.corrections > 0);
    saw("turns back", state.turns < 0);
  }
  /// A random angle of less than one turn, in counts.
  std::int32_t drawn_way(Random& r) const {
    const auto way = static_cast<std::int32_t>(r.long_bits() % config.counts);
    return r.one_in(2) ? -way : way;
  }
};

struct TrackingWalk {
  TrackingConfig config{};
  TrackingState state{};
  BinaryAngle angle = 0;
  std::uint32_t pace = 0;

  void draw(Random& r) {
    config.K_p = FixedGain<std::int32_t>::from_raw(static_cast<std::int32_t>(r.long_bits() >> 1), 31);
    const auto right = static_cast<std::int8_t>(29 + r.below(12));
    config.K_i = FixedGain<std::int32_t>::from_raw(static_cast<std::int32_t>(r.long_bits() >> 1), right);
    const std::uint8_t slower = r.below(16);
    pace = r.long_bits() >> slower;
    if (r.one_in(8)) state = {};
  }
  void step(Random& r, Digest& mix) {
    angle += pace + r.bits();
    if (r.one_in(32)) angle = r.long_bits();
    counted<0>("tracking_follow", [&] { tracking_follow(config, state, angle); });
    const std::int32_t w = counted<1>("tracking_speed", [&] { return tracking_speed(state); });
    mix(state.angle, state.speed, state.error, w);
    saw("forward", w > 0);
    saw("back", w < 0);
    saw("at its greatest speed",
        state.speed == std::int64_t{1} << 47 || state.speed == -(std::int64_t{1} << 47));
    saw("close", state.error < 0x00100000 && state.error > -0x00100000);
  }
};

}  // namespace target
