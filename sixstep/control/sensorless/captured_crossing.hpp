// SPDX-License-Identifier: Apache-2.0
// Finds the zero crossing by comparators. Three comparator lines show whether each terminal is above its
// reference. The timer captures the edges of the lines.
//
//   virtual star   u_f - (u_a + u_b + u_c)/3 = (2 u_f - u_s - u_k)/3     y/3 of zero_crossing.hpp, at any time
//   half the bus   u_f - U/2 = (2 u_f - u_s - u_k)/2                     only while the pair is on, where u_s + u_k = U
//
// u_f is the voltage of the floating leg, u_s and u_k are the voltages of the driven legs, U is the bus, T
// the PWM period. y is the voltage that zero_crossing.hpp evaluates. A sample is taken once per period; the
// time of an edge is exact to one timer count. Samples, lines and edges therefore have different tasks:
// - The samples show whether the leg's old current has ended, and whether the driven legs follow the command
//   (zero_crossing.hpp).
// - The line shows whether the leg is above or below its reference.
// - The edge shows the time of the crossing.
//
// An edge is used only after the first sample without the old current: the freewheel of the old current
// causes earlier edges. The freewheel also charges the low-pass (time constant tau) in front of each
// comparator, so that the line has the wrong level for some time. If the crossing occurs before the line has
// the right level again, the samples determine the crossing's time.
//
// With the virtual star as the reference, tau should be about a PWM period. In soft and complementary
// chopping a diode clamps a negative back-EMF e_f at zero outside of the pulse, where the star is at zero
// too. A current then flows in the leg. When the pulse begins, this current pulls the leg to the rail until
// the current has ended. The mean of 3 L di/dt over a period is zero. The mean of y is therefore right, but
// delayed by up to a pause. The delay t of an edge is (d: duty)
//   hard chopping   t = tau                 soft, complementary   tau <= t <= tau + (1 - d) T
//
// The lead of commutation_clock.hpp compensates the part tau of this delay.
//
// With half the bus as the reference, soft and complementary chopping pull the leg below its reference
// outside of each pulse. The filter must settle within half a pulse. Only two signals are used: the line at
// the sample in the middle of the pulse, and an edge within the same pulse. If the last edge is outside of
// the pulse, the pulse itself has caused it. The crossing then occurred in the pause, and the middle of the
// pause is used as its time.
//
// A comparator's offset shifts a crossing by the offset divided by the slope of the voltage. A hysteresis
// delays a crossing by half of the hysteresis divided by the slope.
//
// K. Iizuka et al., Microcomputer control for sensorless brushless motor, IEEE Trans. Industry Applications
// 21 (1985) 595: filtered terminals against a star point of three resistors. All numbers are integers, as in
// zero_crossing.hpp.
#pragma once
#include <cstdint>

#include "sixstep/control/sensorless/zero_crossing.hpp"

namespace sixstep::control {

/// Default: the samples determine the crossing.
struct CapturedCrossingConfig {
  bool follows = false;
  std::uint32_t lag_ticks = 0;     ///< lag of the low-pass, which delays an edge but not a sample
  std::uint32_t period_ticks = 0;  ///< PWM period if half the bus is the reference; 0: the reference is the
                                   ///< virtual star
  /// If half the bus is the reference: time from a pulse's edge until the filter has settled.
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

/// Time of the crossing for an edge. `on` is the length of the pulse around the sample, in ticks. If the edge
/// is in the pause before this pulse, the pulse itself causes it, and the result is the middle of the pause.
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

/// One sample, with the lines that were captured before the sample. `on` as for zero_crossing_step().
/// `on_ticks`: on-time of the pair around the sample; used only if half the bus is the reference.
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
