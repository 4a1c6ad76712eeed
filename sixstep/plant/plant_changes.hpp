// SPDX-License-Identifier: Apache-2.0
// Member functions of plant.hpp that change the shaft's clamp, the source, and the noise scales during a run.
#pragma once
#include "sixstep/plant/plant.hpp"

namespace sixstep::plant {

/// Sets the scales that distinguish rounding noise from a signal.
template <class Real>
void Plant<Real>::set_scales(Real volt_scale) {
  Constants<Real>& c = constants_;
  detail::set_scales(c, volt_scale, c.R, c.K_e);
  c.amp_limit = terms_per_scale<Real> / c.amp_scale;
  c.speed_limit = terms_per_scale<Real> / c.speed_scale;
  c.volt_limit = terms_per_scale<Real> / c.volt_scale;
}

template <class Real>
void Plant<Real>::set_steady_rate() {
  Constants<Real>& c = constants_;
  const Real winding = (c.R + std::max(Real(c.devices.R_on_ohm), Real(c.devices.r_d_ohm))) * c.inv_L;
  const Real electromechanical = c.locked ? Real(0) : c.K_e * std::sqrt(c.inv_L * c.inv_J);
  c.steady_rate = winding + electromechanical + c.inv_C * (c.inv_R_b + 1 / c.R);
}

/// A clamp that closes stops the shaft at once and absorbs its kinetic energy. After the clamp opens, the
/// shaft starts from rest.
template <class Real>
void Plant<Real>::set_locked(bool locked) {
  constants_.locked = locked;
  constants_.dry_friction = constants_.breakaway > 0 && !locked;
  // mutant: if (locked) state_.w = state_.w_low = 0; => nothing
  if (locked) state_.w = state_.w_low = 0;
  set_steady_rate();
  stale_ = true;
}

/// Sets the source's voltage, V; a stiff bus follows at once. The noise level never falls, because values
/// that were rounded at a higher voltage keep their rounding error.
template <class Real>
void Plant<Real>::set_source_voltage(double V_0_V) {
  Constants<Real>& c = constants_;
  c.V_0 = Real(V_0_V);
  if (!(c.inv_C > 0)) {
    state_.bus = c.V_0;
    state_.bus_low = 0;
  }
  set_scales(std::max(c.volt_scale, c.V_0 + Real(c.devices.V_f_V)));
  stale_ = true;
}

template <class Real>
void Plant<Real>::set_source_sinks(bool sinks) {
  // mutant: sinks || !(constants_.inv_C > 0) => true
  constants_.source_sinks = sinks || !(constants_.inv_C > 0);
  stale_ = true;
}

}  // namespace sixstep::plant
