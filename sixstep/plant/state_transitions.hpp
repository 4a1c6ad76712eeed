// SPDX-License-Identifier: Apache-2.0
// Functions of both kernels that change a state at an instant. They set the rotor's angle, pass an edge of a
// sector or piece of the back-EMF, balance the currents, and set the noise scales.
#pragma once
#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/plant/expansion.hpp"
#include "sixstep/plant/guards.hpp"

namespace sixstep::plant::detail {

/// Makes the sum of the currents zero after a current was set to zero. If one current remains, it becomes
/// zero too. If two remain, the second becomes minus the first.
template <class Real>
void balance(State<Real>& state) {
  PerLeg<Real>& i = state.i;
  const int zeros = int{i[0] == 0} + int{i[1] == 0} + int{i[2] == 0};
  if (zeros == 2) {
    i = {};
    state.i_low = {};
  } else if (zeros == 1) {
    const int zero = i[0] == 0 ? 0 : i[1] == 0 ? 1 : 2;
    const int j = (zero + 1) % 3, k = (zero + 2) % 3;
    i[k] = -i[j];
    // mutant: -state.i_low[j] => Real(0)
    state.i_low[k] = -state.i_low[j];
  }
}

/// Moves the rotor across the edge of its piece of the back-EMF; returns true if it leaves its sector.
/// pieces(sector) returns a sector's pieces in order of x, count(sector) their number.
template <class Real, class Mode, class Pieces, class Count>
bool pass_edge(State<Real>& state, Mode& mode, bool ahead, Pieces&& pieces, Count&& count) {
  const int before = static_cast<int>(count(mode.sector));
  const bool leaves = ahead ? mode.piece + 1 == before : mode.piece == 0;
  using Index = decltype(mode.piece);
  if (leaves) {
    state.sector += ahead ? 1 : -1;
    mode.sector = static_cast<std::uint8_t>(sector_in_turn(state.sector));
    mode.piece = static_cast<Index>(ahead ? 0 : static_cast<int>(count(mode.sector)) - 1);
  } else {
    mode.piece = static_cast<Index>(mode.piece + (ahead ? 1 : -1));
  }
  const auto& piece = pieces(mode.sector)[mode.piece];
  // mutant: piece.from => Real(0)
  state.x = ahead ? piece.from : piece.to;
  // mutant: state.x_low = 0; => nothing
  state.x_low = 0;
  return leaves;
}

/// If the bridge drives a rotor back from both sides of an edge, the rotor would pass this edge endlessly at
/// one instant. clear_edge() moves the rotor away from the edge by the possible rounding error, so that time
/// proceeds.
template <class Real>
void clear_edge(State<Real>& state, bool ahead) {
  const Real inside = 4 * noise_of(Real(base::sector_rad), Real(1));  // more than the noise of edge_guards()
  state.x += ahead ? inside : -inside;
}

/// Sets the rotor to an electrical angle. Returns true if this angle is the edge of a sector. The tolerance
/// covers four rounding errors, because the angle may have been converted from degrees or radians of the
/// shaft.
template <class Real>
bool set_rotor_angle(State<Real>& state, double electrical_rad) {
  const double edge = std::floor(electrical_rad / base::sector_rad + 0.5);
  const bool on_edge =
      std::fabs(electrical_rad - edge * base::sector_rad) <= 0x1p-50 * std::fabs(electrical_rad);
  const double sector = on_edge ? edge : std::floor(electrical_rad / base::sector_rad);
  state.sector = static_cast<std::int64_t>(sector);
  state.x =
      on_edge ? Real(0) : std::max(Real(0), Real(electrical_rad) - Real(sector) * Real(base::sector_rad));
  return on_edge;
}

/// Sets the scales that distinguish rounding noise from a signal, in the constants of a kernel.
template <class Real, class Constants>
void set_scales(Constants& c, Real volt_scale, Real R, Real K_e) {
  c.volt_scale = volt_scale;
  c.amp_scale = c.volt_scale / R;
  c.speed_scale = c.volt_scale / (2 * K_e);
  c.torque_scale = 2 * K_e * c.amp_scale;
  c.volt_noise = noise_of(c.volt_scale, Real(1));
  c.amp_noise = noise_of(c.amp_scale, Real(1));
  c.speed_noise = noise_of(c.speed_scale, Real(1));
  c.torque_noise = noise_of(c.torque_scale, Real(1));
}

}  // namespace sixstep::plant::detail
