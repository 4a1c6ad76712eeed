// SPDX-License-Identifier: Apache-2.0
// Configuration and outputs of the board's analogue front end (front_end.hpp).
#pragma once
#include <cstdint>

#include "sixstep/plant/circuit.hpp"

namespace sixstep::rig {

/// Reference of the comparators. virtual_star: mean of the three filtered terminal voltages, as from three
/// equal resistors. half_bus: half the bus voltage, filtered with the same time constant.
enum class CrossingReference : std::uint8_t { virtual_star, half_bus };

/// Comparators at the terminals, each with a low-pass, for a firmware that captures the comparators' edges.
struct CrossingComparators {
  double lag_s = 0.0;  ///< time constant of each low-pass; 0: no comparators
  CrossingReference against = CrossingReference::virtual_star;
  plant::PerLeg<double> offset_V{};  ///< offset of each comparator, referred to the terminal
  double hysteresis_V =
      0.0;  ///< difference between the levels of a rising and a falling edge, at the terminal
};

/// Time constants of first-order lags, s; 0: no lag.
struct FrontEndConfig {
  double amplifier_s = 0.0;                ///< lag of each current amplifier, 1/(2 pi bandwidth)
  std::int64_t amplifier_delay_ticks = 0;  ///< ps; must be shorter than the time between two samples
  std::uint8_t shunts =
      0;                   ///< legs with a low-side shunt, as bits; 0: the amplifiers show the phase currents
  double divider_s = 0.0;  ///< lag of the bus divider, and of terminals that a firmware samples
  plant::PerLeg<double> divider_gain_error{};  ///< relative gain error of each terminal's divider
  CrossingComparators comparators{};

  bool lags_currents() const { return amplifier_s > 0 || amplifier_delay_ticks > 0; }
  bool lags_voltages() const { return divider_s > 0; }
  bool has_comparators() const { return comparators.lag_s > 0; }
};

/// Values at the converters' inputs, ordered by legs.
struct FrontEndReading {
  plant::PerLeg<double> i_A{}, terminal_V{};
  double dc_link_A = 0.0, bus_V = 0.0;
  plant::PerLeg<double> comparator_V{};  ///< voltages at the comparators, if there are any
  double comparator_bus_V = 0.0;
  bool currents = false, voltages = false;  ///< true: use the filtered values of this struct; false: use the
                                            ///< plant's values
};

}  // namespace sixstep::rig
