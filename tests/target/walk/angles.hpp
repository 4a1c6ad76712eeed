// SPDX-License-Identifier: Apache-2.0
// Walks of the blocks of sensing/ that return signals: angle and speed from Hall edges, pulses, a Gray code
// and a resolver.
#pragma once
#include "sixstep/control/sensing/gray.hpp"
#include "sixstep/control/sensing/hall_angle.hpp"
#include "sixstep/control/sensing/pulse_speed.hpp"
#include "sixstep/control/sensing/resolver.hpp"
#include "tests/target/walk/counted.hpp"
#include "tests/target/walk/digest.hpp"
#include "tests/target/walk/draw.hpp"

namespace target {

template <class Scalar>
struct HallAngleWalk {
  HallAngleConfig<Scalar> config{};
  HallAngleState state{};
  std::uint32_t now = 0;
  std::uint16_t pace = 100;
  std::uint8_t sector = 0, since = 0;
  std::int8_t direction = 1;

  void draw(Random& r) {
    for (std::uint8_t n = 0; n < 6; ++n)
      config.edges.at[n] = sector_angle(n) + std::uint32_t{r.bits()} * 1024u;  // up to 5.6 degrees after the
                                                                               // sector edge
    config.edges.half_hysteresis = std::uint32_t{r.bits()} * 256u;
    config.margin = std::uint32_t{r.bits()} * 512u;
    config.turn_rad_s_ticks = Number<Scalar>::ratio(r.bits());
    config.timeout_ticks = 20000;
    config.delay_ticks = r.below(32);
    config.span = static_cast<std::uint8_t>(1 + r.below(6));
    pace = static_cast<std::uint16_t>(20 + (r.bits() & 2047));
    if (r.one_in(2)) direction = static_cast<std::int8_t>(-direction);
    if (r.one_in(8)) now += 30000;  // standstill
  }
  void step(Random& r, Digest& mix) {
    now += (static_cast<std::uint32_t>(pace) + r.bits() % (pace / 16 + 1u)) / 4;
    if (++since >= 4 && !r.one_in(6)) {
      since = 0;
      const bool fault = r.one_in(48);
      sector = static_cast<std::uint8_t>((sector + 6 + direction) % 6);
      const std::uint8_t seen = fault ? no_sector : sector;
      const std::int8_t moved = fault ? std::int8_t{0} : direction;
      counted<1>("hall_angle_edge", [&] { hall_angle_edge(config, state, seen, moved, now); });
      mix(state.edge, state.turn_ticks, state.turn.mantissa, state.turn.right);
      saw("a fault", fault);
    }
    const HallAngle<Scalar> found = counted<0>("hall_angle", [&] { return hall_angle(config, state, now); });
    mix(found.angle, found.speed);
    saw("forward", found.speed > Scalar{});
    saw("back", found.speed < Scalar{});
    saw("knows a sector and no speed", state.sector < 6 && state.turn_ticks == 0);
    saw("knows nothing", state.sector > 5);
  }
};

template <class Scalar>
struct PulseSpeedWalk {
  PulseSpeedConfig<Scalar> config{};
  PulseSpeedState state{};
  std::uint32_t now = 0;
  std::uint8_t pace = 0;
  bool back = false;

  void draw(Random& r) {
    config = {Number<Scalar>::ratio(r.bits()), std::uint32_t{20000}};
    pace = r.one_in(3) ? std::uint8_t{0} : static_cast<std::uint8_t>(1 + r.below(40));
    if (r.one_in(2)) back = !back;
    if (r.one_in(4)) now += 30000;  // standstill
  }
  void step(Random& r, Digest& mix) {
    now += 500;
    const std::int32_t passed = pace == 0 ? (r.one_in(4) ? 1 : 0) : pace + r.below(3);
    if (r.one_in(48)) back = !back;
    const std::int32_t moved = back ? -passed : passed;
    const std::uint32_t edge = now - (r.bits() % 500);
    if (passed > 0)
      counted<1>("pulse_edge",
                 [&] { pulse_edge(state, moved, back ? std::int8_t{-1} : std::int8_t{1}, edge); });
    const Scalar w = counted<0>("pulse_speed", [&] { return pulse_speed(config, state, now); });
    mix(w, state.count, state.moved, state.ticks);
    saw("forward", w > Scalar{});
    saw("back", w < Scalar{});
    saw("times out", !state.begun);
    saw("an edge that is due", passed == 0 && w != Scalar{});
    saw("an edge passed back", state.begun && state.ticks != 0 && state.moved == 0);
  }
};

template <class Scalar>
struct GrayWalk {
  GrayConfig<Scalar> config{};
  GrayState state{};
  BinaryAngle angle = 0;
  std::uint32_t pace = 0;
  std::uint8_t broken = no_track;

