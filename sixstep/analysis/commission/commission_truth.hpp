// SPDX-License-Identifier: Apache-2.0
// Computes from a plant's parameters the values that commissioning must find.
#pragma once
#include "sixstep/analysis/commission/commission_bench.hpp"

namespace sixstep::analysis {

/// `in_diode`: fraction of a period in which a leg's current flows through a diode, because of the dead time.
CommissionTruth truth_of(const study::GeneralPlant& plant, double in_diode);

/// The peak of the fundamental of a phase's back-EMF, divided by the electrical speed, V s.
double flux_linkage_of(const plant::general::Machine& machine);

}  // namespace sixstep::analysis
