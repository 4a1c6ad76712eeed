// SPDX-License-Identifier: Apache-2.0
// Losses of each of the six switches and six diodes (model.md 8): conduction losses from the segment's
// series, and switching energies, which affect only temperatures and efficiency. Both kernels add the losses
// segment by segment.
//
// If a switch takes over the current of the opposite switch's diode, the switch loses E_on and the diode
// loses E_rr. A switch that turns off a current loses E_off. Two cases cause no switching loss: zero current,
// and a current in the direction of the switch's antiparallel diode. A channel that conducts such a current
// counts as the diode, because the diode conducts it in each pause between the two switches.
#pragma once
#include <array>

#include "sixstep/plant/circuit.hpp"

namespace sixstep::plant {

/// Switching energies: J per volt of the bus and ampere of the current (_J_VA), and J per volt of the bus
/// (_J_V).
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

/// Devices of one leg: the upper switch (T1, T3 or T5) and the lower switch (T2, T4 or T6), each with its
/// diode.
struct LegDevices {
  DeviceEnergy upper{}, lower{};
};
using DeviceEnergies = std::array<LegDevices, 3>;

class DeviceLosses {
 public:
  explicit DeviceLosses(const SwitchingLaw& law = {}) : law_(law) {}

  /// Begins a segment, and adds the switching energy of each leg whose connection has changed since the last
  /// segment, at current i and bus voltage U. With `counts` false the connections are only stored.
  template <class Real>
  void begin(const Legs& legs, const PerLeg<Real>& i, Real U, bool counts = true) {
    if (known_ && counts)
      for (std::size_t k = 0; k < 3; ++k)
        if (legs[k] != legs_[k])
          switched(legs_[k], legs[k], static_cast<double>(i[k]), static_cast<double>(U), energies_[k]);
    legs_ = legs;
    known_ = true;
  }
  /// Adds the energy, J, that the conducting device of leg k lost in a segment.
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
  /// Adds the energy of a change of connection. A positive current flows through the transistor of the upper
  /// switch, a negative current through the transistor of the lower switch.
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
