// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/energy_gauge.hpp"

#include "sixstep/plant/segment_energy.hpp"

namespace sixstep::study {

void EnergyGauge::segment(const SegmentView& g, double s) {
  const Clip seen = clipped(window_, g.t_s, g.plant.expansion().h, s);
  if (seen.empty()) return;
  seen_ = true;
  add_up_to(g, seen.to, 1.0);
  if (seen.from > 0.0) add_up_to(g, seen.from, -1.0);
}

/// The segment's energies from its begin to s, times `sign`.
void EnergyGauge::add_up_to(const SegmentView& g, double s, double sign) {
  const plant::SegmentEnergy<double> e = plant::segment_energy(g.plant, s);
  const plant::Constants<double>& c = g.plant.constants();
  const plant::Motion motion = g.plant.mode().motion;
  const double slide = motion == plant::Motion::forward    ? e.travel
                       : motion == plant::Motion::backward ? -e.travel
                                                           : 0.0;
  supplied_.add(sign * e.supplied);
  copper_.add(sign * e.copper);
  devices_.add(sign * e.devices);
  air_gap_.add(sign * e.air_gap);
  friction_.add(sign * (e.viscous + c.coulomb * slide));
  load_work_.add(sign * c.load * e.travel);
  const double squares = c.B > 0 ? e.viscous / c.B : 0.0;  // integral of w^2
  load_friction_.add(sign * (load_.viscous_Nm_s * squares + load_.coulomb_Nm * slide));
}

std::optional<double> EnergyGauge::energy(Signal signal) const {
  if (!seen_) return std::nullopt;
  switch (signal) {
    case Signal::supply_power:
      return supplied_.value;
    case Signal::motor_power:
      return supplied_.value - devices_.value;
    case Signal::mechanical_power:
      return air_gap_.value;
    case Signal::load_power:
      return load_work_.value;
    case Signal::copper_loss:
      return copper_.value;
    case Signal::device_loss:
      return devices_.value;
    case Signal::friction_loss:
      return friction_.value;
    default:
      return std::nullopt;
  }
}

std::optional<double> EnergyGauge::efficiency() const {
  if (!seen_) return std::nullopt;
  const double electrical = supplied_.value;
  const double mechanical = air_gap_.value - (friction_.value - load_friction_.value);
  if (electrical > 0.0) return mechanical > 0.0 ? mechanical / electrical : 0.0;
  if (mechanical < 0.0) return electrical < 0.0 ? electrical / mechanical : 0.0;
  return std::nullopt;
}

}  // namespace sixstep::study
