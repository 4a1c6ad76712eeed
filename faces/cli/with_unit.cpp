// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/with_unit.hpp"

#include <fmt/format.h>

#include <utility>

#include "text/keys/units.hpp"

namespace cli {

CLI::Option* take_unit(CLI::Option* option, std::string unit) {
  const auto converted = [unit = std::move(unit)](const std::string& typed) {
    const auto parts = text::split_number(typed);
    if (!parts || parts->unit.empty()) return typed;
    const base::Result<double> value = text::in_unit(typed, unit);
    return value ? fmt::format("{}", *value) : typed;
  };
  return option->transform(converted, "");
}

}  // namespace cli
