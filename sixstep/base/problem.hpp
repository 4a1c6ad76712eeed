// SPDX-License-Identifier: Apache-2.0
// Errors as values: the library never throws and never terminates.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace sixstep::base {

/// One error, described so that the user can correct it without further help.
struct Problem {
  std::string where{};  ///< the key or location, e.g. "supply.voltage_V"; readers add file, line and column
  std::string value{};  ///< the wrong value as written; empty if there is none
  std::string limit{};  ///< the allowed values or the broken rule, as a clause: "must be above 0"
  std::string cure{};   ///< the remedy: "give the bus voltage in volts"

  bool operator==(const Problem&) const = default;
};

using Problems = std::vector<Problem>;

/// Appends problems to `to`, because the user receives all problems at once.
inline void append(Problems& to, const Problems& more) { to.insert(to.end(), more.begin(), more.end()); }

/// The problem as one sentence: "supply.voltage_V = -3 must be above 0; give the bus voltage in volts"
inline std::string to_string(const Problem& p) {
  std::string text = p.where;
  if (!p.value.empty()) text += " = " + p.value;
  if (!p.limit.empty()) text += (text.empty() ? "" : " ") + p.limit;
  if (!p.cure.empty()) text += "; " + p.cure;
  return text;
}

}  // namespace sixstep::base
