// SPDX-License-Identifier: Apache-2.0
#include "text/recording/board_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "text/keys/bounded.hpp"

namespace text {
namespace {

bool is_headed(const RecordedColumn& column, std::initializer_list<std::string_view> names) {
  return column.has_numbers() && std::find(names.begin(), names.end(), column.bare) != names.end();
}

bool counts_missed(const RecordedColumn& column) {
  return is_headed(column, {"missed", "missedperiods", "periodsmissed"});
}

bool holds_faults(const RecordedColumn& column) { return is_headed(column, {"faults", "fault"}); }

std::string rows_say(std::size_t rows) { return rows == 1 ? "1 row says" : fmt::format("{} rows say", rows); }

/// The rows in which a column's number is above 0.
struct Marked {
  std::size_t rows = 0, first = 0;
  double most = 0.0;
};
Marked marked(const RecordedColumn& column) {
  Marked out;
  for (std::size_t n = 0; n < column.values.size(); ++n) {
    if (!(column.values[n] > 0.0)) continue;
    if (out.rows++ == 0) out.first = n;
    out.most = std::max(out.most, column.values[n]);
  }
  return out;
}

std::string remark_words(const Remark& remark) {
  if (remark.times == 1) return fmt::format("line {} says \"{}\"", remark.line, remark.text);
  return fmt::format("line {} says \"{}\", and {} more {} the same", remark.line, remark.text,
                     remark.times - 1, remark.times == 2 ? "line says" : "lines say");
}

}  // namespace

bool is_the_boards_word(const RecordedColumn& column) {
  return counts_missed(column) || holds_faults(column);
}

Notes what_the_board_says(const Recording& recording) {
  Notes out;
  for (const Remark& remark : recording.remarks) out.push_back(remark_words(remark));
  if (recording.remarks.size() == most_remarks) out.push_back("later remarks are not shown");
  for (const RecordedColumn& column : recording.columns) {
    if (!is_the_boards_word(column)) continue;
    const Marked found = marked(column);
    if (found.rows == 0) continue;
    if (counts_missed(column))
      out.push_back(
          fmt::format("{} that the board missed up to {:g} control periods: the values in such rows are late",
                      rows_say(found.rows), found.most));
    else
      out.push_back(fmt::format("{} that the board had a fault, at first {} {:g} in line {}",
                                rows_say(found.rows), column.name, column.values[found.first],
                                recording.line_of(found.first)));
  }
  return out;
}

}  // namespace text
