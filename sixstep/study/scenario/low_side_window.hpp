// SPDX-License-Identifier: Apache-2.0
// The window of low-side shunts: duties and modulation up to which their samples show the currents.
#pragma once
#include <optional>
#include <string>

#include "sixstep/control/low_side.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Shunts and the duties at which their samples count, by settling, dead time, delay and least on-time. Without
/// low-side shunts the default.
control::LowSideConfig<double> low_side_of(const Scenario& scenario);

/// Modulation of a field-oriented drive, phase amplitude over U_s/sqrt 3, up to which two legs are shown at every
/// angle of the voltage; at most 1. Empty for other drives, and for a law without pulses.
std::optional<double> greatest_modulation(const Scenario& scenario);

/// The keys that bound the window, with their values in us: "sensors.shunt_settle_s = 1 us".
std::string window_keys(const Scenario& scenario);

}  // namespace sixstep::study
