// SPDX-License-Identifier: Apache-2.0
// Open voltages of the sources that have none of their own in voltage_V.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Of a battery at a charge, V: lines between battery_charges, the last ones beyond.
double open_circuit_V(const Supply& supply, double charge);

/// The highest that any source stands at without a load, V.
double highest_open_V(const Supply& supply);

}  // namespace sixstep::study
