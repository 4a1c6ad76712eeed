// SPDX-License-Identifier: Apache-2.0
// Selects the source of the back-EMF: the terminal (zero_crossing.hpp), or an observer. An observer averages
// the converters' noise and has a known delay. Call observer_step once per control tick.
//
// The observer returns the floating leg's estimate as counts of y = 2 e_f - e_s - e_k, like
// zero_crossing.hpp, so that lock, clock and thresholds need no change. While the leg's old current decays
// the observer has no input. The first sample after this time sets the estimate. A crossing during this time
// is reported as passed, as without an observer.
//
//   luenberger     crossing of the estimate, minus the estimate's lag; commutation half a sector later by the
//                  clock
//   sliding mode   as luenberger
//   flux           crossing of the mean back-EMF; commutation when the flux linkage has fallen by its level
//
// One observer is used for all legs: at a commutation its estimate continues with the next floating leg.
// Samples are in the middle of a centred pulse, and commands take effect half a period later. The mean
// voltage from sample to sample is therefore the mean of the two samples. If the pair changed or the diode
// stopped conducting within a period, the mean is unknown and the estimate does not change.
#pragma once
#include <cstdint>

#include "sixstep/control/commutation.hpp"
#include "sixstep/control/sensorless/floating_voltage.hpp"
#include "sixstep/control/sensorless/flux_linkage.hpp"
#include "sixstep/control/sensorless/luenberger.hpp"
#include "sixstep/control/sensorless/sliding_mode.hpp"

