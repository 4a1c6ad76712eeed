// SPDX-License-Identifier: Apache-2.0
// Integrates energies over a window and computes the efficiency from them, with the same series as the energy
// book (plant/segment_energy.hpp).
#pragma once
#include <optional>

#include "sixstep/study/measure/loss_gauge.hpp"
#include "sixstep/study/measure/signals.hpp"
#include "sixstep/study/measure/window.hpp"

namespace sixstep::study {

/// The load's part of the shaft's friction: its energy counts as delivered, not as lost.
struct LoadFriction {
  double viscous_Nm_s = 0.0, coulomb_Nm = 0.0;
};

/// Energies over a window, J. The sums also keep their rounding errors.
struct Energies {
  series::CompensatedSum<double> supplied, copper, devices, air_gap, friction, load;
  series::CompensatedSum<double> load_friction;  ///< the part of the friction that belongs to the load
};

class EnergyGauge {
 public:
  /// `switching`: switching losses, added to the bus's energy when an efficiency is measured.
  EnergyGauge(const Window& window, const LoadFriction& load, const plant::SwitchingLaw& switching = {})
      : window_(window), load_(load), switches_(switching.any()), losses_(switching) {}

  void segment(const SegmentView& g, double s);
  /// Energy in J for a signal that is a power; empty if no time of the window was simulated.
  std::optional<double> energy(Signal signal) const;
  /// Delivered energy divided by supplied energy, 0 to 1. Empty if no energy was supplied, or no time of the
  /// window was simulated.
  /// - Motoring: energy to load and inertias divided by energy from the bus.
  /// - Braking, where the energies reverse: energy into the bus divided by energy from the shaft.
  /// - 0 if both shaft and bus supply the losses.
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
