// SPDX-License-Identifier: Apache-2.0
// Prints the closed-form part of a design, which needs no run.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/linear.hpp"
#include "sixstep/design/loops/drive_design.hpp"
#include "text/rooms.hpp"

namespace text {

/// "per rad/s", for a linear motor "per m/s".
std::string gain_unit(std::string_view loop, const base::Motion& motion);

/// A loop's derivation and gains.
std::string loop_text(const design::LoopDesign& loop, const base::Motion& motion);

/// Text about the cost of each wrong belief. Empty if there is none.
std::string beliefs_text(const std::vector<std::string>& costs);

/// Margins and step responses of all loops, side by side.
std::string figures_text(const design::DriveDesign& design);

/// The derivation of the speed sensor's delay, and the fastest settling time with each way of sensing.
std::string sensing_text(const design::DriveDesign& design);

/// The design of a drive without a rotor position sensor; empty for a drive with a sensor.
std::string sensorless_text(const std::vector<sixstep::design::DerivationStep>& steps);

/// Limits of the design: ripple, remaining voltage, braking, period.
std::string limits_text(const design::DriveDesign& design, const design::Sheet& sheet);

}  // namespace text
