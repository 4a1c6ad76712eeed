// SPDX-License-Identifier: Apache-2.0
// Switching energies per volt and ampere, from an IGBT's or a MOSFET's sheet (model.md 8).
#pragma once
#include "sixstep/plant/device_losses.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// IGBT: the sheet's energies divided by the voltage and the current at which the sheet states them.
/// MOSFET: U i (t_i + t_u)/2 at turn-on and at turn-off, and Q_rr U at turn-on, with the bus voltage U, the
/// current i and the recovery charge Q_rr. t_i + t_u, the rise time of the current and the fall time of the
/// voltage, is the gate charge divided by the gate current.
inline plant::SwitchingLaw switching_law(const Bridge& b) {
  plant::SwitchingLaw law{.on_J_V = b.recovery_charge_C};
  if (b.energies_at_V > 0 && b.energies_at_A > 0) {
    const double per = 1 / (b.energies_at_V * b.energies_at_A);
    law.on_J_VA = b.turn_on_J * per;
    law.off_J_VA = b.turn_off_J * per;
    law.recovery_J_VA = b.recovery_J * per;
  }
  if (b.gate_current_A > 0) {
    const double seconds = (b.gate_source_charge_C + b.gate_drain_charge_C) / b.gate_current_A;
    law.on_J_VA += seconds / 2;
    law.off_J_VA += seconds / 2;
  }
  return law;
}

}  // namespace sixstep::study
