// SPDX-License-Identifier: Apache-2.0
// Losses of each of the six switches and six diodes (model.md 8): conduction losses from the segment's
// series, and switching energies, which affect only temperatures and efficiency. The plant of either kernel
// supplies them segment by segment.
//
// A switch that takes over a current from the other switch's diode loses E_on, and that diode loses E_rr. A
// switch that turns off a current loses E_off. Nothing is lost without current, or where the current flows in
// the direction of the switch's own diode: a channel that carries this current counts as the diode, because
// the diode carries the current in any pause between the two switches.
#pragma once
#include <array>

#include "sixstep/plant/circuit.hpp"

namespace sixstep::plant {

/// Switching energies: J per volt of the bus and ampere of the current (_J_VA), and J per volt of the bus
/// alone (_J_V).
struct SwitchingLaw {
  double on_J_VA = 0.0, off_J_VA = 0.0, recovery_J_VA = 0.0, on_J_V = 0.0;
  bool any() const { return on_J_VA > 0 || off_J_VA > 0 || recovery_J_VA > 0 || on_J_V > 0; }
};

/// Energy lost in one switch with its diode, J.
struct DeviceEnergy {
  double conduction = 0.0, turn_on = 0.0, turn_off = 0.0;  ///< energy of the transistor
  double diode = 0.0, recovery = 0.0;                      ///< energy of its antiparallel diode

  double switching() const { return turn_on + turn_off + recovery; }
  /// Energy that heats the switch's junction: a MOSFET's body diode is in the same crystal, an IGBT's diode
  /// is not.
  double in_crystal(bool igbt) const {
    return conduction + turn_on + turn_off + (igbt ? 0.0 : diode + recovery);
  }
};

/// Devices of one leg: upper T1, T3, T5; lower T2, T4, T6.
struct LegDevices {
  DeviceEnergy upper{}, lower{};
};
using DeviceEnergies = std::array<LegDevices, 3>;

class DeviceLosses {
 public:
  explicit DeviceLosses(const SwitchingLaw& law = {}) : law_(law) {}

  /// Begins a segment: each leg whose connection has changed since the last segment has switched current i at
  /// bus voltage U. With `counts` false no energy is counted; the connections are only stored.
  template <class Real>
  void begin(const Legs& legs, const PerLeg<Real>& i, Real U, bool counts = true) {
    if (known_ && counts)
      for (std::size_t k = 0; k < 3; ++k)
        if (legs[k] != legs_[k])
          switched(legs_[k], legs[k], static_cast<double>(i[k]), static_cast<double>(U), energies_[k]);
    legs_ = legs;
    known_ = true;
  }
  /// Adds the energy, J, that leg k lost in its device over a segment.
  void conducted(std::size_t k, Connection by, double energy) {
    LegDevices& leg = energies_[k];
    if (is_floating(by)) return;
    DeviceEnergy& device = is_high(by) ? leg.upper : leg.lower;
    (is_diode(by) ? device.diode : device.conduction) += energy;
  }

  const DeviceEnergies& energies() const { return energies_; }
  double switching() const {
    double sum = 0.0;
    for (const LegDevices& leg : energies_) sum += leg.upper.switching() + leg.lower.switching();
    return sum;
  }
  void clear() { energies_ = {}; }

 private:
  /// Counts a change of connection. The transistor of the upper switch carries a positive current, the
  /// transistor of the lower switch a negative current.
  void switched(Connection before, Connection after, double i, double U, LegDevices& leg) const {
    if (i == 0.0) return;
    const bool from_high = is_high(before), to_high = is_high(after), positive = i > 0;
    DeviceEnergy& forward = positive ? leg.upper : leg.lower;   // the switch whose transistor carries i
    DeviceEnergy& backward = positive ? leg.lower : leg.upper;  // the switch whose diode carries i
    const double VA = U * (positive ? i : -i);
    const bool carried = !is_floating(before) && from_high == positive && !is_diode(before);
    const bool carries = !is_floating(after) && to_high == positive && !is_diode(after);
    if (carries && !carried) {
      forward.turn_on += law_.on_J_VA * VA + law_.on_J_V * U;
      backward.recovery += law_.recovery_J_VA * VA;
    } else if (carried && !carries) {
      forward.turn_off += law_.off_J_VA * VA;
    }
  }

  SwitchingLaw law_;
  DeviceEnergies energies_{};
  Legs legs_{};
  bool known_ = false;
};

}  // namespace sixstep::plant
