// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/design_arguments.hpp"
#include "faces/cli/exit_code.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace cli {

/// `sixstep design --scenario` for a field-oriented drive: the loops with the gains that the run uses.
Exit design_field(const DesignArguments& arguments, const study::Scenario& scenario);

}  // namespace cli
