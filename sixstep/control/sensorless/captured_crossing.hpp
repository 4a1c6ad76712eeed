// SPDX-License-Identifier: Apache-2.0
// Finds the zero crossing by comparators. Three lines show whether each terminal is above its reference. The
// timer captures the lines' edges.
//
//   virtual star   u_f - (u_a + u_b + u_c)/3 = (2 u_f - u_s - u_k)/3     y/3 of zero_crossing.hpp, at any time
//   half the bus   u_f - U/2 = (2 u_f - u_s - u_k)/2                     only while the pair is on, where u_s + u_k = U
//
// u_f is the voltage of the floating leg, u_s and u_k are the voltages of the driven legs, U is the bus, T
// the PWM period. Samples show a crossing once per period; the time of an edge is exact to a count of the
// timer. Samples, line and edge therefore have different tasks:
// - The samples show whether the leg's old current has ended, and whether the driven legs follow the command
//   (zero_crossing.hpp), which gives the cause of a loss.
// - The line shows on which side of its reference the leg is.
// - The edge shows since when.
//
// An edge is used only after the first sample without the old current: earlier edges belong to the freewheel.
// The freewheel also charges the low-pass tau in front of each comparator, and the line stays on the wrong
// side for a while. If the crossing occurs before the line has returned, the samples give its time.
//
// Against the virtual star the low-pass may, and should, be about as slow as a PWM period. In soft and
// complementary chopping a diode holds a negative e_f at zero outside of the pulse, where the star is at zero
// too. A current then flows in the leg and pulls it to the rail when the pulse begins, until the current has
// ended. The mean of 3 L di/dt over a period is zero. The mean of y is therefore right, but up to a pause
// late. An edge is late by
//   hard chopping   t = tau                 soft, complementary   tau <= t <= tau + (1 - d) T
//
// The lead of commutation_clock.hpp compensates the part tau of this delay.
//
// Against half the bus, soft and complementary chopping pull the leg below its reference outside of each
// pulse: the filter must settle within half a pulse. Only two signals are used: the line at the sample in the
// pulse's middle, and an edge within the same pulse. The pulse itself causes an edge outside of the pulse.
// The crossing then occurred in the pause, and the middle of the pause is used as its time.
//
// An offset shifts a crossing by the offset divided by the slope of the voltage. A hysteresis delays it by
// half of the hysteresis divided by the slope.
//
// K. Iizuka et al., Microcomputer control for sensorless brushless motor, IEEE Trans. Industry Applications
// 21 (1985) 595: filtered terminals against a star point of three resistors. All numbers are integers, as in
// zero_crossing.hpp.
#pragma once
#include <cstdint>

#include "sixstep/control/sensorless/zero_crossing.hpp"

namespace sixstep::control {

/// With the default the samples give the crossing.
struct CapturedCrossingConfig {
  bool follows = false;
  std::uint32_t lag_ticks = 0;     ///< lag of the low-pass, which delays an edge but not a sample
  std::uint32_t period_ticks = 0;  ///< PWM period if half the bus is the reference; 0: the reference is the
                                   ///< virtual star
  /// If half the bus is the reference: time from a pulse's edge until its filter has settled.
  std::uint32_t settle_ticks = 0;
  bool operator==(const CapturedCrossingConfig&) const = default;
};

struct CapturedLines {
  std::uint8_t lines = 0;   ///< lines of a, b, c as bits 2, 1, 0: 1 means above the reference
  std::uint32_t at[3]{};    ///< time of the last edge of each line
  std::uint32_t began = 0;  ///< begin of the sector
  bool came_back = false;   ///< true: in this sector the floating leg's line has had its level before the
                            ///< crossing
};

/// The capture interrupt. `lines`: levels of the lines from `at` on.
constexpr void capture_lines(CapturedLines& state, std::uint8_t lines, std::uint32_t at) {
  const unsigned changed = state.lines ^ static_cast<unsigned>(lines);
  for (std::uint8_t k = 0; k < 3; ++k)
    if ((changed & (4u >> k)) != 0) state.at[k] = at;
  state.lines = lines;
}

namespace detail {

/// Time of the crossing for an edge. `on` is the pulse's length in ticks, around the sample. If the edge is
/// in the pause before this pulse, the pulse itself causes it, and the result is the middle of the pause.
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

/// One sample, with the lines captured before it. `on` as for zero_crossing_step(). `on_ticks`: time for
/// which the pair is on around the sample; used only against half the bus.
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
