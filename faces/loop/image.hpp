// SPDX-License-Identifier: Apache-2.0
// A scenario's drive as a program for a core: its exported header, compiled with faces/loop/core/.
#pragma once
#include <string>

#include "faces/loop/cores.hpp"
#include "faces/loop/rooms.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace loop {

/// The image's path in `folder`. Problems: what no header can be made of; a compiler that is missing or complains.
base::Result<std::string> compiled_image(const Core& core, const study::Scenario& scenario,
                                         const std::string& folder);

}  // namespace loop
