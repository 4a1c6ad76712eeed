// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/wiring/wiring_theory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/base/angle.hpp"

namespace sixstep::analysis {
namespace {

constexpr double whole = base::sector_rad, half = base::sector_rad / 2;
constexpr double deg_per_rad = 180 / base::pi;

struct Sums {
  double mean = 0.0, square = 0.0, first_half = 0.0, second_half = 0.0;
};

Sums over_turn(const PairTorque& torque, const WiringTheory& t) {
  Sums s;
  for (std::uint8_t sector = 0; sector < 6; ++sector) {
    const Driven& d = t.driven[sector];
    const PairTorque::Means first = torque.means(sector, 0, half, d.source, d.sink);
    const PairTorque::Means second = torque.means(sector, half, whole, d.source, d.sink);
    s.first_half += first.torque / 6;
    s.second_half += second.torque / 6;
    s.square += (first.square + second.square) / 12;
  }
  s.mean = (s.first_half + s.second_half) / 2;
  return s;
}

/// Electrical angle at which the torque changes its sign, between the middles of two sectors: the first
/// sector drives forward, the second sector drives back.
double rest_between(const PairTorque& torque, const WiringTheory& t, std::uint8_t sector) {
  const std::uint8_t next = static_cast<std::uint8_t>((sector + 1) % 6);
  const auto in = [&](std::uint8_t s, double x) {
    return torque.at(s, x, t.driven[s].source, t.driven[s].sink);
  };
  const auto crossing = [&](std::uint8_t s, double from, double to) {
    for (int n = 0; n < 60; ++n) {
      const double middle = (from + to) / 2;
      (in(s, middle) > 0 ? from : to) = middle;
    }
    return (s * whole + from) * deg_per_rad;
  };
  if (in(sector, whole) < 0) return crossing(sector, half, whole);
  if (in(next, 0) > 0) return crossing(next, 0, half);
  return next * 60.0;
}

/// The behaviour of a rotor that turns. The torque of a pair that is driven too early rises from 0 while the
/// rotor passes a sector; the torque of a pair that is driven too late falls.
WiringDoes running(int direction, double part, double least_part, const Sums& s) {
  const bool forward = direction > 0, falls = direction * (s.first_half - s.second_half) > 0;
  if (part >= well_above_part && least_part >= well_above_least)
    return forward ? WiringDoes::forward : WiringDoes::backward;
  const bool early = falls != forward;  // if the rotor turns backward, it passes a sector's second half first
  if (forward) return early ? WiringDoes::forward_early : WiringDoes::forward_late;
  return early ? WiringDoes::backward_early : WiringDoes::backward_late;
}

}  // namespace

WiringTheory wiring_theory(const PairTorque& torque, const rig::Wiring& wiring) {
  WiringTheory t, straight;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::uint8_t sector = 0; sector < 6; ++sector) {
    t.driven[sector] = driven(wiring, sector);
    straight.driven[sector] = driven({}, sector);
    t.torque_Nm_A[sector] =
        torque.means(sector, 0, whole, t.driven[sector].source, t.driven[sector].sink).torque;
    least = std::min(least, t.torque_Nm_A[sector]);
    most = std::max(most, t.torque_Nm_A[sector]);
  }
  const Sums own = over_turn(torque, t), best = over_turn(torque, straight);
  const bool nothing = std::fabs(own.mean) < 1e-12 * best.mean;  // if terms cancel, only rounding remains
  t.mean_Nm_A = nothing ? 0.0 : own.mean;
  t.part = t.mean_Nm_A / best.mean;
  t.idle_speed_part = (t.mean_Nm_A / own.square) / (best.mean / best.square);
  t.idle_current_part = std::sqrt(std::max(0.0, 1 - own.mean * own.mean / own.square));
  const int direction = least > 0 ? 1 : most < 0 ? -1 : 0;
  if (direction == 0) {
    t.does = WiringDoes::hums;
    for (std::uint8_t sector = 0; sector < 6; ++sector)
      if (t.torque_Nm_A[sector] > 0 && t.torque_Nm_A[(sector + 1) % 6] <= 0)
        t.rests_deg.push_back(rest_between(torque, t, sector));
    for (double& rest : t.rests_deg)
      if (rest >= 360) rest -= 360;
    std::sort(t.rests_deg.begin(), t.rests_deg.end());
    return t;
  }
  t.least_part = std::numeric_limits<double>::infinity();
  for (const TorquePoint& p : torque_over_turn(torque, wiring, 60))
    t.least_part = std::min(t.least_part, direction * p.torque_Nm_A / best.mean);
  t.does = running(direction, std::fabs(t.part), t.least_part, own);
  return t;
}

std::vector<TorquePoint> torque_over_turn(const PairTorque& torque, const rig::Wiring& wiring, int points) {
  std::vector<TorquePoint> curve;
  for (std::uint8_t sector = 0; sector < 6; ++sector) {
    const Driven d = driven(wiring, sector);
    for (int n = 0; n <= points; ++n)
      curve.push_back({60.0 * (sector + static_cast<double>(n) / points),
                       torque.at(sector, whole * n / points, d.source, d.sink)});
  }
  return curve;
}

}  // namespace sixstep::analysis
