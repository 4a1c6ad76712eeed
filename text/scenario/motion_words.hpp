// SPDX-License-Identifier: Apache-2.0
// Handles keys that only a turning motor has, or only a linear one (base/linear.hpp).
#pragma once
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/toml/complaints.hpp"

namespace text {

/// Reports every key of the document that belongs to the other kind of motor, with the key to write instead.
/// `keys`: the keys of this kind of file; the document itself defines its kind of motor.
void refuse_other_motion(const std::vector<KeyEntry>& keys, Complaints& complaints);

/// Converts the keys that [[spread]] names, and their widths, from a linear motor's names to the library's. Keys
/// of the other kind of motor are complained about.
void read_spread_keys(study::Scenario& scenario, Complaints& complaints);

/// Converts the numbers whose unit follows from a mode or a figure to a linear motor's units: position in mm,
/// not deg. A turning motor's scenario is unchanged. Reading returns the same number, to the bit if a double
/// allows it.
void in_units_of_its_motor(study::Scenario& scenario);

}  // namespace text
