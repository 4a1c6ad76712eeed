// SPDX-License-Identifier: Apache-2.0
// What a log of Hall lines says, for a terminal, for programs and for a file.
#pragma once
#include <string>

#include "sixstep/analysis/identification/hall/identify.hpp"
#include "text/rooms.hpp"

namespace text {

/// `name` is the log's.
std::string identify_text(const std::string& name, const analysis::HallIdentity& found);

std::string identify_json(const std::string& name, const analysis::HallIdentity& found);

/// TOML: the sensors as a scenario has them, and below as remarks what a person's own firmware needs.
std::string identify_toml(const std::string& name, const analysis::HallIdentity& found);

}  // namespace text
