// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "text/results/curve_columns.hpp"

namespace text {

/// The curve as JSON: bench, ideal line, no-load and nominal point, thermal limits, and every point with all
/// columns. Numbers that do not exist, or are not finite, are null.
std::string curve_json(const analysis::CurveRequest& request, const analysis::Curve& curve);

}  // namespace text
