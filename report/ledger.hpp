// SPDX-License-Identifier: Apache-2.0
// Where the energy went, and how often what happened.
#pragma once
#include <string>

#include "sixstep/study/measure/outcome.hpp"

namespace report {

std::string energy_section(const sixstep::study::EnergyBook& book);
std::string event_section(const sixstep::study::Outcome& outcome);

}  // namespace report
