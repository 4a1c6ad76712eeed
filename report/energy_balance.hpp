// SPDX-License-Identifier: Apache-2.0
// Writes the energy balance of a run and the counts of its events.
#pragma once
#include <string>

#include "sixstep/base/linear.hpp"
#include "sixstep/study/measure/outcome.hpp"

namespace report {

/// Energies that the book counts as kinetic although they are not: the energy of a twisted elastic shaft, and
/// that of cogging.
struct StoredBeside {
  bool twist = false, cogging = false;
};
/// The section with the energies, in the symbols of the motor's kind.
std::string energy_section(const sixstep::study::EnergyBook& book, const sixstep::base::Motion& motion,
                           StoredBeside beside);
/// The losses of each switch and diode as a table; empty if the bridge has too few values for them.
std::string device_section(const std::vector<sixstep::study::DeviceLoss>& devices);

std::string event_section(const sixstep::study::Outcome& outcome);

}  // namespace report
