// SPDX-License-Identifier: Apache-2.0
// The design of a linear motor is computed as that of the turning one (base/linear.hpp), and told in metres and newtons.
#pragma once
#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// What a design scenario says in words: title, sources of its figures, names of its columns.
void say_in_metres(study::Scenario& scenario);

/// Derivation steps, warnings and tolerances of a design in the words, symbols and units of a linear motor. The other numbers
/// stay those of the turning one: whoever shows them asks design::motion_of() for the unit. A turning motor's study stays as it is.
void tell_in_metres(DesignStudy& study);

/// Problems that name members of the turning motor's spec.
base::Problems told_in_metres(base::Problems problems);

}  // namespace sixstep::analysis
