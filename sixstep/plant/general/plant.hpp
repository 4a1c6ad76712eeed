// SPDX-License-Identifier: Apache-2.0
// The general kernel: the same members as plant::Plant, for machines, shafts, bridges and supplies that the lean one lacks
// (model.md 7 to 9). A run chooses once which of the two it needs.
#pragma once
#include <utility>

#include "sixstep/plant/general/settle.hpp"
#include "sixstep/plant/plant.hpp"

namespace sixstep::plant::general {

template <class RealType>
class Plant {
 public:
  using Real = RealType;

  Plant(const Machine& machine, const Shaft& shaft, const Devices& devices, const Supply& supply,
        const Start& start);

  /// False: both switches of a leg on, a shoot-through; nothing is changed then.
  bool set_gates(const Gates& gates) {
    if (shoots_through(gates)) return false;
    if (gates == gates_) return true;
    gates_ = gates;
    stale_ = true;
    return true;
  }
  /// At the load's side.
  void set_load(double torque_Nm) {
    constants_.load = static_cast<Real>(torque_Nm);
    stale_ = true;
  }
  void set_locked(bool locked);
  void set_source_voltage(double V_0_V);
  void set_source_sinks(bool sinks);
  /// The wire of leg k breaks: it opens at its current's next zero.
  void break_wire(int k) {
    breaking_ |= 1U << k;
    stale_ = true;
  }

  double expand(double wanted);
  template <class Visit>
  void guards(Visit&& visit) const {
    mode_guards(constants_, gates_, mode_, dead_, breaking_, y_, z_, slack_, visit);
    edge_guards(piece(), y_, visit);
  }
  void advance(Real s);
  bool apply(int id);

  const State<Real>& state() const { return state_; }
  const More<Real>& more() const { return more_; }
  const Mode& mode() const { return mode_; }
  const Gates& gates() const { return gates_; }
  const Constants<Real>& constants() const { return constants_; }
  const Expansion<Real>& expansion() const { return y_; }
  const Series<Real>& series() const { return z_; }
  Real slack() const { return slack_; }
  int sector() const { return mode_.sector; }
  std::int64_t diodes_started() const { return diodes_started_; }
  Snapshot<Real> at(Real s) const;

 private:
  const Piece<Real>& piece() const { return constants_.shape.sector[mode_.sector][mode_.piece]; }
  void set_winding(const Machine& machine);
  void set_shaft(const Shaft& shaft);
  void set_supply(const Supply& supply);
  void set_scales(Real volt_scale);
  void set_rates();
  void place(const Start& start);
  bool resettle(Real wanted, bool& expanded);
  bool settle_fully(Real wanted, bool& expanded);
  void snap();
  void balance();
  bool pass_edge(bool ahead);
  void leave_edge(bool ahead);

  Constants<Real> constants_;
  State<Real> state_;
  More<Real> more_;
  Mode mode_;
  Gates gates_;
  Expansion<Real> y_;
  Series<Real> z_;
  Real slack_ = 1, K_e_ = 0, stiffest_L_ = 0;
  std::int64_t diodes_started_ = 0;
  unsigned dead_ = 0, breaking_ = 0;  ///< legs as masks: the wire is open, and opens at the next zero
  bool stale_ = true, doubted_ = false;
  int last_event_ = -1;
};

}  // namespace sixstep::plant::general

#include "sixstep/plant/general/plant_events.hpp"
#include "sixstep/plant/general/plant_set_up.hpp"
