// SPDX-License-Identifier: Apache-2.0
// Open voltages of the sources that have none of their own in voltage_V.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Of a battery at a charge, V: lines between battery_charges, the last ones beyond.
double open_circuit_V(const Supply& supply, double charge);

/// The highest that any source stands at without a load, V.
double highest_open_V(const Supply& supply);
/// Of a whole run, V: with the changes of its [[at]], a bus that begins higher, a battery at its charge.
double highest_open_V(const Scenario& scenario);
/// The part of it above which a bus has risen: more than ringing and ripple.
inline constexpr double risen_part = 1.2;

}  // namespace sixstep::study
