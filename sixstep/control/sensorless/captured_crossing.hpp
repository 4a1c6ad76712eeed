// SPDX-License-Identifier: Apache-2.0
// The same zero crossing by comparators: three lines, each terminal above its reference or not, whose edges the timer captures.
//
//   virtual star   u_f - (u_a + u_b + u_c)/3 = (2 u_f - u_s - u_k)/3     y of zero_crossing.hpp, in the pulse and beside it
//   half the bus   u_f - U/2 = (2 u_f - u_s - u_k)/2                     only while the pair is on, where u_s + u_k = U
//
// Samples show a crossing once a period, an edge says when it was, to a count of the timer. So each is asked what it knows: the
// samples whether the leg's old current has run out and the driven legs obey (zero_crossing.hpp, and the names of losses with
// it), the line on which side of its reference the leg stands, the edge when that came to be.
//
// An edge counts that lies behind the first sample without the old current: those before it are the freewheel's. What that left in the
// low-pass tau in front of each comparator keeps the line on the wrong side for a while; a crossing before it has come back
// is the samples' own.
// Against the virtual star it may be about as slow as a period of the PWM, and should be: in soft and complementary
// chopping a diode holds a negative e_f at nothing beside the pulse, where the star is, too. The current that flows then pulls
// the leg to the rail as the pulse begins, until it is gone: 3 L di/dt has no mean over a period, so that of y is right, and
// comes up to a pause later. An edge is late by
//
//   hard chopping   t = tau                 soft, complementary   tau <= t <= tau + (1 - d) T
//
// of which the lead of commutation_clock.hpp takes tau off. Against half the bus these two pull the leg below its reference
// beside each pulse: the filter has to be settled within half a pulse, only the line at the sample in its middle is believed,
// and an edge within that pulse; one beside it is the pulse's own, and the crossing lay somewhere in the pause: its middle
// is taken.
//
// An offset moves a crossing by offset over slope, a hysteresis by half of itself over the slope, to later.
//
// K. Iizuka et al., Microcomputer control for sensorless brushless motor, IEEE Trans. Industry Applications 21 (1985) 595: filtered
// terminals against a star point of three resistors. All numbers are whole, as there.
#pragma once
#include <cstdint>

#include "sixstep/control/sensorless/zero_crossing.hpp"

namespace sixstep::control {

/// The default leaves the crossing to the samples.
struct CapturedCrossingConfig {
  bool follows = false;
  std::uint32_t lag_ticks = 0;     ///< of the low-pass: an edge is so late, and a sample is not
  std::uint32_t period_ticks = 0;  ///< against half the bus: of the PWM; 0: against the virtual star
  std::uint32_t settle_ticks =
      0;  ///< against half the bus: behind a pulse's edge, until its filter is settled
  bool operator==(const CapturedCrossingConfig&) const = default;
};

struct CapturedLines {
  std::uint8_t lines = 0;   ///< of a, b, c as bits 2, 1, 0: 1 above the reference
  std::uint32_t at[3]{};    ///< the last edge of each
  std::uint32_t began = 0;  ///< the sector
  bool came_back = false;  ///< in it the line of the leg that floats was seen where it is before its crossing
};

/// The capture interrupt: the lines as they stand from `at` on.
constexpr void capture_lines(CapturedLines& state, std::uint8_t lines, std::uint32_t at) {
  const unsigned changed = state.lines ^ static_cast<unsigned>(lines);
  for (std::uint8_t k = 0; k < 3; ++k)
    if ((changed & (4u >> k)) != 0) state.at[k] = at;
  state.lines = lines;
}

namespace detail {

/// When the edge says that it crossed. In the pause before the pulse around the sample, `on` ticks long, it was the pulse's own.
constexpr std::uint32_t edge_at(const CapturedCrossingConfig& config, std::uint32_t edge, std::uint32_t now,
                                std::uint32_t on) {
  if (on + 1 >= config.period_ticks) return edge;
  const std::uint32_t back = now - edge, half = on / 2;
  const bool in_pulse = back + config.settle_ticks <= half || back > config.period_ticks - half;
  return in_pulse ? edge : now - config.period_ticks / 2;
}

constexpr CrossingReading look_at_line(const CapturedCrossingConfig& config,
                                       const ZeroCrossingConfig& crossing, ZeroCrossingState& state,
                                       CapturedLines& captured, CrossingReading reading, std::uint32_t on) {
  const std::uint8_t leg = floating_leg(state.sector);
  const bool above = (captured.lines & (4u >> leg)) != 0, before = above == (state.sector % 2 == 0);
  if (captured.began != state.began) captured.came_back = false;
  captured.began = state.began;
  captured.came_back = captured.came_back || before;
  const std::uint32_t since = reading.at - state.began, edge = captured.at[leg] - state.began;
  const bool of_back_emf = edge <= since && edge >= state.freewheel;
  if (!captured.came_back && !(of_back_emf && config.period_ticks == 0)) {
    reading = look(crossing, state, reading.at, reading.y, !reading.free);
    if (reading.crossing == Crossing::seen) reading.at += config.lag_ticks;
    return reading;
  }
  if (before) state.armed = true;
  if (before || since < state.earliest) return reading;
  const std::uint32_t at = of_back_emf ? edge_at(config, captured.at[leg], reading.at, on) : reading.at;
  const bool early = static_cast<std::uint32_t>(at - state.began) < state.earliest;
  reading.at = early ? state.began + state.earliest : at;
  reading.crossing = Crossing::seen;
  state.done = true;
  return reading;
}

}  // namespace detail

/// One sample, and the lines as they were captured up to it. `on` as for zero_crossing_step; `on_ticks`: how long the pair is on
/// around the sample, asked for against half the bus alone.
constexpr CrossingReading captured_crossing_step(const CapturedCrossingConfig& config,
                                                 const ZeroCrossingConfig& crossing, ZeroCrossingState& state,
                                                 CapturedLines& captured, const TerminalSample& s, bool on,
                                                 std::uint32_t on_ticks) {
  return detail::looked_at(crossing, state, s, on, [&](std::int32_t y, bool held) {
    return detail::look_at_line(config, crossing, state, captured, {Crossing::none, s.at, true, !held, y},
                                on_ticks);
  });
}

}  // namespace sixstep::control
