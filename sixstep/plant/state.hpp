// SPDX-License-Identifier: Apache-2.0
// State of the plant: continuous states, each with the rounding error of its running sum, and the discrete
// mode.
#pragma once
#include <bitset>
#include <cstdint>

#include "sixstep/plant/circuit.hpp"

namespace sixstep::plant {

/// Gates of the upper and lower switch of each leg: T1/T2 for a, T3/T4 for b, T5/T6 for c.
struct Gates {
  std::bitset<3> high, low;
  bool operator==(const Gates&) const = default;
};

inline bool shoots_through(const Gates& g) { return (g.high & g.low).any(); }

/// Motion of the rotor. `free`: without dry friction, so that the speed passes zero without an event.
enum class Motion : std::uint8_t { free, forward, backward, stuck, locked };

constexpr bool turns(Motion motion) { return motion != Motion::locked && motion != Motion::stuck; }

/// v for a forward rotation, -v for a backward rotation, else 0 (no dry friction, or at rest).
template <class Real>
constexpr Real against(Motion motion, Real v) {
  // mutant: -v => v
  return motion == Motion::forward ? v : motion == Motion::backward ? -v : Real(0);
}

/// Motion of a rotor with dry friction that is not at rest.
template <class Real>
constexpr Motion motion_at(Real speed) {
  return speed > 0 ? Motion::forward : Motion::backward;
}

template <class Real>
struct State {
  PerLeg<Real> i{}, i_low{};  ///< phase currents, A; members `*_low` are the rounding errors of the sums
  Real w = 0, w_low = 0;      ///< mechanical speed, rad/s
  std::int64_t sector = 0;    ///< electrical sectors since theta_e = 0, over all turns
  Real x = 0, x_low = 0;      ///< electrical angle since the sector's start, rad
  Real bus = 0, bus_low = 0;  ///< U_s, V
};

struct Mode {
  Legs legs{};
  Motion motion = Motion::free;
  bool source_feeds = true;  ///< false while the bus voltage is above that of a source that cannot sink
  std::uint8_t sector = 0;   ///< 0..5 within the electrical turn
  std::uint8_t piece = 0;    ///< piece of the back-EMF within the sector
  bool operator==(const Mode&) const = default;
};

/// Sector 0..5 within the electrical turn.
constexpr int sector_in_turn(std::int64_t sector) {
  const auto r = static_cast<int>(sector % 6);
  return r < 0 ? r + 6 : r;
}

}  // namespace sixstep::plant
