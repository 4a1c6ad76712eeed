// SPDX-License-Identifier: Apache-2.0
// An EnergyGauge integrates energies over a window and the efficiency they make, from the same series as the
// energy book (plant/segment_energy.hpp).
#pragma once
#include <optional>

#include "sixstep/study/measure/loss_gauge.hpp"
#include "sixstep/study/measure/signals.hpp"
#include "sixstep/study/measure/window.hpp"

namespace sixstep::study {

/// The part of the shaft's friction that belongs to the load: what it takes is delivered, not lost.
struct LoadFriction {
  double viscous_Nm_s = 0.0, coulomb_Nm = 0.0;
};

/// J over a window, in sums that keep what they round away.
struct Energies {
  series::CompensatedSum<double> supplied, copper, devices, air_gap, friction, load;
  series::CompensatedSum<double> load_friction;  ///< the load's share of friction
};

class EnergyGauge {
 public:
  /// switching: what comes to the bus's energy where an efficiency is asked for.
  EnergyGauge(const Window& window, const LoadFriction& load, const plant::SwitchingLaw& switching = {})
      : window_(window), load_(load), switches_(switching.any()), losses_(switching) {}

  void segment(const SegmentView& g, double s);
  /// J, of a signal that is a power; empty where the window saw nothing.
  std::optional<double> energy(Signal signal) const;
  /// Out over in, 0 to 1. As a motor: energy given to load and inertias over energy from the bus. Braking,
  /// both flow back: energy into the bus over energy taken from the shaft. 0 where shaft and bus both feed
  /// the losses. Empty where nothing came in, or the window saw nothing.
  std::optional<double> efficiency() const;

 private:
  void add_up_to(const SegmentView& g, double s, double sign);

  Window window_;
  LoadFriction load_;
  bool seen_ = false, switches_ = false;
  plant::DeviceLosses losses_;
  Energies sum_;
};

}  // namespace sixstep::study
