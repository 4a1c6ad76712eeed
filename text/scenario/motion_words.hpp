// SPDX-License-Identifier: Apache-2.0
// Keys that only a turning motor has, or only a linear one (base/linear.hpp).
#pragma once
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/toml/complaints.hpp"

namespace text {

/// Complains about every key of the document that belongs to the other kind of motor, with the word to write in its place.
/// `keys`: those of the document's kind of file; what stands in the document says which kind it is.
void refuse_other_motion(const std::vector<KeyEntry>& keys, Complaints& complaints);

/// [[spread]] names keys: those of a linear motor become the library's, and their widths too. The other kind's are complained
/// about.
void read_spread_keys(study::Scenario& scenario, Complaints& complaints);

/// The scenario with every number whose unit follows from a mode or a figure as a linear motor's file has it: position in mm
/// for deg. A turning motor's stays as it is. Reading gives back the same number, to the bit wherever a double allows it.
void in_units_of_its_motor(study::Scenario& scenario);

}  // namespace text
