// SPDX-License-Identifier: Apache-2.0
// The interface between controller and chip. The controller reads a Measurement and a Setpoint and returns a
// BridgeCommand. The simulated board and a real board use the same plain structs.
#pragma once
#include <cstdint>

namespace sixstep::control {

/// Control modes. The mode defines the meaning and the unit of the setpoint.
enum class Mode : std::uint8_t { off, duty, current, speed, position };

/// State of the switches in the off part of a PWM period (model.md 3).
enum class Chopping : std::uint8_t { soft, hard, complementary };

/// The switch of the pair that the duty chops while the other switch stays on. Hard chopping chops both.
enum class ChoppedSwitch : std::uint8_t { upper, lower };

/// A leg of the bridge, named after the phase that it feeds.
enum class Leg : std::uint8_t { a = 0, b = 1, c = 2 };

/// The driven pair: the current leaves the bridge through `source`'s upper switch and returns through
/// `sink`'s lower switch.
struct Pair {
  Leg source = Leg::a;
  Leg sink = Leg::b;
  bool operator==(const Pair&) const = default;
};

/// The leg that is not in the pair.
constexpr Leg free_leg(Pair pair) {
  return static_cast<Leg>(3 - static_cast<int>(pair.source) - static_cast<int>(pair.sink));
}

/// Measurements at the sample instant. Currents are positive into the motor, in A.
template <class Scalar>
struct Measurement {
  Scalar i_a_A{}, i_b_A{}, i_c_A{};
  Scalar speed_rad_s{};   ///< mechanical
  Scalar position_deg{};  ///< mechanical; does not wrap after a full turn
  Scalar bus_V{};
  std::uint8_t hall = 0;  ///< H1 H2 H3 as bits 2, 1, 0
};

/// Setpoint in the unit of the mode: duty 1 (-1 to 1, with the sign of the voltage), current A, speed rad/s,
/// position degrees (mechanical).
template <class Scalar>
struct Setpoint {
  Scalar value{};
};

/// Current that the board's event comparators use, if a controller arms them (event hysteresis).
enum class Watch : std::uint8_t {
  none,   ///< comparators not armed: the duty sets the gates
  motor,  ///< one comparator on (i_source - i_sink)/2
  phase   ///< two comparators: +i_source for the upper switch, -i_sink for the lower (hard chopping only)
};

template <class Scalar>
struct BridgeCommand {
  bool enabled = false;  ///< false: all six gates off
  Pair pair{};           ///< source and sink are already exchanged for a negative command
  Scalar duty{};         ///< 0..1, on-time divided by PWM period; ignored while comparators are armed
  Chopping chopping = Chopping::soft;
  ChoppedSwitch chopped = ChoppedSwitch::upper;
  Watch watch = Watch::none;
  /// Duty, -1..1, of the leaving leg. This leg has left the pair, but its current still decays. Above 0: its
  /// upper switch is chopped; below 0: its lower switch.
  Scalar overlap{};
  Scalar on_below_A{};   ///< a comparator switches on if its current is below this value
  Scalar off_above_A{};  ///< a comparator switches off if its current is above this value
  bool fault = false;    ///< true: the Hall code was invalid, and the bridge is off

  bool operator==(const BridgeCommand&) const = default;
};

}  // namespace sixstep::control
