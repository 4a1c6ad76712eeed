// SPDX-License-Identifier: Apache-2.0
// Predicts in closed form, without a run, the motor's behaviour in each of the 36 wirings.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sixstep/analysis/wiring/driven.hpp"
#include "sixstep/analysis/wiring/pair_torque.hpp"

namespace sixstep::analysis {

/// Behaviour that a person observes at the bench. "Early" and "late": each pair is driven 60 degrees (a
/// sector) before or after its own sector.
enum class WiringDoes : std::uint8_t {
  forward,
  forward_early,
  forward_late,
  backward,
  backward_early,
  backward_late,
  hums,    ///< at rest or oscillating about an angle, with the current of a stalled motor
  unclear  ///< measurements only: the behaviour depends on the start
};
inline constexpr std::size_t kinds_of_wiring = 7;  ///< without `unclear`

/// Direction of rotation: +1 forward, -1 backward, 0 for hums and unclear.
constexpr int direction_of(WiringDoes does) {
  if (does >= WiringDoes::hums) return 0;
  return does < WiringDoes::backward ? 1 : -1;
}
/// True if the motor runs with its whole torque.
constexpr bool runs_well(WiringDoes does) {
  return does == WiringDoes::forward || does == WiringDoes::backward;
}

/// Lower bounds for a wiring that runs well, as fractions of straight wiring's mean torque: for its mean
/// torque, and for its least torque. A shift by one sector halves the mean. Reluctance torque can raise the
/// halved mean, but the torque still falls to 0 at one end of each sector.
inline constexpr double well_above_part = 0.75, well_above_least = 0.2;

/// Result of the theory for one wiring. Each torque is per ampere through the driven pair.
struct WiringTheory {
  WiringDoes does = WiringDoes::hums;
  std::array<Driven, 6> driven{};       ///< pair in each of the rotor's sectors
  std::array<double, 6> torque_Nm_A{};  ///< mean over each sector
  double mean_Nm_A = 0.0;               ///< mean over the turn
  double part = 0.0;                    ///< mean, divided by the mean of straight wires
  double least_part = 0.0;  ///< least torque in the direction of rotation at any angle, divided by the mean
                            ///< of straight wires; 0 if the motor hums
  /// Speed and current without load at one duty, without inductance and friction and with continuous current.
  /// The speed has mean torque 0 and is divided by the no-load speed of straight wires. The current is the
  /// rms of the pair's current at this speed, divided by the stall current. g is the torque per ampere, d U
  /// the mean voltage, R the pair's resistance, w the speed. From d U - w g = R i and mean(g i) = 0:
  ///   w = d U mean(g)/mean(g^2), i_rms^2 = (d U/R)^2 (1 - mean(g)^2/mean(g^2)).
  double idle_speed_part = 0.0, idle_current_part = 0.0;
  /// If the motor hums: electrical angles towards which the torque drives from both sides.
  std::vector<double> rests_deg;
};

/// The behaviour of a wiring. A torque with the same sign in all sectors turns the rotor in its direction; a
/// torque with both signs stops the rotor at an angle.
WiringTheory wiring_theory(const PairTorque& torque, const rig::Wiring& wiring);

/// The torque over an electrical turn, N m/A. At a sector's edge there are two points, one for each side.
struct TorquePoint {
  double electrical_deg = 0.0, torque_Nm_A = 0.0;
};
std::vector<TorquePoint> torque_over_turn(const PairTorque& torque, const rig::Wiring& wiring,
                                          int points_a_sector);

}  // namespace sixstep::analysis
