// SPDX-License-Identifier: Apache-2.0
// The closed-form part of a design in text: what needs no run.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/linear.hpp"
#include "sixstep/design/loops/drive_design.hpp"
#include "text/rooms.hpp"

namespace text {

/// "per rad/s", of a linear motor "per m/s".
std::string gain_unit(const design::LoopDesign& loop, const base::Motion& motion);

/// A loop's derivation and gains.
std::string loop_text(const design::LoopDesign& loop, const base::Motion& motion);

/// Margins and steps of all loops, side by side.
std::string figures_text(const design::DriveDesign& design);

/// What the sensor of the speed costs, and what each way of sensing allows.
std::string sensing_text(const design::DriveDesign& design);

/// What a drive without a rotor sensor comes to; empty for one that has such a sensor.
std::string sensorless_text(const std::vector<sixstep::design::DerivationStep>& steps);

/// Ripple, voltage left, braking, period.
std::string limits_text(const design::DriveDesign& design);

}  // namespace text
