// SPDX-License-Identifier: Apache-2.0
#include "text/escape/csv_cell.hpp"

#include <algorithm>
#include <iterator>

#include "text/escape/escape.hpp"

namespace text {

std::string cell_name(std::string_view text) {
  std::string out = visible(text);
  const std::string_view name =
      std::string_view(out).substr(std::min(out.find_first_not_of(' '), out.size()));
  // Some spreadsheets treat the full-width forms of = + - @ like the usual characters.
  constexpr std::string_view begins[] = {"=", "+", "-", "@", "\uff1d", "\uff0b", "\uff0d", "\uff20"};
  if (std::any_of(std::begin(begins), std::end(begins), [&](auto sign) { return name.starts_with(sign); }))
    out.insert(0, 1, '\'');
  return out;
}

std::string csv_cell(std::string_view text) {
  std::string name = cell_name(text);
  if (name.find_first_of(",;\"") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace text
