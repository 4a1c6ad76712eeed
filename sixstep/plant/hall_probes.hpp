// SPDX-License-Identifier: Apache-2.0
// Hall probes with their mounting errors (model.md 10). Edge n, between sectors n - 1 and n, lies at
//
//   60 deg n + offset + own[n mod N],   N = 6 (one electrical turn), or 6 p (one turn, if the magnets differ)
//
// and appears h/2 later in the direction of motion, with the hysteresis h. own[] are the errors of single
// edges, p the pole pairs. At the start of a run the shown sector is determined without hysteresis.
#pragma once
#include <cstdint>
#include <vector>

#include "sixstep/base/angle.hpp"
#include "sixstep/plant/guards.hpp"

namespace sixstep::plant {

/// Placement of the edges, electrical degrees. Neighbouring edges including their hysteresis must not
/// overlap.
struct HallPlacement {
  double offset_deg = 0.0;        ///< offset of all edges
  double hysteresis_deg = 0.0;    ///< distance between an edge's positions in the two directions
  std::vector<double> own_deg{};  ///< additional offset of each edge, beginning with the edge at 0 degrees;
                                  ///< 0, 6 or 6 p values

  bool as_sectors() const { return offset_deg == 0.0 && hysteresis_deg == 0.0 && own_deg.empty(); }
};

/// Guards of the probes: the next edge ahead and the next edge behind.
enum class ProbeEdge : std::uint8_t { ahead, behind };

template <class Real>
class HallProbes {
 public:
  HallProbes(const HallPlacement& placement, const State<Real>& at)
      : half_(rad(placement.hysteresis_deg) / 2) {
    for (const double own : placement.own_deg) edge_.push_back(rad(placement.offset_deg + own));
    if (edge_.empty()) edge_.push_back(rad(placement.offset_deg));
    // Least hysteresis: a rotor that reverses on an edge must exceed the rounding error with which the edge
    // was located.
    const Real least = 4 * noise_of(Real(base::sector_rad), Real(1));
    if (half_ < least) half_ = least;
    shown_ = at.sector;
    while (edge(shown_, at.sector) > at.x) --shown_;
    while (edge(shown_ + 1, at.sector) <= at.x) ++shown_;
  }

  /// Sector that the probes show, counted over all turns like State::sector.
  std::int64_t shown() const { return shown_; }

  /// Calls visit(ProbeEdge, series, degree, noise) for the edge ahead and the edge behind. The series falls
  /// through zero when the edge appears. `sector` is the rotor's sector.
  template <class Visit>
  void guards(const Expansion<Real>& y, std::int64_t sector, Visit&& visit) const {
    const Real noise = noise_of(Real(base::sector_rad), Real(1));
    const Real ahead = edge(shown_ + 1, sector) + half_, behind = edge(shown_, sector) - half_;
    if (!series::stays_above(ahead - y.x[0], -y.x[1], y.later_x, noise))
      visit(ProbeEdge::ahead, detail::affine(y.x, y.degree, Real(-1), ahead), y.degree, noise);
    if (!series::stays_above(y.x[0] - behind, y.x[1], y.later_x, noise))
      visit(ProbeEdge::behind, detail::affine(y.x, y.degree, Real(1), -behind), y.degree, noise);
  }
  void pass(ProbeEdge which) { shown_ += which == ProbeEdge::ahead ? 1 : -1; }

 private:
  static Real rad(double deg) { return Real(deg) * Real(base::pi) / 180; }
  /// Angle of edge n from the start of `sector`.
  Real edge(std::int64_t n, std::int64_t sector) const {
    const auto edges = static_cast<std::int64_t>(edge_.size());
    const auto which = static_cast<std::size_t>((n % edges + edges) % edges);
    return static_cast<Real>(n - sector) * Real(base::sector_rad) + edge_[which];
  }

  std::vector<Real> edge_;  ///< position of edge n minus 60 deg n
  Real half_;
  std::int64_t shown_ = 0;
};

}  // namespace sixstep::plant
