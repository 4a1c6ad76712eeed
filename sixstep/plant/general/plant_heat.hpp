// SPDX-License-Identifier: Apache-2.0
// Member functions of general/plant.hpp that sum the losses during a thermal step, and change the plant's
// parameters at the end of the step.
#pragma once
#include "sixstep/plant/general/energy_nodes.hpp"
#include "sixstep/plant/general/plant.hpp"

namespace sixstep::plant::general {

template <class Real>
StretchLosses Plant<Real>::losses_up_to(Real s) const {
  StretchLosses out{.dt_s = static_cast<double>(y_.h * s)};
  series::with_points_for(y_.degree, [&]<int points>() {
    const detail::AtNodes<points, Real> at{*this, series::nodes_up_to<points>(s), y_.h * s};
    const auto w = at.of(y_.w);
    out.copper_J = static_cast<double>(detail::copper_energy<points>(at));
    out.square = static_cast<double>(at.integral(w, w));
    out.travel = static_cast<double>(at.integral(w));
  });
  return out;
}

template <class Real>
void Plant<Real>::note_losses(Real s) {
  heat_.add(losses_up_to(s));
  series::with_points_for(y_.degree, [&]<int points>() {
    const detail::AtNodes<points, Real> at{*this, series::nodes_up_to<points>(s), y_.h * s};
    if (!heat_.given().devices) return;
    DeviceLosses& losses = heat_.losses();
    losses.begin(mode_.legs, state_.i, y_.bus[0]);
    for (std::size_t k = 0; k < 3; ++k)
      if (!is_floating(mode_.legs[k]))
        losses.conducted(k, mode_.legs[k], static_cast<double>(detail::device_energy<points>(at, k)));
  });
}

template <class Real>
void Plant<Real>::take_thermal_step() {
  if (!heat_.due()) return;
  heat_.take_step();
  if (heat_.given().motor) set_warmth(heat_.on_R(), heat_.on_K_e());
  if (heat_.given().devices) set_bridge();
  stale_ = true;
}

// Defined once, in plant_heat.cpp. Source files that only read a temperature are compiled for size. Without
// this declaration the linker might use the slow integrals of such a file for the engine.
extern template StretchLosses Plant<double>::losses_up_to(double) const;

}  // namespace sixstep::plant::general
