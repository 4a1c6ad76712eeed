// SPDX-License-Identifier: Apache-2.0
// What a motor does that is plugged in in one of the 36 ways, in closed form: no run has a part in it.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sixstep/analysis/wiring/driven.hpp"
#include "sixstep/analysis/wiring/pair_torque.hpp"

namespace sixstep::analysis {

/// What a person at the bench sees. "Early" and "late" drive each pair 60 degrees, a sector, before or behind its turn.
enum class WiringDoes : std::uint8_t {
  forward,
  forward_early,
  forward_late,
  backward,
  backward_early,
  backward_late,
  hums,    ///< stands or swings about an angle, with the current of a stalled motor
  unclear  ///< of a measurement alone: it does not do the same from every start
};
inline constexpr std::size_t kinds_of_wiring = 7;  ///< without `unclear`

/// +1 forward, -1 backward, 0 for what does not run.
constexpr int direction_of(WiringDoes does) {
  if (does >= WiringDoes::hums) return 0;
  return does < WiringDoes::backward ? 1 : -1;
}
/// Runs with its whole torque.
constexpr bool runs_well(WiringDoes does) {
  return does == WiringDoes::forward || does == WiringDoes::backward;
}

/// Between the half of straight wires' torque that a shift by a sector leaves and all of it. Reluctance may add to that half; at one
/// end of each sector it is nothing all the same.
inline constexpr double well_above_part = 0.75, well_above_least = 0.2;

/// Each torque is per ampere through the driven pair.
struct WiringTheory {
  WiringDoes does = WiringDoes::hums;
  std::array<Driven, 6> driven{};       ///< by the rotor's sectors
  std::array<double, 6> torque_Nm_A{};  ///< mean over each of them
  double mean_Nm_A = 0.0;               ///< over the turn
  double part = 0.0;                    ///< of the mean of straight wires
  double least_part = 0.0;              ///< least torque its way at any angle, of the same; 0 where it hums
  /// Without inductance, friction and gaps in the current, at one duty: the speed at which the mean torque is nothing, of that
  /// of straight wires, and the rms of the pair's current there, of the stalled one. From dU - w g = R i and mean(g i) = 0:
  /// w = dU mean(g)/mean(g^2), i_rms^2 = (dU/R)^2 (1 - mean(g)^2/mean(g^2)).
  double idle_speed_part = 0.0, idle_current_part = 0.0;
  std::vector<double>
      rests_deg;  ///< electrical angles to which the torque drives from both sides, where it hums
};

/// A torque that has one sign in every sector turns the rotor that way; one that has both holds it.
WiringTheory wiring_theory(const PairTorque& torque, const rig::Wiring& wiring);

/// The torque over an electrical turn, N m/A: both sides of each sector's edge.
struct TorquePoint {
  double electrical_deg = 0.0, torque_Nm_A = 0.0;
};
std::vector<TorquePoint> torque_over_turn(const PairTorque& torque, const rig::Wiring& wiring,
                                          int points_a_sector);

}  // namespace sixstep::analysis
