// SPDX-License-Identifier: Apache-2.0
#include "text/recording/column_formula.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "sixstep/base/angle.hpp"
#include "text/keys/bounded.hpp"
#include "text/keys/decimal_number.hpp"
#include "text/recording/cells.hpp"

namespace text {
namespace {

std::optional<double> constant_in(std::string_view word) {
  word = bare_cell(word);
  if (word == "pi") return base::pi;
  return number_alone(word);
}

/// Moves constants such as "/60" and "*pi" from the end of the text into the formula, as long as there are
/// any.
void take_behind(std::string_view& rest, ColumnFormula& out) {
  for (std::size_t cut = rest.find_last_of("*/"); cut != std::string_view::npos;
       cut = rest.find_last_of("*/")) {
    const std::optional<double> constant = constant_in(rest.substr(cut + 1));
    if (!constant) return;
    out.factor = rest[cut] == '*' ? out.factor * *constant : out.factor / *constant;
    out.scaled = true;
    rest = rest.substr(0, cut);
  }
}

/// Moves constants such as "2*pi*" from the beginning of the text into the formula; a minus there changes the
/// sign.
void take_before(std::string_view& rest, ColumnFormula& out) {
  if (rest.starts_with('-')) {
    out.factor = -out.factor;
    rest.remove_prefix(1);
  }
  for (std::size_t cut = rest.find('*'); cut != std::string_view::npos; cut = rest.find('*')) {
    const std::optional<double> constant = constant_in(rest.substr(0, cut));
    if (!constant) return;
    out.factor *= *constant;
    out.scaled = true;
    rest = rest.substr(cut + 1);
  }
}

/// The position of a * or / without a constant at either end: in "erpm*", in "*erpm", and in "erpm**2" after
/// its 2 has been removed.
std::optional<std::size_t> operator_without_constant(std::string_view text, std::string_view column) {
  if (column.empty()) return {};
  const auto place = static_cast<std::size_t>(column.data() - text.data());
  const std::size_t last = column.size() - 1;
  for (const std::size_t end : {last, std::size_t{0}})
    if (column[end] == '*' || column[end] == '/') return place + end;
  return {};
}

base::Problem broken_formula(std::string_view text, std::size_t place) {
  return bounded({.where = "columns",
                  .value = std::string(text),
                  .limit = fmt::format("lacks a constant or a column beside the {} at character {}",
                                       text[place], place + 1),
                  .cure = "remove this sign, or write the constant, for example speed=erpm*2*pi/60/7"});
}

}  // namespace

base::Result<ColumnFormula> column_formula(std::string_view text) {
  const std::size_t equals = text.find('=');
  ColumnFormula out;
  if (equals != std::string_view::npos) {
    out.name = bare_cell(text.substr(0, equals));
    std::string_view rest = bare_cell(text.substr(equals + 1));
    take_behind(rest, out);
    take_before(rest, out);
    rest = bare_cell(rest);
    if (const auto place = operator_without_constant(text, rest)) return broken_formula(text, *place);
    out.column = rest;
  }
  const bool is_finite = std::isfinite(out.factor) && out.factor != 0.0;
  if (!out.name.empty() && !out.column.empty() && is_finite) return out;
  return bounded({.where = "columns",
                  .value = std::string(text),
                  .limit = is_finite ? "must be NAME=COLUMN, with or without constants behind the column"
                                     : "has constants whose product is 0 or not finite",
                  .cure = "write for example time=ms_today/1000 or speed=erpm*2*pi/60/7"});
}

}  // namespace text
