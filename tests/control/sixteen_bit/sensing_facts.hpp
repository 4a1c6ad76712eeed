// SPDX-License-Identifier: Apache-2.0
// Results of the decoders that are checked at compile time, as in facts.hpp. Hosts and chips with 16-bit int
// have the same digest. Gains are whole numbers, as in an export.
#pragma once
#include <cstdint>

#include "sixstep/control/sensing/gray.hpp"
#include "sixstep/control/sensing/hall_calibration.hpp"
#include "sixstep/control/sensing/pulse_speed.hpp"
#include "sixstep/control/sensing/quadrature.hpp"
#include "sixstep/control/sensing/resolver.hpp"

namespace sixstep::control::facts {

struct Mixed {
  std::uint32_t digest = 2166136261u;
  constexpr void operator()(std::uint32_t bits) { digest = (digest ^ bits) * 16777619u; }
};

template <class S>
constexpr Gain<S> gain(std::int32_t mantissa, std::int8_t right) {
  return Gain<S>::from_raw(static_cast<typename S::Storage>(mantissa), right);
}
template <class S>
constexpr std::uint32_t bits_of(S x) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(x.raw));
}

template <class S>
constexpr void mix_angles(Mixed& mix) {
  std::uint32_t x = 1;
  for (int n = 0; n < 200; ++n, x = x * 1664525u + 1013904223u) {
    const Direction<S> d = direction_of<S>(x);
    mix(bits_of(d.cos));
    mix(bits_of(d.sin));
    mix(sector_of_angle(x));
    mix(angle_of_parts(turn_in_parts((x >> 7) + 3), x >> 9));
    mix(bits_of(angle_signal<S>(static_cast<std::int32_t>(x), gain<S>(23000, 15))));
    mix(static_cast<std::uint32_t>(angle_of_rad(d.sin)));
    mix(bits_of(AngleTraits<S>::scaled(static_cast<std::int32_t>(x), gain<S>(17000, 29))));
    mix(angle_of_gray(x, static_cast<std::uint8_t>(n % 22)));
  }
}

template <class S>
constexpr void mix_pulses(Mixed& mix) {
  HallAngleConfig<S> hall;
  hall.edges.at[2] += 12345678u;
  hall.edges.half_hysteresis = 7654321u;
  hall.turn_rad_s_ticks = TickRatio<S>::from_raw(7000000);
  hall.timeout_ticks = 100000;
  hall.delay_ticks = 50;
  hall.span = 4;
  HallAngleState state;
  HallCalibrationState calibration;
  const PulseSpeedConfig<S> pulses{TickRatio<S>::from_raw(70000), 100000};
  PulseSpeedState pulse;
  const QuadratureConfig lines = quadrature_of_lines(500);
  QuadratureState count;
  std::uint32_t now = 0xffff0000u;
  for (int n = 0; n < 120; ++n, now += 1000 + static_cast<std::uint32_t>(n % 7) * 3) {
    const auto sector = static_cast<std::uint8_t>(n % 6);
    hall_angle_edge(hall, state, sector, std::int8_t{1}, now);
    hall_calibrate({16, 64}, calibration, sector, 1, now);
    const HallAngle<S> found = hall_angle(hall, state, now + 777);
    mix(found.angle);
    mix(bits_of(found.speed));
    pulse_edge(pulse, n % 9 - 2, n % 9 < 2 ? std::int8_t{-1} : std::int8_t{1}, now);
    mix(bits_of(pulse_speed(pulses, pulse, now + 321)));
    quadrature_moved(lines, count, n * 17 - 400);
    mix(quadrature_angle(lines, count));
  }
  for (const std::int32_t at : hall_deviations(calibration).at) mix(static_cast<std::uint32_t>(at));
}

template <class S>
constexpr void mix_absolute(Mixed& mix) {
  ResolverConfig<S> config;
  config.cos_per_count = config.sin_per_count = gain<S>(sizeof(S) == 2 ? 20480 : 20480 * 32768L, 12);
  config.skew = gain<S>(900, 15);
  config.loop = {FixedGain<std::int32_t>::from_raw(1503238554, 33),
                 FixedGain<std::int32_t>::from_raw(1400000000, 37)};
  ResolverState state;
  GrayConfig<S> gray{.bits = 14,
                     .tolerance = BinaryAngle{3} << 18,
                     .patience = 1,
                     .span = 5,
                     .speed_per_unit = gain<S>(20000, 28)};
  GrayState encoder;
  for (int n = 0; n < 200; ++n) {
    const Direction<Q15> d = direction_of<Q15>(static_cast<BinaryAngle>(n) * 30000000u);
    const std::int32_t sign = n % 2 == 0 ? 1 : -1;
    const auto counts = [sign](Q15 x) { return static_cast<std::uint16_t>(2048 + sign * (x.raw / 20)); };
    const ResolverReading<S> r = resolver_step(config, state, {counts(d.cos), counts(d.sin)}, sign > 0);
    mix(r.angle);
    mix(static_cast<std::uint32_t>(r.speed));
    mix(bits_of(r.square));
    const std::uint32_t code =
        gray_of_binary(static_cast<std::uint32_t>(n) * 3u) ^ (n % 50 == 30 ? 0x400u : 0u);
    const GrayReading<S> g = gray_step(gray, encoder, code);
    mix(g.position.angle);
    mix(bits_of(g.speed));
    mix(g.track);
  }
}

template <class S>
constexpr std::uint32_t sensing_digest() {
  Mixed mix;
  mix_angles<S>(mix);
  mix_pulses<S>(mix);
  mix_absolute<S>(mix);
  return mix.digest;
}

static_assert(sensing_digest<Q15>() == 2002215929u);
static_assert(sensing_digest<Q31>() == 1869699991u);

}  // namespace sixstep::control::facts
