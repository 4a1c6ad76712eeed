// SPDX-License-Identifier: Apache-2.0
// Compiles the exported header of a scenario's drive, together with faces/loop/core/, into a program for a core.
#pragma once
#include <string>

#include "faces/loop/cores.hpp"
#include "faces/loop/rooms.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace loop {

/// Returns the path of the image in `folder`. Problems: the header cannot be exported; the compiler is
/// missing or reports an error.
base::Result<std::string> compiled_image(const Core& core, const study::Scenario& scenario,
                                         const std::string& folder);

}  // namespace loop
