// SPDX-License-Identifier: Apache-2.0
// How the general plant settles, advances and takes its events: part of general/plant.hpp.
#pragma once
#include "sixstep/plant/general/plant.hpp"

namespace sixstep::plant::general {

template <class Real>
double Plant<Real>::expand(double wanted) {
  const Real length = useful_length(constants_, state_, static_cast<Real>(wanted));
  bool expanded = false;
  if (stale_ && !resettle(length, expanded)) return -1.0;
  if (!expanded) general::expand(constants_, state_, more_, mode_, length, y_, z_);
  return static_cast<double>(y_.h);
}

template <class Real>
bool Plant<Real>::resettle(Real wanted, bool& expanded) {
  slack_ = 1;
  const Legs before = mode_.legs;
  for (unsigned k = 0; k < 3; ++k)
    if ((breaking_ >> k & 1) != 0 && plant::detail::abs(state_.i[k]) <= constants_.amp_noise) {
      state_.i[k] = state_.i_low[k] = 0;
      dead_ |= 1U << k;
      breaking_ &= ~(1U << k);
      balance();
    }
  const Question<Real> question{constants_, state_, more_,    gates_, dead_,
                                breaking_,  wanted, doubted_, slack_};
  if ((doubted_ || !settle_plainly(question, mode_, y_, z_)) && !settle_fully(wanted, expanded)) return false;
  stale_ = false;
  for (unsigned k = 0; k < 3; ++k)
    if (is_floating(before[k]) && is_diode(mode_.legs[k])) ++diodes_started_;
  return true;
}

template <class Real>
bool Plant<Real>::settle_fully(Real wanted, bool& expanded) {
  snap();
  for (; slack_ < 1e5; slack_ *= 16) {
    const Question<Real> question{constants_, state_, more_,    gates_, dead_,
                                  breaking_,  wanted, doubted_, slack_};
    if (settle(question, mode_, y_, z_, expanded)) return true;
  }
  return false;
}

/// Currents within rounding of zero in legs that carry one direction only, and a speed within rounding of rest where friction
/// may hold the rotor, are zero.
template <class Real>
void Plant<Real>::snap() {
  const Constants<Real>& c = constants_;
  for (bool snapped = true; snapped;) {
    snapped = false;
    for (unsigned k = 0; k < 3; ++k) {
      Real& i = state_.i[k];
      const bool gated = !c.devices.igbt && (gates_.high[k] || gates_.low[k]) && (dead_ >> k & 1) == 0;
      if (gated || i == 0 || plant::detail::abs(i) > c.amp_noise) continue;
      i = state_.i_low[k] = 0;
      snapped = true;
    }
    if (snapped) balance();
  }
  if (c.dry_friction && plant::detail::abs(state_.w) <= c.speed_noise) state_.w = state_.w_low = 0;
  if (!c.source_sinks && more_.source <= c.amp_noise) more_.source = more_.source_low = 0;
}

/// After a current was set to zero: one left alone is zero too, two left are one current.
template <class Real>
void Plant<Real>::balance() {
  PerLeg<Real>& i = state_.i;
  const int zeros = int{i[0] == 0} + int{i[1] == 0} + int{i[2] == 0};
  if (zeros == 2) i = state_.i_low = {};
  if (zeros != 1) return;
  const int zero = i[0] == 0 ? 0 : i[1] == 0 ? 1 : 2;
  const int j = (zero + 1) % 3, k = (zero + 2) % 3;
  i[k] = -i[j];
  state_.i_low[k] = -state_.i_low[j];
}

template <class Real>
void Plant<Real>::advance(Real s) {
  using series::add_compensated;
  const auto by = [&](const series::Coefficients<Real>& of) { return series::increment(of, y_.degree, s); };
  State<Real>& q = state_;
  std::array<int, 3> leg{};
  int connected = 0;
  for (int k = 0; k < 3; ++k)
    if (!is_floating(mode_.legs[k])) leg[connected++] = k;
  if (connected >= 2) {
    const int last = leg[connected - 1];
    q.i[last] = q.i_low[last] = 0;
    for (int n = 0; n + 1 < connected; ++n) {
      add_compensated(q.i[leg[n]], q.i_low[leg[n]], by(y_.i[leg[n]]));
      q.i[last] -= q.i[leg[n]];
      q.i_low[last] -= q.i_low[leg[n]];
    }
  }
  if (turns(mode_.motion)) {
    add_compensated(q.w, q.w_low, by(y_.w));
    add_compensated(q.x, q.x_low, by(y_.x));
  }
  if (constants_.inv_C > 0) add_compensated(q.bus, q.bus_low, by(y_.bus));
  if (constants_.inv_L_b > 0) add_compensated(more_.source, more_.source_low, by(z_.source));
  if (constants_.has_loop) add_compensated(more_.loop, more_.loop_low, by(z_.loop));
  if (constants_.elastic) {
    add_compensated(more_.load_w, more_.load_w_low, by(z_.load_w));
    add_compensated(more_.twist, more_.twist_low, by(z_.twist));
  }
  doubted_ = s == 0;
}

template <class Real>
bool Plant<Real>::pass_edge(bool ahead) {
  const auto pieces = [this] { return constants_.shape.sector[mode_.sector].size(); };
  const bool leaves = ahead ? mode_.piece + 1u == pieces() : mode_.piece == 0;
  if (leaves) {
    state_.sector += ahead ? 1 : -1;
    mode_.sector = static_cast<std::uint8_t>(sector_in_turn(state_.sector));
    mode_.piece = static_cast<std::uint8_t>(ahead ? 0 : pieces() - 1);
  } else {
    mode_.piece = static_cast<std::uint8_t>(mode_.piece + (ahead ? 1 : -1));
  }
  state_.x = ahead ? piece().from : piece().to;
  state_.x_low = 0;
  return leaves;
}

/// plant/plant_events.hpp says why.
template <class Real>
void Plant<Real>::leave_edge(bool ahead) {
  const Real inside = 4 * noise_of(Real(base::sector_rad), Real(1));
  state_.x += ahead ? inside : -inside;
}

template <class Real>
bool Plant<Real>::apply(int id) {
  const int before = std::exchange(last_event_, id);
  if (id == guard::edge_ahead || id == guard::edge_behind) {
    const bool ahead = id == guard::edge_ahead, leaves = pass_edge(ahead);
    if (doubted_ && before == (ahead ? guard::edge_behind : guard::edge_ahead)) leave_edge(ahead);
    return leaves;
  }
  if (id < guard::standstill) {
    state_.i[id] = state_.i_low[id] = 0;
    if (connected_count(mode_.legs) == 2) state_.i = state_.i_low = {};
    balance();
  }
  if (id == guard::standstill) state_.w = state_.w_low = 0;
  if (id == guard::source && constants_.inv_L_b > 0 && mode_.source_feeds)
    more_.source = more_.source_low = 0;
  if (id == guard::brake) mode_.braking = !mode_.braking;
  if (id == guard::load_turns) mode_.load_sign = static_cast<std::int8_t>(-mode_.load_sign);
  stale_ = true;
  return false;
}

template <class Real>
Snapshot<Real> Plant<Real>::at(Real s) const {
  const auto value = [&](const series::Coefficients<Real>& of) { return series::evaluate(of, y_.degree, s); };
  Snapshot<Real> now;
  for (int k = 0; k < 3; ++k) now.i[k] = value(y_.i[k]);
  now.speed = value(y_.w);
  now.bus = value(y_.bus);
  const Real x = value(y_.x);
  PerLeg<Real> shape{};
  for (int k = 0; k < 3; ++k) shape[k] = piece().now[k] + piece().rise[k] * x;
  for (std::size_t r = 0; r < constants_.rotations; ++r) {
    const Rotation<Real>& part = constants_.shape.rotations[r];
    const Real cos = value(z_.cos[r]), sin = value(z_.sin[r]);
    for (int k = 0; k < 3; ++k) shape[k] += part.cos[k] * cos + part.sin[k] * sin;
  }
  for (int k = 0; k < 3; ++k) now.emf[k] = now.speed * shape[k];
  now.torque = value(y_.torque);
  now.angle = (static_cast<Real>(state_.sector) * Real(base::sector_rad) + x) / constants_.pole_pairs;
  for (int k = 0; k < 3; ++k)
    now.pole[k] =
        is_floating(mode_.legs[k])
            ? value(z_.pole[k])
            : pole_voltage(constants_.poles[static_cast<std::size_t>(mode_.legs[k])], now.bus, now.i[k]);
  if (connected_count(mode_.legs) == 0) {
    const Real highest = std::max({now.pole[0], now.pole[1], now.pole[2]});
    const Real lowest = std::min({now.pole[0], now.pole[1], now.pole[2]});
    for (Real& u : now.pole) u += (now.bus - highest - lowest) / 2;
  }
  now.bus_current = bus_current(mode_.legs, now.i);
  return now;
}

}  // namespace sixstep::plant::general
