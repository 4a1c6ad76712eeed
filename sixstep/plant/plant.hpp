// SPDX-License-Identifier: Apache-2.0
// Simulates motor, bridge with diodes, shaft and supply as one system between events (model.md 1, 2, 4b). The
// rig sets gates and load. The run loop calls expand(), advance() and apply() for the events that it locates.
#pragma once
#include <algorithm>

#include "sixstep/plant/settle.hpp"
#include "sixstep/plant/state_transitions.hpp"

namespace sixstep::plant {

struct Start {
  double speed_rad_s = 0.0;
  double angle_rad = 0.0;  ///< mechanical
  double bus_V = 0.0;
};

/// Values at one instant, SI units. If all legs float, the pole voltages are centred between the rails.
template <class Real>
struct Snapshot {
  PerLeg<Real> i{}, emf{}, pole{};
  Real speed = 0, angle = 0, bus = 0, bus_current = 0, torque = 0;
};

template <class RealType>
class Plant {
 public:
  using Real = RealType;

  Plant(const Machine& machine, const Shaft& shaft, const Devices& devices, const Supply& supply,
        const Start& start);

  /// Sets the gates. Returns false, without a change, if both switches of a leg would be on (shoot-through).
  bool set_gates(const Gates& gates) {
    if (shoots_through(gates)) return false;
    if (gates == gates_) return true;
    gates_ = gates;
    stale_ = true;
    return true;
  }
  void set_load(double torque_Nm) {
    constants_.load = static_cast<Real>(torque_Nm);
    stale_ = true;
  }
  // Other changes by a scenario (plant_changes.hpp).
  void set_locked(bool locked);
  void set_source_voltage(double V_0_V);
  void set_source_sinks(bool sinks);

  /// Settles the mode if gates, load or state have changed since the last call, then expands the state over
  /// `wanted`, s, or less. Returns the length of the expansion, s; a negative value means that no mode is
  /// consistent.
  double expand(double wanted);
  template <class Visit>
  void guards(Visit&& visit) const {
    mode_guards(constants_, mode_, y_, slack_, visit);
    edge_guards(constants_.emf[mode_.sector].piece[mode_.piece], y_, visit);
  }
  /// Ends the segment at the fraction s of its length: writes the increments up to this fraction to the
  /// expansion's `end`. Call it once per expansion.
  void end_at(Real s) {
    if (s != 1) y_.end = detail::increments(y_, constants_.legs[legs_index(mode_.legs)], s);
  }
  /// Advances the state to the fraction s of the segment.
  void advance(Real s);
  /// Applies the located event `id`; true if the rotor entered another sector.
  bool apply(int id);

  const State<Real>& state() const { return state_; }
  const Mode& mode() const { return mode_; }
  const Gates& gates() const { return gates_; }
  const Constants<Real>& constants() const { return constants_; }
  const Expansion<Real>& expansion() const { return y_; }
  /// Factor on the constants' noise levels in this mode: 1, or more if no mode was consistent with factor 1.
  Real slack() const { return slack_; }
  int sector() const { return mode_.sector; }
  /// Number of times that a floating leg began to conduct by a diode.
  std::int64_t diodes_started() const { return diodes_started_; }
  Snapshot<Real> at(Real s) const;

 private:
  void snap();
  bool resettle(Real wanted, bool& expanded);
  bool settle_fully(Real wanted, bool& expanded);
  bool pass_edge(bool ahead);
  void set_scales(Real volt_scale);
  void set_steady_rate();

