// SPDX-License-Identifier: Apache-2.0
// Prints the analysis of a log of Hall lines: for a terminal, as JSON and as TOML.
#pragma once
#include <string>

#include "sixstep/analysis/identification/hall/identify.hpp"
#include "text/rooms.hpp"

namespace text {

/// `name` is the name of the log.
std::string identify_text(const std::string& name, const analysis::HallIdentity& found);

std::string identify_json(const std::string& name, const analysis::HallIdentity& found);

/// TOML: the sensors as in a scenario. Below them, as comments, are the values that a user's own firmware
/// needs.
std::string identify_toml(const std::string& name, const analysis::HallIdentity& found);

}  // namespace text
