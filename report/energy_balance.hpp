// SPDX-License-Identifier: Apache-2.0
// Where the energy went, and how often what happened.
#pragma once
#include <string>

#include "sixstep/base/linear.hpp"
#include "sixstep/study/measure/outcome.hpp"

namespace report {

/// What the book counts to the kinetic energy: of an elastic shaft its twist, and what cogging holds.
struct StoredBeside {
  bool twist = false, cogging = false;
};
/// In the symbols of the motor's kind.
std::string energy_section(const sixstep::study::EnergyBook& book, const sixstep::base::Motion& motion,
                           StoredBeside beside);
/// What each switch and diode lost, as a table; nothing where the bridge does not say enough.
std::string device_section(const std::vector<sixstep::study::DeviceLoss>& devices);

std::string event_section(const sixstep::study::Outcome& outcome);

}  // namespace report
