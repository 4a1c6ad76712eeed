// SPDX-License-Identifier: Apache-2.0
// Writes the energy balance of a run and the counts of its events.
#pragma once
#include <string>

#include "sixstep/base/linear.hpp"
#include "sixstep/study/measure/outcome.hpp"

namespace report {

/// Properties of the drive that change the terms of the book. The energies of an elastic shaft's twist and of
/// cogging count as kinetic. For a delta, losses and field energy are computed for the branches, whose currents
/// may flow while all terminal currents are zero.
struct BookOf {
  bool twist = false, cogging = false, delta = false;
};
/// The section with the energies, in the symbols of the motor's kind.
std::string energy_section(const sixstep::study::EnergyBook& book, const sixstep::base::Motion& motion,
                           BookOf drive);
/// The losses of each switch and diode as a table; empty if the bridge's data do not suffice.
std::string device_section(const std::vector<sixstep::study::DeviceLoss>& devices);

std::string event_section(const sixstep::study::Outcome& outcome);

}  // namespace report
