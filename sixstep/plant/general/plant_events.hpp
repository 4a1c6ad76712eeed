// SPDX-License-Identifier: Apache-2.0
// Member functions of general/plant.hpp that settle and advance the plant and apply its events.
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
      plant::detail::balance(state_);
    }
  const Question<Real> question{constants_, state_, more_,    gates_, dead_,
                                breaking_,  wanted, doubted_, slack_};
  if ((doubted_ || !settle_fast(question, mode_, y_, z_)) && !settle_fully(wanted, expanded)) return false;
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

/// Sets currents at noise level to zero, in legs that conduct one direction only. Also sets a speed at noise
/// level to zero if dry friction may stop the rotor.
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
    if (snapped) plant::detail::balance(state_);
  }
  if (c.dry_friction && plant::detail::abs(state_.w) <= c.speed_noise) state_.w = state_.w_low = 0;
  if (!c.source_sinks && more_.source.value + c.sink <= c.amp_noise) more_.source.set(-c.sink);
}

template <class Real>
void Plant<Real>::advance(Real s) {
  using series::add_compensated;
  const auto by = [&](const series::Coefficients<Real>& of) { return series::increment(of, y_.degree, s); };
  if (heat_.on()) note_losses(s);
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
  const Constants<Real>& c = constants_;
  if (c.inv_C > 0 && c.R_C == 0) add_compensated(q.bus, q.bus_low, by(y_.bus));
  if (c.R_C > 0) {
    more_.capacitor.add(by(z_.capacitor));
    q.bus = series::evaluate(y_.bus, y_.degree, s);
  }
  if (c.inv_L_b > 0) more_.source.add(by(z_.source));
  if (c.has_loop) more_.loop.add(by(z_.loop));
  if (c.elastic) {
    more_.load_w.add(by(z_.load_w));
    more_.twist.add(by(z_.twist));
  }
  if (c.load_rate != 0) more_.load.add(c.load_rate * (y_.h * s));
  if (c.source == Source::battery) {
    more_.charge.add(by(z_.charge));
    more_.slow.add(by(z_.slow));
  }
  if (c.mains_peak > 0) more_.phase.add(c.mains_rate * (y_.h * s));
  doubted_ = s == 0;
}

template <class Real>
bool Plant<Real>::pass_edge(bool ahead) {
  const auto& sectors = constants_.shape.sector;
  return plant::detail::pass_edge(
      state_, mode_, ahead, [&](std::size_t sector) { return sectors[sector].data(); },
      [&](std::size_t sector) { return sectors[sector].size(); });
}

/// Handles the events whose part of the mode settle() does not determine. Also handles the event that a
/// source reaches or leaves its current limit.
template <class Real>
void Plant<Real>::mode_event(int id) {
  switch (id) {
    case guard::source:
      if (constants_.inv_L_b > 0 && mode_.source_feeds) more_.source.set(-constants_.sink);
      return;
    case guard::brake:
      mode_.braking = !mode_.braking;
      return;
    case guard::load_turns:
      mode_.load_sign = static_cast<std::int8_t>(-mode_.load_sign);
      return;
    case guard::gear_turns:
      mode_.through_sign = static_cast<std::int8_t>(-mode_.through_sign);
      return;
    case guard::faster:
      ++mode_.load_piece;
      return;
    case guard::slower:
      --mode_.load_piece;
      return;
    case guard::fuller:
      ++mode_.charge_piece;
      return;
    case guard::emptier:
      --mode_.charge_piece;
      return;
    case guard::pulse:
      more_.phase.set(-constants_.mains_edge);
      return;
    case guard::saturated:
    case guard::saturated + 1:
      beyond_model_ = true;
      return;
    default:
      return;
  }
}

template <class Real>
bool Plant<Real>::apply(int id) {
  const int before = std::exchange(last_event_, id);
  if (id == guard::edge_ahead || id == guard::edge_behind) {
    const bool ahead = id == guard::edge_ahead, leaves = pass_edge(ahead);
    if (doubted_ && before == (ahead ? guard::edge_behind : guard::edge_ahead))
      plant::detail::clear_edge(state_, ahead);
    return leaves;
  }
  if (id < guard::standstill) {
    state_.i[id] = state_.i_low[id] = 0;
    if (connected_count(mode_.legs) == 2) state_.i = state_.i_low = {};
    plant::detail::balance(state_);
  }
  if (id == guard::standstill) state_.w = state_.w_low = 0;
  mode_event(id);
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
    now.pole[k] = is_floating(mode_.legs[k])
                      ? value(z_.pole[k])
                      : pole_voltage(constants_.terms(k, mode_.legs[k]), now.bus, now.i[k]);
  if (connected_count(mode_.legs) == 0) {
    const StarEnds ends = star_ends(now.pole, dead_);
    const Real star = (now.bus - now.pole[ends.high] - now.pole[ends.low]) / 2;
    for (Real& u : now.pole) u += star;
  }
  now.bus_current = bus_current(mode_.legs, now.i);
  return now;
}

// Defined once, in plant/snapshot.cpp.
extern template Snapshot<double> Plant<double>::at(double) const;

}  // namespace sixstep::plant::general