  alignas(64) Constants<Real> constants_;
  alignas(64) State<Real> state_;
  Mode mode_;
  Gates gates_;
  alignas(64) Expansion<Real> y_;
  Real slack_ = 1;
  std::int64_t diodes_started_ = 0;
  bool stale_ = true;
  bool doubted_ = false;  ///< true: the last located event did not advance the time, and settle() must check
                          ///< by the series only
  int last_event_ = -1;
};

template <class Real>
Plant<Real>::Plant(const Machine& m, const Shaft& shaft, const Devices& devices, const Supply& supply,
                   const Start& start)
    : constants_{}, y_{} {
  Constants<Real>& c = constants_;
  const Real R = c.R = Real(m.R_ohm), inv_L = c.inv_L = 1 / Real(m.L_H), K_e = Real(m.K_e_V_s);
  c.inv_J = 1 / Real(shaft.J_kg_m2);
  c.B = Real(shaft.B_Nm_s);
  c.pole_pairs = Real(m.pole_pairs);
  c.inv_pole_pairs = 1 / c.pole_pairs;
  c.coulomb = Real(shaft.coulomb_Nm);
  // mutant: std::max(c.coulomb, Real(shaft.static_Nm)) => c.coulomb
  c.breakaway = std::max(c.coulomb, Real(shaft.static_Nm));
  c.V_0 = Real(supply.V_0_V);
  const bool stiff = !(supply.C_F > 0);
  c.inv_C = stiff ? Real(0) : 1 / Real(supply.C_F);
  c.inv_R_b = stiff ? Real(0) : 1 / Real(supply.R_b_ohm);
  c.source_sinks = stiff || supply.sinks;
  c.devices = devices;
  c.sine = m.back_emf == BackEmf::sine;
  c.emf = c.sine ? sine_table<Real>() : trapezoid_table<Real>(m.flat_deg);
  for (EmfSector<Real>& sector : c.emf)
    for (EmfPiece<Real>& piece : sector.piece) scale(piece, K_e);
  c.legs = legs_laws(devices, R, inv_L);
  const Real emf = 2 * K_e * detail::abs(Real(start.speed_rad_s));
  c.K_e = K_e;
  set_scales(std::max(c.V_0, Real(start.bus_V)) + Real(devices.V_f_V) + emf);
  c.poles = pole_table<Real>(devices);

  state_.bus = stiff ? c.V_0 : Real(start.bus_V);
  state_.w = Real(start.speed_rad_s);
  set_locked(shaft.locked);
  const double electrical = start.angle_rad * m.pole_pairs;
  const bool on_edge = detail::set_rotor_angle(state_, electrical);
  mode_.sector = static_cast<std::uint8_t>(sector_in_turn(state_.sector));
  const EmfSector<Real>& pieces = c.emf[mode_.sector];
  while (mode_.piece + 1 < pieces.count && state_.x >= pieces.piece[mode_.piece].to) ++mode_.piece;
  // If the run starts on an edge with a rotor that turns backwards, the edge is passed now. A located event
  // would come before the first tick (model.md 4b).
  // mutant: on_edge && state_.w < 0 => false
  if (on_edge && state_.w < 0) pass_edge(false);
}

template <class Real>
bool Plant<Real>::resettle(Real wanted, bool& expanded) {
  const unsigned floated = constants_.legs[legs_index(mode_.legs)].floating;
  slack_ = 1;
  if ((doubted_ || !settle_fast(constants_, state_, gates_, mode_)) && !settle_fully(wanted, expanded))
    return false;
  stale_ = false;
  // mutant: floated & constants_.legs[legs_index(mode_.legs)].diodes => constants_.legs[legs_index(mode_.legs)].diodes
  for (unsigned started = floated & constants_.legs[legs_index(mode_.legs)].diodes; started != 0;
       started &= started - 1)
    ++diodes_started_;
  return true;
}

/// Calls snap(), then settles the mode by enumeration. As long as no mode is consistent, the noise level is
/// raised.
template <class Real>
bool Plant<Real>::settle_fully(Real wanted, bool& expanded) {
  snap();
  for (; slack_ < 1e5; slack_ *= 16) {
    const Question<Real> question{constants_, state_, gates_, wanted, doubted_, slack_};
    if (settle(question, mode_, y_, expanded)) return true;
  }
  return false;
}

template <class Real>
double Plant<Real>::expand(double wanted) {
  const Real length = useful_length(constants_, state_, static_cast<Real>(wanted));
  bool expanded = false;
  if (stale_ && !resettle(length, expanded)) return -1.0;
  if (!expanded) plant::expand(constants_, state_, mode_, length, y_);
  return static_cast<double>(y_.h);
}

template <class Real>
void Plant<Real>::advance(Real s) {
  using series::add_compensated;
  State<Real>& q = state_;
  const LegsLaw<Real>& law = constants_.legs[legs_index(mode_.legs)];
  const int first = law.leg[0], second = law.leg[1], third = law.leg[2];
  const Increments<Real>& by = y_.end;
  if (law.connected >= 2) {
    add_compensated(q.i[first], q.i_low[first], by.i);
    if (law.connected == 3) {
      add_compensated(q.i[second], q.i_low[second], by.i_2);
      q.i[third] = -(q.i[first] + q.i[second]);
      // mutant: -(q.i_low[first] + q.i_low[second]) => Real(0)
      q.i_low[third] = -(q.i_low[first] + q.i_low[second]);
    } else {
      q.i[second] = -q.i[first];
      q.i_low[second] = -q.i_low[first];
    }
  }
  if (turns(mode_.motion)) {
    add_compensated(q.w, q.w_low, by.w);
    add_compensated(q.x, q.x_low, by.x);
  }
  if (constants_.inv_C > 0) add_compensated(q.bus, q.bus_low, series::increment(y_.bus, y_.degree, s));
  // mutant: s == 0 => false
  doubted_ = s == 0;
}

template <class Real>
Snapshot<Real> Plant<Real>::at(Real s) const {
  using series::evaluate;
  Snapshot<Real> now;
  // One loop for the five series that always change. At s = 0, the segment's start, only their first terms
  // count.
  Real a = 0, b = 0, c = 0, w = 0, x = 0;
  for (int j = s != 0 ? y_.degree : 0; j >= 1; --j) {
    a = (a + y_.i[0][j]) * s;
    b = (b + y_.i[1][j]) * s;
    c = (c + y_.i[2][j]) * s;
    w = (w + y_.w[j]) * s;
    x = (x + y_.x[j]) * s;
  }
  now.i = {y_.i[0][0] + a, y_.i[1][0] + b, y_.i[2][0] + c};
  now.speed = y_.w[0] + w;
  now.bus = constants_.inv_C > 0 ? evaluate(y_.bus, y_.degree, s) : y_.bus[0];
  State<Real> unit;  // with speed 1 the back-EMF of a phase equals its torque per ampere
  unit.w = 1;
  unit.x = y_.x[0] + x;
  const PerLeg<Real> shape = detail::back_emf(constants_, unit, mode_);
  for (int k = 0; k < 3; ++k) now.emf[k] = now.speed * shape[k];
  now.torque = shape[0] * now.i[0] + shape[1] * now.i[1] + shape[2] * now.i[2];
  // mutant: unit.x => state_.x
  now.angle = (static_cast<Real>(state_.sector) * Real(base::sector_rad) + unit.x) / constants_.pole_pairs;
  now.pole = pole_voltages(mode_.legs, constants_.poles, now.bus, now.i, now.emf);
  now.bus_current = bus_current(mode_.legs, now.i);
  return now;
}

// Defined once, in snapshot.cpp, because source files that are compiled for size use this function too.
extern template Snapshot<double> Plant<double>::at(double) const;

}  // namespace sixstep::plant

#include "sixstep/plant/plant_changes.hpp"
#include "sixstep/plant/plant_events.hpp"
