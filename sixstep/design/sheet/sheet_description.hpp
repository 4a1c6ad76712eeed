// SPDX-License-Identifier: Apache-2.0
// The keys of a motor file: these descriptions are the only definition of their names, units, frames and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/design/sheet/sheet.hpp"

namespace sixstep::design {

void describe(base::Visitor& v, Sheet& s);

}  // namespace sixstep::design