namespace sixstep::control {

/// Source of the crossings. `comparators`: edges of the comparators (captured_crossing.hpp), without an
/// observer.
enum class Follow : std::uint8_t { crossings, luenberger, sliding_mode, flux, comparators };

constexpr bool observes(Follow follow) {
  return follow != Follow::crossings && follow != Follow::comparators;
}

/// Default: the terminal's crossings are used, at the cost of one branch.
template <class Scalar>
struct ObserverConfig {
  Follow follow = Follow::crossings;
  FloatingVoltageConfig<Scalar> voltage{};
  LuenbergerConfig<Scalar> luenberger{};
  SlidingModeConfig<Scalar> sliding_mode{};
  FluxLinkageConfig<Scalar> flux{};
  Gain<Scalar> counts_per_V{};  ///< 3 counts of the converter per V; in fixed point: raw units
  std::uint32_t lag_ticks = 0;  ///< delay of the estimate, ticks of the timer
  bool operator==(const ObserverConfig&) const = default;
};

template <class Scalar>
struct ObserverState {
  FloatingVoltage<Scalar> before{};  ///< voltage of the floating phase at the last sample
  LuenbergerState<Scalar> luenberger{};
  SlidingModeState<Scalar> sliding_mode{};
  FluxLinkageState<Scalar> flux{};
  std::uint32_t at = 0;  ///< time of the last sample
  std::uint8_t sector = no_sector;
  bool runs_out = false;  ///< true: the old current of this sector's leg still flows
  bool crossed = false;   ///< true: the estimate has fallen below zero in this sector
};

/// Result of the observer for the drive.
struct Observed {
  bool follows = false;         ///< true: the observer's crossing is used; false: the terminal's crossing
  bool blind = false;           ///< true: the old current still hides the back-EMF
  std::int32_t y = 0;           ///< y, counts; its sign is chosen so that y falls through zero
  std::uint32_t lag_ticks = 0;  ///< age of y
  bool by_level = false;        ///< true: the flux linkage determines the commutation
  bool due = false;             ///< true: the commutation is due within the next period
  /// Ticks from now to the commutation, at least 1. A compare match changes the pair at this time.
  std::uint32_t due_ticks = 0;
};

namespace detail {

/// The number truncated to an integer. In fixed point: the raw number.
template <class Scalar>
constexpr std::int32_t as_counts(Scalar x) {
  if constexpr (requires { x.raw; })
    return static_cast<std::int32_t>(x.raw);
  else
    return static_cast<std::int32_t>(x);
}

/// part times whole, for 0 <= part <= 1.
template <class Scalar>
constexpr std::uint32_t part_of_ticks(Scalar part, std::uint32_t whole) {
  if constexpr (requires { part.raw; }) {
    constexpr int bits = Scalar::fraction_bits;  // 15 bits suffice for one period
    const auto raw = static_cast<std::uint32_t>(part.raw);
    const std::uint32_t digits =
        bits > 15 ? raw >> (bits > 15 ? bits - 15 : 0) : raw << (bits < 15 ? 15 - bits : 0);
    return (whole >> 15) * digits + ((whole & 0x7fffu) * digits >> 15);
  } else {
    return static_cast<std::uint32_t>(static_cast<Scalar>(whole) * part);
  }
}

/// Begins a sector, in which the next leg floats.
template <class Scalar>
constexpr void observer_begin(Follow follow, ObserverState<Scalar>& state, std::uint8_t sector) {
  if (follow == Follow::luenberger) luenberger_begin(state.luenberger);
  if (follow == Follow::sliding_mode) sliding_mode_begin(state.sliding_mode);
  if (follow == Follow::flux) flux_linkage_begin(state.flux);
  state.sector = sector;
  state.runs_out = true;
  state.crossed = false;
}

/// Sets all estimates when the old current has ended.
template <class Scalar>
constexpr void observer_set(const ObserverConfig<Scalar>& config, ObserverState<Scalar>& state, Scalar e_V,
                            Scalar i_A) {
  luenberger_set(state.luenberger, e_V, i_A);
  sliding_mode_set(config.sliding_mode, state.sliding_mode, e_V, i_A);
  state.flux.i_A = i_A;
  state.flux.g_V = e_V;
}

/// Advances by one period; returns the estimate, V.
template <class Scalar>
constexpr Scalar observed_voltage(const ObserverConfig<Scalar>& config, ObserverState<Scalar>& state,
                                  bool known, Scalar w_V, Scalar i_A) {
  switch (config.follow) {
    case Follow::luenberger:
      return known ? luenberger_step(config.luenberger, state.luenberger, w_V, i_A)
                   : luenberger_hold(state.luenberger, i_A);
    case Follow::sliding_mode:
      return known ? sliding_mode_step(config.sliding_mode, state.sliding_mode, w_V, i_A)
                   : sliding_mode_hold(state.sliding_mode, i_A);
    case Follow::flux:
      return known ? flux_linkage_step(config.flux, state.flux, w_V, i_A)
                   : flux_linkage_hold(state.flux, i_A);
    case Follow::crossings:
    case Follow::comparators:
      break;
  }
  return Scalar{};
}

}  // namespace detail

/// One control tick in `sector`. `command`: the command in effect since the last tick, with the pair of the
/// last commutation.
template <class Scalar>
constexpr Observed observer_step(const ObserverConfig<Scalar>& config, ObserverState<Scalar>& state,
                                 const TerminalSample& s, const BridgeCommand<Scalar>& command,
                                 const Measurement<Scalar>& measured, std::uint8_t sector) {
  using T = ScalarTraits<Scalar>;
  if (!observes(config.follow) || sector > 5) return {};
  const bool falls = sector % 2 == 0, moved = sector != state.sector;
  const std::uint8_t leg = floating_leg(sector);
  FloatingVoltage<Scalar> now = floating_voltage(config.voltage, s, leg, falls, command, measured.bus_V);
  Scalar i = phase_current(measured, static_cast<Leg>(leg));
  if (now.known && !now.held) i = Scalar{};  // without current the amplifier shows only noise
  if (!falls) {
    now.w_V = -now.w_V;
    i = -i;
  }
  if (moved) detail::observer_begin(config.follow, state, sector);
  const bool blind = state.runs_out && now.held && !config.voltage.through_freewheel;
  const bool released = state.runs_out && !now.held && now.known && state.before.held && !moved;
  if (now.known && !now.held) state.runs_out = false;
  // After the crossing the freewheel of soft chopping clamps the leg to the same rail again, and the terminal
  // does not show the back-EMF.
  const bool known = !moved && !blind && now.known && state.before.known && now.held == state.before.held &&
                     !(now.held && state.crossed);
  const Scalar w = T::half_difference(state.before.w_V, -now.w_V);
  const std::uint32_t period = s.at - state.at;
  state.before = now;
  state.at = s.at;
  if (released) detail::observer_set(config, state, now.w_V, i);
  const Scalar e = detail::observed_voltage(config, state, known, w, i);
  state.crossed = e < Scalar{};
  Observed observed{.follows = true,
                    .blind = blind,
                    .y = detail::as_counts(T::product(e, config.counts_per_V)),
                    .lag_ticks = config.lag_ticks,
                    .by_level = config.follow == Follow::flux};
  if (!observed.by_level) return observed;
  Scalar part{};
  observed.due = flux_level_comes(config.flux, state.flux, part);
  const std::uint32_t ticks = detail::part_of_ticks(part, period);
  observed.due_ticks = ticks == 0 ? 1 : ticks;
  return observed;
}

/// Like zero_crossing_step(), with the observer's y instead of the terminal's y.
constexpr CrossingReading observed_crossing_step(const ZeroCrossingConfig& config, ZeroCrossingState& state,
                                                 const TerminalSample& s, const Observed& observed, bool on) {
  if (state.sector > 5) return {};
  if (!on || detail::neutral_visible(config, s, floating_leg(state.sector)))
    state.unlike = 0;
  else if (state.unlike < 255)
    ++state.unlike;
  if (state.done) return {Crossing::none, s.at, true, true, observed.y};
  if (observed.blind) {
    state.hidden = true;
    return {Crossing::none, s.at, true, false, observed.y};
  }
  state.freewheels = false;
  CrossingReading reading = detail::look(config, state, s.at, observed.y, false);
  if (reading.crossing == Crossing::seen) reading.at -= observed.lag_ticks;
  return reading;
}

}  // namespace sixstep::control
