// SPDX-License-Identifier: Apache-2.0
// Handles keys that only rotary motors or only linear motors have (base/linear.hpp).
#pragma once
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/toml/complaints.hpp"

namespace text {

/// Reports every key of the document that belongs to the other kind of motor, with the key to write instead.
/// `keys`: all keys of this kind of file. The document states which kind of motor it has.
void refuse_other_motion(const std::vector<KeyEntry>& keys, Complaints& complaints);

/// Converts the keys that [[spread]] names, and their widths, from a linear motor's names and units to the
/// library's names and units. Reports keys of the other kind of motor.
void read_spread_keys(study::Scenario& scenario, Complaints& complaints);

/// Converts the numbers whose unit follows from a mode or a figure to a linear motor's units: a position to
/// mm, not to deg. A rotary motor's scenario is unchanged. Reading converts back to the same number, to the
/// bit if such a double exists.
void in_units_of_its_motor(study::Scenario& scenario);

}  // namespace text
