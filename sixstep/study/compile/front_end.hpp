// SPDX-License-Identifier: Apache-2.0
// The board's analogue front end, from a scenario's [sensors].
#pragma once
#include "sixstep/base/angle.hpp"
#include "sixstep/rig/front_end_config.hpp"
#include "sixstep/sim/instant.hpp"
#include "sixstep/study/scenario/sensors.hpp"

namespace sixstep::study {

/// Time constant in s of a corner frequency; 0 if no frequency is given.
inline double lag_s(const std::optional<double>& bandwidth_Hz) {
  return bandwidth_Hz ? 1 / (2 * base::pi * *bandwidth_Hz) : 0.0;
}

/// One value for each of terminals a, b, c; zeros if none are given.
inline plant::PerLeg<double> per_terminal(const std::vector<double>& given) {
  plant::PerLeg<double> out{};
  for (std::size_t k = 0; k < out.size() && k < given.size(); ++k) out[k] = given[k];
  return out;
}

/// An ideal measurement has no amplifier and no divider. Terminals that the drive measures have dividers like
/// the divider of the bus, even if the bus itself is not measured. Comparators exist only if the drive
/// commutates by them.
inline rig::FrontEndConfig front_end_of(const Sensors& s, bool looks_at_terminals, bool follows_comparators) {
  rig::FrontEndConfig to;
  if (s.currents != rig::CurrentMeasurement::ideal) {
    to.amplifier_s = lag_s(s.current_bandwidth_Hz);
    to.amplifier_delay_ticks = sim::to_instant(s.current_delay_s).ticks;
  }
  if (s.currents == rig::CurrentMeasurement::low_side) to.shunts = static_cast<std::uint8_t>(s.shunts);
  if (s.bus == BusSensing::adc || looks_at_terminals) to.divider_s = lag_s(s.bus_bandwidth_Hz);
  to.divider_gain_error = per_terminal(s.terminal_gain_error);
  if (looks_at_terminals && follows_comparators)
    to.comparators = {lag_s(s.comparators.bandwidth_Hz), s.comparators.against,
                      per_terminal(s.comparators.offset_V), s.comparators.hysteresis_V};
  return to;
}

}  // namespace sixstep::study
