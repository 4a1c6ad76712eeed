// SPDX-License-Identifier: Apache-2.0
// What went wrong, as a value: the library never throws and never terminates.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace sixstep::base {

/// One mistake, told so that the reader alone can mend it.
struct Problem {
  std::string where{};  ///< the key or place, e.g. "supply.voltage_V"; text adds file, line and column
  std::string value{};  ///< what stood there, as written; empty where nothing did
  std::string limit{};  ///< what is allowed or what rule is broken, as a clause: "must be above 0"
  std::string cure{};   ///< what to do: "give the bus voltage in volts"

  bool operator==(const Problem&) const = default;
};

using Problems = std::vector<Problem>;

/// All that is wrong is told at once.
inline void append(Problems& to, const Problems& more) { to.insert(to.end(), more.begin(), more.end()); }

/// "supply.voltage_V = -3 must be above 0; give the bus voltage in volts"
inline std::string to_string(const Problem& p) {
  std::string text = p.where;
  if (!p.value.empty()) text += " = " + p.value;
  if (!p.limit.empty()) text += (text.empty() ? "" : " ") + p.limit;
  if (!p.cure.empty()) text += "; " + p.cure;
  return text;
}

}  // namespace sixstep::base
