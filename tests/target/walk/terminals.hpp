// SPDX-License-Identifier: Apache-2.0
// The terminals of a motor, computed in integers, which are the same on every processor. The back-EMF is
// trapezoidal (model.md 1 and 2). The driven pair turns the rotor, and friction brakes it.
#pragma once
#include "sixstep/control/sensing/binary_angle.hpp"
#include "sixstep/control/sensorless/zero_crossing.hpp"
#include "tests/target/walk/draw.hpp"

namespace target {

inline constexpr std::uint32_t tick_ticks = 1000;  ///< timer counts per control tick
inline constexpr std::uint16_t bus_counts = 3200;

/// The pair that the bridge drives, if it is on.
struct DrivenPair {
  bool on = false;
  Pair pair{};
};

/// The sector in which a pair has its positive torque.
constexpr std::uint8_t sector_of_pair(Pair pair) {
  for (std::uint8_t n = 0; n < 5; ++n)
    if (positive_pair(n).source == pair.source && positive_pair(n).sink == pair.sink) return n;
  return 5;
}

struct TerminalRotor {
  BinaryAngle angle = 0;   ///< electrical
  std::int32_t speed = 0;  ///< 2^-32 electrical turn per control tick
  std::uint8_t demagnetises = 0;
  std::uint8_t driven = no_sector;

  /// Back-EMF on the flat top, in counts. At 30 ticks per turn, it is a third of the bus voltage.
  constexpr std::int32_t emf() const { return speed / 131072; }

  /// The trapezoid of a phase with a flat top of 120 degrees and the height emf(). It is positive in the two
  /// sectors in which the phase is the source.
  constexpr std::int32_t emf_of(std::uint8_t phase) const {
    const BinaryAngle behind = angle - sector_angle(static_cast<std::uint8_t>(2 * phase));
    const std::uint32_t sixths = (behind >> 16) * 6;
    const auto way = static_cast<std::int32_t>(sixths & 0xffffu) / 16;
    const std::int32_t e = emf(), falling = e - e * way / 2048;
    switch (sixths >> 16) {
      case 0:
      case 1:
        return e;
      case 2:
        return falling;
      case 3:
      case 4:
        return -e;
      default:
        return -falling;
    }
  }
  constexpr std::uint8_t sector() const { return sector_of_angle(angle); }

  /// Advances by a control tick. The torque of a pair is approximately the sine of the angle by which its
  /// field leads.
  constexpr void turn(const DrivenPair& pair, std::int32_t pull) {
    constexpr std::int8_t torque[6] = {2, 1, -1, -2, -1, 1};
    const std::uint8_t sector_driven = pair.on ? sector_of_pair(pair.pair) : no_sector;
    if (sector_driven != driven) demagnetises = driven == no_sector ? 0 : 2;
    driven = sector_driven;
    if (pair.on) speed += torque[(driven + 6 - sector()) % 6] * pull;
    speed -= speed / 64;
    angle += static_cast<std::uint32_t>(speed);
  }

  static constexpr std::uint16_t counts(std::int32_t u) {
    return static_cast<std::uint16_t>(u < 0 ? 0 : u > bus_counts ? bus_counts : u);
  }

  /// Samples the terminals. `on`: true if the switches of the pair are on; otherwise the current freewheels
  /// through the two lower switches.
  constexpr TerminalSample sample(std::uint32_t at, bool on, std::int32_t noise) {
    TerminalSample s{};
    s.bus = bus_counts;
    s.at = at;
    if (driven == no_sector) {
      for (std::uint8_t k = 0; k < 3; ++k) s.u[k] = counts(bus_counts / 2 + emf_of(k) + (k == 0 ? noise : 0));
      return s;
    }
    const Pair pair = positive_pair(driven);
    const auto source = static_cast<std::uint8_t>(pair.source), sink = static_cast<std::uint8_t>(pair.sink);
    const std::uint8_t leg = floating_leg(driven);
    s.u[source] = on ? bus_counts : std::uint16_t{0};
    const std::int32_t star = (s.u[source] - emf_of(source) - emf_of(sink)) / 2;
    s.u[leg] = counts(star + emf_of(leg) + noise);
    if (demagnetises > 0) {
      --demagnetises;  // the old current of a driven motor connects the leg to the rail that looks like a
                       // crossing
      s.u[leg] = driven % 2 == 0 ? std::uint16_t{0} : bus_counts;
    }
    return s;
  }
};

/// A sample with random values of the converter.
constexpr TerminalSample wild_sample(Random& r, std::uint32_t at) {
  TerminalSample s{};
  for (std::uint16_t& u : s.u) u = static_cast<std::uint16_t>(r.bits() & 4095);
  s.bus = static_cast<std::uint16_t>(r.bits() & 4095);
  s.at = at;
  return s;
}

/// A random speed for a rotor that an external drive turns, in either direction.
constexpr std::int32_t drawn_pace(Random& r) {
  const std::int32_t pace =
      4000000 + static_cast<std::int32_t>(r.long_bits() >> 6);  // 60 to 1000 ticks per turn
  return r.one_in(2) ? -pace : pace;
}

/// Random noise of -n to n counts.
constexpr std::int32_t drawn_noise(Random& r, std::int32_t n) {
  return static_cast<std::int32_t>(r.bits() % static_cast<std::uint16_t>(2 * n + 1)) - n;
}

}  // namespace target
