// SPDX-License-Identifier: Apache-2.0
// The numbers of a back-EMF observer (control/sensorless/observer.hpp) from the sheet, one rule for all three:
//
//   lag             1/5 of a sector at no-load speed: late enough to average, early enough that crossing + lag + one
//                   period lies before the commutation. m = lag/T - 1/2 periods of it are the observer's own
//   Luenberger      both poles at p = m/(2 + m): (1 - l) a = p^2, h b = (1 - p)^2
//   sliding mode    k = U: above 4/3 K_e w up to 3/2 of the no-load speed; phi = k b/a; low-pass c = 1/(1 + m)
//   flux linkage    psi_c = K_e/p integral over 30 degrees behind the crossing; (1 - advance/30)^2 of it commutates; lag T/2
//
// What the parameters do where they are wrong: in the leg that floats no current flows, so that neither R nor L moves its
// crossing; they make the old estimate die a little faster or slower. K_e moves the commutation of flux linkage alone,
// by 15 degrees times its relative error.
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/sensorless/observer.hpp"
#include "sixstep/design/loops/sensorless_start.hpp"

namespace sixstep::design {

struct SensorlessObserver {
  control::ObserverConfig<double> chip;
  double pole = 0.0;           ///< p in z, both of the Luenberger observer
  double lag_s = 0.0;          ///< of the estimate
  double level_V_s = 0.0;      ///< psi_c
  double highest_rad_s = 0.0;  ///< four control periods a sector
  std::vector<DerivationStep> steps;
};

/// For the same motor and board as sensorless_start. Problems name the key: samples in the freewheel show a terminal that
/// a diode may hold; an inductance of nothing has no equation. What is no observer gives the default.
base::Result<SensorlessObserver> sensorless_observer(const MotorModel& motor, const SensorlessSpec& spec,
                                                     control::Follow follow);

/// The flux linkage that the floating leg loses from its zero crossing to the commutation, V s.
double flux_level_V_s(const plant::Machine& machine);

/// sensorless_drive with an observer in it.
control::SensorlessDriveConfig<double> sensorless_drive(const control::DriveConfig<double>& drive,
                                                        const SensorlessStart& start,
                                                        const SensorlessObserver& observer);

}  // namespace sixstep::design
