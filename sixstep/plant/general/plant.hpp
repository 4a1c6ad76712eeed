// SPDX-License-Identifier: Apache-2.0
// The general kernel. It has the same interface as plant::Plant, and simulates machines, shafts, bridges and
// supplies that the lean kernel does not model (model.md 7 to 9). A run selects one of the two kernels at its
// start.
#pragma once
#include <utility>

#include "sixstep/plant/general/floating_star.hpp"
#include "sixstep/plant/general/heat.hpp"
#include "sixstep/plant/general/settle.hpp"
#include "sixstep/plant/plant.hpp"

namespace sixstep::plant::general {

template <class RealType>
class Plant {
 public:
  using Real = RealType;

  Plant(const Machine& machine, const Shaft& shaft, const Devices& devices, const Supply& supply,
        const Start& start, const HeatGiven& heat = {});

  /// Sets the gates. Returns false, without a change, if both switches of a leg would be on (shoot-through).
  bool set_gates(const Gates& wanted) {
    const Gates gates{(wanted.high & ~failed_.open.high) | failed_.shorted.high,
                      (wanted.low & ~failed_.open.low) | failed_.shorted.low};
    if (shoots_through(gates)) return false;
    if (gates == gates_) return true;
    gates_ = gates;
    stale_ = true;
    return true;
  }
  /// Sets the load torque at the load's side. The torque then grows by rate_Nm_s per second.
  void set_load(double torque_Nm, double rate_Nm_s = 0.0) {
    more_.load.set(static_cast<Real>(torque_Nm));
    constants_.load_rate = static_cast<Real>(rate_Nm_s);
    stale_ = true;
  }
  /// Sets the speed that a dynamometer imposes at the load's side. The speed then grows by rate_rad_s2 per
  /// second.
  void set_speed(double speed_rad_s, double rate_rad_s2);
  void set_locked(bool locked);
  /// Requires a steady source.
  void set_source_voltage(double V_0_V);
  void set_source_sinks(bool sinks);
  /// Sets the factors by which temperature changes the given R and K_e. Currents and speed do not jump.
  void set_warmth(double on_R, double on_K_e);
  /// True if temperatures are simulated: the control tick that ends a thermal step then changes R, K_e and
  /// R_on.
  bool warms() const { return heat_.on(); }
  void take_thermal_step();
  const Heat& heat() const { return heat_; }
  /// Temperatures of winding and housing at the fraction s of the segment, degC.
  BodyTemperatures bodies_degC(Real s) const {
    return heat_.given().motor ? heat_.bodies_degC(losses_up_to(s)) : heat_.bodies_degC();
  }
  /// Breaks the wire of leg k. The wire opens at the next zero of its current.
  void break_wire(int k) {
    breaking_ |= 1U << k;
    stale_ = true;
  }
  /// The upper or lower switch of leg k fails. With `shorted` it is permanently on, otherwise permanently off
  /// with an intact diode. The fault takes effect at the next set_gates().
  void fail_switch(int k, bool high, bool shorted) {
    Gates& gates = shorted ? failed_.shorted : failed_.open;
    (high ? gates.high : gates.low).set(static_cast<std::size_t>(k));
  }
  /// Mask of the legs whose wire is broken but not yet open.
  unsigned breaking() const { return breaking_; }
  /// Mask of the legs whose wire is open.
  unsigned dead() const { return dead_; }
  /// True if a current has left the range in which the formula of saturation is valid.
  bool beyond_model() const { return beyond_model_; }

  double expand(double wanted);
  template <class Visit>
  void guards(Visit&& visit) const {
    mode_guards(constants_, gates_, mode_, dead_, breaking_, y_, z_, slack_, visit);
    edge_guards(piece(), y_, visit);
  }
  void end_at(Real) {}  ///< empty: advance() computes the increments
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
  void set_bridge();
  void set_load_laws(const Load& load);
  void set_supply(const Supply& supply);
  void set_source(const Supply& supply);
  void set_scales(Real volt_scale);
  void set_rates();
  void place(const Start& start);
  void find_pieces();
  void mode_event(int id);
  StretchLosses losses_up_to(Real s) const;
  void note_losses(Real s);
  bool resettle(Real wanted, bool& expanded);
  bool settle_fully(Real wanted, bool& expanded);
  void snap();
  bool pass_edge(bool ahead);

  Constants<Real> constants_;
  State<Real> state_;
  More<Real> more_;
  Mode mode_;
  Gates gates_;
  Expansion<Real> y_;
  Series<Real> z_;
  Real slack_ = 1, K_e_ = 0, stiffest_L_ = 0;
  std::int64_t diodes_started_ = 0;
  struct Failed {
    Gates open, shorted;
  };
  Failed failed_{};
  Heat heat_;
  Real cold_R_ = 1, cold_K_e_ = 1;    ///< the factors of the last set_warmth()
  unsigned dead_ = 0, breaking_ = 0;  ///< masks of legs: the wire is open; the wire opens at the next zero of
                                      ///< the current
  bool stale_ = true, doubted_ = false, beyond_model_ = false;
  int last_event_ = -1;
};

}  // namespace sixstep::plant::general

#include "sixstep/plant/general/plant_events.hpp"
#include "sixstep/plant/general/plant_heat.hpp"
#include "sixstep/plant/general/plant_set_up.hpp"
