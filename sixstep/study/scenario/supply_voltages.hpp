// SPDX-License-Identifier: Apache-2.0
// Open-circuit voltages of all kinds of source, including sources whose voltage is not voltage_V.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// A battery's open-circuit voltage in V at a charge from 0 to 1: linear between battery_charges, beyond them
/// with the last slope.
double open_circuit_V(const Supply& supply, double charge);

/// The highest open-circuit voltage of any source, V.
double highest_open_V(const Supply& supply);
/// The highest open-circuit voltage over a whole run, V. It includes the changes by [[at]], a higher initial
/// bus voltage, and a battery's initial charge.
double highest_open_V(const Scenario& scenario);
/// A bus above this multiple of highest_open_V() counts as raised: it is more than ringing and ripple.
inline constexpr double risen_part = 1.2;

}  // namespace sixstep::study
