// SPDX-License-Identifier: Apache-2.0
// Writes a designed loop as JSON, for every kind of drive.
#pragma once
#include <nlohmann/json.hpp>

#include <vector>

#include "sixstep/design/loops/drive_design.hpp"
#include "text/rooms.hpp"

namespace text {

nlohmann::ordered_json steps_json(const std::vector<sixstep::design::DerivationStep>& steps);

/// The JSON contains gains, derivation, open loop, margins with both delays, Bode data and step data.
nlohmann::ordered_json loop_json(const sixstep::design::LoopDesign& loop,
                                 const sixstep::design::DriveDesign& design);

}  // namespace text
