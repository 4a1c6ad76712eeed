// SPDX-License-Identifier: Apache-2.0
// What the board's analogue front end is made of, and what leaves it (front_end.hpp).
#pragma once
#include <cstdint>

#include "sixstep/plant/circuit.hpp"

namespace sixstep::rig {

/// What comparators hold the filtered terminals against: the mean of all three, which three equal resistors make, or half the
/// bus, filtered like them.
enum class CrossingReference : std::uint8_t { virtual_star, half_bus };

/// Comparators at the terminals, behind low-passes of their own, for a firmware that captures their edges.
struct CrossingComparators {
  double lag_s = 0.0;  ///< of each low-pass; 0: there are no comparators
  CrossingReference against = CrossingReference::virtual_star;
  plant::PerLeg<double> offset_V{};  ///< of each; seen at the terminal
  double hysteresis_V = 0.0;         ///< between the levels of a rising and a falling edge, likewise
};

/// Time constants of first-order lags; 0: none.
struct FrontEndConfig {
  double amplifier_s = 0.0;                ///< of each current's amplifier, 1/(2 pi bandwidth)
  std::int64_t amplifier_delay_ticks = 0;  ///< ps; less than from one sample to the next
  double divider_s = 0.0;  ///< of the bus's divider, and of the terminals' for a firmware that looks at them
  plant::PerLeg<double>
      divider_gain_error{};  ///< how much too large each terminal's divider shows it, a part
  CrossingComparators comparators{};

  bool lags_currents() const { return amplifier_s > 0 || amplifier_delay_ticks > 0; }
  bool lags_voltages() const { return divider_s > 0; }
  bool has_comparators() const { return comparators.lag_s > 0; }
};

/// What the converters' inputs stand at, by legs.
struct FrontEndReading {
  plant::PerLeg<double> i_A{}, terminal_V{};
  double dc_link_A = 0.0, bus_V = 0.0;
  plant::PerLeg<double> comparator_V{};  ///< at the comparators, where there are any
  double comparator_bus_V = 0.0;
  bool currents = false, voltages = false;  ///< which of them lag; what does not is as it is
};

}  // namespace sixstep::rig
