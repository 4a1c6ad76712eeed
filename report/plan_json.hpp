// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "report/plan_page.hpp"

namespace report {

/// The JSON that the page's scripts draw.
std::string plan_data(const std::vector<PagePlan>& plans);

}  // namespace report
