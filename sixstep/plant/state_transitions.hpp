// SPDX-License-Identifier: Apache-2.0
// Changes of a state at an instant, shared by both kernels: setting the rotor's angle, passing the edge of a
// sector or of a piece of the back-EMF, balancing the currents after one has become zero, and the noise
// scales.
#pragma once
#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/plant/expansion.hpp"
#include "sixstep/plant/guards.hpp"

namespace sixstep::plant::detail {

/// Call it after a current was set to zero. A single remaining current is then zero too; of two remaining
/// currents the second is minus the first.
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
/// pieces(sector) gives a sector's pieces in order of x, count(sector) their number.
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

/// A rotor at rest on an edge would pass it endlessly at one instant if the bridge drives the rotor back from
/// either side. clear_edge() moves the rotor inside the piece by the possible rounding error, so that time
/// proceeds.
template <class Real>
void clear_edge(State<Real>& state, bool ahead) {
  const Real inside = 4 * noise_of(Real(base::sector_rad), Real(1));  // more than the noise of edge_guards()
  state.x += ahead ? inside : -inside;
}

/// Sets the rotor to an electrical angle; returns true if that angle is the edge of a sector. The tolerance
/// covers four roundings, because the angle may have been converted from degrees or radians of the shaft.
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

/// Sets the scales that distinguish rounding noise from a signal, in the constants of either kernel.
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
