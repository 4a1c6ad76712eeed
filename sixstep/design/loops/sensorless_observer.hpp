// SPDX-License-Identifier: Apache-2.0
// Designs a back-EMF observer (control/sensorless/observer.hpp) from the sheet, with one rule for all three
// kinds:
//
//   lag             1/5 of a sector at no-load speed: long enough to average, and short enough that crossing
//                   + lag + one period is before the commutation. The observer's part of the lag is
//                   m = lag/T - 1/2 periods
//   Luenberger      both poles at p = m/(2 + m): (1 - l) a = p^2, h b = (1 - p)^2
//   sliding mode    k = U, which is above 4/3 K_e w up to 3/2 of the no-load speed; phi = k b/a; low-pass
//                   c = 1/(1 + m)
//   flux linkage    psi_c = K_e/p integral over 30 degrees after the crossing; the drive commutates when psi
//                   has fallen by (1 - advance/30)^2 of psi_c; the lag is T/2
//
// T is the control period, U the bus; a, b, l, h, k, phi and c are the symbols of luenberger.hpp and
// sliding_mode.hpp. Effect of wrong parameters: no current flows in the floating leg, so that neither R nor L
// moves the crossing; they only change the decay of the old estimate a little. K_e moves the commutation with
// the flux linkage only, by 15 degrees times its relative error.
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/sensorless/observer.hpp"
#include "sixstep/design/loops/sensorless_start.hpp"

namespace sixstep::design {

struct SensorlessObserver {
  control::ObserverConfig<double> chip;
  double pole = 0.0;           ///< p in z, both poles of the Luenberger observer
  double lag_s = 0.0;          ///< lag of the estimate
  double level_V_s = 0.0;      ///< psi_c, fall of the flux linkage in the 30 degrees after the crossing
  double highest_rad_s = 0.0;  ///< highest speed, at four control periods per sector
  std::vector<DerivationStep> steps;
};

/// Designs an observer for the motor and board of sensorless_start(). Problems name the key: samples in the
/// freewheel may measure a terminal that a diode clamps, and an inductance is required. If `follow` is no
/// observer, the result is the default.
base::Result<SensorlessObserver> sensorless_observer(const MotorModel& motor, const SensorlessSpec& spec,
                                                     control::Follow follow);

/// Change of the floating leg's flux linkage from its zero crossing to the commutation, V s.
double flux_level_V_s(const plant::Machine& machine);

/// Returns sensorless_drive() with an observer.
control::SensorlessDriveConfig<double> sensorless_drive(const control::DriveConfig<double>& drive,
                                                        const SensorlessStart& start,
                                                        const SensorlessObserver& observer);

}  // namespace sixstep::design
