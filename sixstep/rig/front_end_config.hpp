// SPDX-License-Identifier: Apache-2.0
// What the board's analogue front end is made of, and what leaves it (front_end.hpp).
#pragma once
#include <cstdint>

#include "sixstep/plant/circuit.hpp"

namespace sixstep::rig {

/// What comparators hold the filtered terminals against: the mean of all three, which three equal resistors make, or half the
/// filtered bus.
enum class CrossingReference : std::uint8_t { virtual_star, half_bus };

/// Comparators at the terminals' dividers, for a firmware that captures their edges; dividers then lag (divider_s > 0).
struct CrossingComparators {
  bool fitted = false;
  CrossingReference against = CrossingReference::virtual_star;
  plant::PerLeg<double> offset_V{};  ///< of each; seen at the terminal
  double hysteresis_V = 0.0;         ///< between the levels of a rising and a falling edge, likewise
};

/// Time constants of first-order lags; 0: none.
struct FrontEndConfig {
  double amplifier_s = 0.0;                ///< of each current's amplifier, 1/(2 pi bandwidth)
  std::int64_t amplifier_delay_ticks = 0;  ///< ps; less than from one sample to the next
  double divider_s = 0.0;  ///< of the bus's divider, and of the terminals' for a firmware that looks at them
  CrossingComparators comparators{};

  bool lags_currents() const { return amplifier_s > 0 || amplifier_delay_ticks > 0; }
  bool lags_voltages() const { return divider_s > 0; }
};

/// What the converters' inputs stand at, by legs.
struct FrontEndReading {
  plant::PerLeg<double> i_A{}, terminal_V{};
  double dc_link_A = 0.0, bus_V = 0.0;
  bool currents = false, voltages = false;  ///< which of them lag; what does not is as it is
};

}  // namespace sixstep::rig