  void draw(Random& r) {
    config = {static_cast<std::uint8_t>(8 + r.below(13)), BinaryAngle{0}, r.below(4),
              static_cast<std::uint8_t>(1 + r.below(8)), gain<Scalar>(r, 7)};
    const BinaryAngle count = BinaryAngle{1} << (32 - config.bits);
    config.tolerance = r.one_in(4) ? 0 : 3 * count;
    pace = count * r.below(24);
    if (r.one_in(2)) pace = 0u - pace;
    broken = r.one_in(4) ? r.below(config.bits) : no_track;
    state = {};
  }
  void step(Random& r, Digest& mix) {
    angle += pace;
    if (r.one_in(64)) angle = r.long_bits();
    std::uint32_t code = gray_of_binary(angle >> (32 - config.bits));
    if (broken != no_track) code &= ~(std::uint32_t{1} << broken);
    const GrayReading<Scalar> reading =
        counted<0>("gray_step", [&] { return gray_step(config, state, code); });
    mix(reading.position.angle, reading.position.turns, reading.speed, reading.jump, reading.track,
        state.faults, counted<1>("angle_of_gray", [&] { return angle_of_gray(code, config.bits); }));
    saw("a jump", reading.jump);
    saw("a track to blame", reading.track != no_track);
    saw("forward", reading.speed > Scalar{});
    saw("back", reading.speed < Scalar{});
    saw("turns", reading.position.turns != 0);
  }
};

template <class Scalar>
struct SineWalk {
  Gain<Scalar> per_half_turn{};

  void draw(Random& r) { per_half_turn = gain<Scalar>(r, -2); }
  void step(Random& r, Digest& mix) {
    const BinaryAngle angle = r.one_in(8) ? BinaryAngle{r.below(4)} << 30 : r.long_bits();
    const auto signed_angle = static_cast<std::int32_t>(angle);
    const Direction<Scalar> d = counted<0>("direction_of", [&] { return direction_of<Scalar>(angle); });
    const Scalar x = signal<Scalar>(r);
    mix(d.cos, d.sin,
        counted<1>("angle_signal", [&] { return angle_signal<Scalar>(signed_angle, per_half_turn); }),
        counted<2>("angle_of_rad", [&] { return angle_of_rad(x); }));
    saw("a whole quarter", (angle & 0x3fffffffu) == 0);
    saw("the third quarter", angle >> 30 == 2);
  }
};

/// Readings of two windings, in 12 bits around 2048. At successive peaks of the excitation, they have
/// opposite signs.
template <class Scalar>
struct ResolverWalk {
  ResolverConfig<Scalar> config{};
  ResolverState state{};
  BinaryAngle angle = 0;
  std::uint32_t pace = 0;
  Gain<Scalar> speed_per_unit{};
  std::uint16_t size = 1000;
  bool positive_peak = false;

  void draw(Random& r) {
    // The amplitude of 1000 counts is about 1/2. Two successive peaks differ by twice the amplitude.
    config.cos_per_count = per_count<Scalar>(static_cast<std::int16_t>(16700 + r.below(128)));
    config.sin_per_count = per_count<Scalar>(static_cast<std::int16_t>(16700 + r.below(128)));
    config.cos_offset = Number<Scalar>::part(static_cast<std::int32_t>(r.bits()) * 512);
    config.sin_offset = Number<Scalar>::part(static_cast<std::int32_t>(r.bits()) * -512);
    config.skew = gain<Scalar>(r, 6);
    config.normalise = !r.one_in(3);
    config.loop.K_p = FixedGain<std::int32_t>::from_raw(static_cast<std::int32_t>(r.long_bits() >> 2), 30);
    config.loop.K_i = FixedGain<std::int32_t>::from_raw(static_cast<std::int32_t>(r.long_bits() >> 2), 34);
    config.least_square = Number<Scalar>::part(0x08000000);
    config.greatest_square = r.one_in(4) ? Scalar{} : Number<Scalar>::part(0x30000000);
    config.lost_after = r.below(4);
    speed_per_unit = gain<Scalar>(r, 7);
    pace = r.long_bits() >> (6 + r.below(8));
    if (r.one_in(2)) pace = 0u - pace;
    size = r.one_in(8) ? static_cast<std::uint16_t>(r.bits() % 2000) : std::uint16_t{1000};
  }
  void step(Random& r, Digest& mix) {
    angle += pace;
    if (r.one_in(64)) angle = r.long_bits();
    positive_peak = !positive_peak;
    const std::int32_t sign = positive_peak ? 1 : -1;
    const std::int32_t cos = sign * wave(angle + quarter_turn, size), sin = sign * wave(angle, size);
    const ResolverCounts counts{static_cast<std::uint16_t>(2048 + cos + r.below(5)),
                                static_cast<std::uint16_t>(2048 + sin + r.below(5))};
    const ResolverReading<Scalar> reading =
        counted<0>("resolver_step", [&] { return resolver_step(config, state, counts, positive_peak); });
    const Scalar w =
        counted<1>("tracked_speed", [&] { return tracked_speed<Scalar>(state.loop, speed_per_unit); });
    mix(reading.angle, reading.speed, reading.square, reading.lost, w, state.loop.speed, state.loop.error);
    if (r.one_in(96)) resolver_hold(state, counts);
    const std::int32_t off = way_between(angle, reading.angle);
    saw("follows", off < 0x04000000 && off > -0x04000000);
    saw("lost", reading.lost);
    saw("forward", reading.speed > 0);
    saw("back", reading.speed < 0);
    saw("beyond 45 degrees", off > 0x20000000 || off < -0x20000000);
  }
};

}  // namespace target
