// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "sixstep/base/written.hpp"

namespace sixstep::study {

/// A value as a problem names it.
inline std::string number(double v) { return base::rounded(v, 6); }

}  // namespace sixstep::study
