// SPDX-License-Identifier: Apache-2.0
#include "text/recording/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "text/keys/bounded.hpp"
#include "text/recording/encoding.hpp"
#include "text/recording/row_reader.hpp"

namespace text {
namespace {

base::Problem of_file(const std::string& name, const char* limit, const char* cure) {
  return {.where = name + ":", .value = "", .limit = limit, .cure = cure};
}

base::Result<Recording> read_lines(const std::string& name, std::string_view text, std::size_t line,
                                   std::optional<RowsBeside> beside) {
  RowReader reader(name, line, beside);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (!reader.line(text.substr(0, end))) break;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return reader.result();
}

bool begins_with_letter(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\"");
  return first != std::string_view::npos && std::isalpha(static_cast<unsigned char>(line[first])) != 0;
}

bool begins_with_number(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\"+-.");
  return first != std::string_view::npos && std::isdigit(static_cast<unsigned char>(line[first])) != 0;
}

/// The offset at which the board's last start begins: the offset of the last line of words that follows rows.
std::size_t last_start(std::string_view text) {
  std::size_t from = 0;
  bool in_rows = false;
  for (std::size_t at = 0; at < text.size(); at = std::min(text.find('\n', at), text.size() - 1) + 1) {
    const std::string_view line = text.substr(at, text.find('\n', at) - at);
    if (begins_with_letter(line) && in_rows) from = at;
    if (begins_with_letter(line) || begins_with_number(line)) in_rows = begins_with_number(line);
  }
  return from;
}

std::size_t lines_in(std::string_view text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// The complete part of a board's log, and the omitted text.
struct WholeRows {
  std::string_view text;
  std::size_t lines_before = 0;
  Notes notes;
};
WholeRows from_last_start(std::string_view text) {
  WholeRows out;
  const std::size_t end = text.rfind('\n');
  const bool cut = end != std::string_view::npos && end + 1 < text.size();
  // The last row of a cut log is removed, unless it is the only row.
  if (cut && begins_with_number(text.substr(text.rfind('\n', end - 1) + 1))) {
    text = text.substr(0, end + 1);
    out.notes.push_back(fmt::format(
        "the last line, {}, has no line break: it may be incomplete and is not used", lines_in(text) + 1));
  }
  const std::size_t from = last_start(text);
  out.lines_before = lines_in(text.substr(0, from));
  if (from > 0)
    out.notes.push_back(
        fmt::format("begins again in line {}: only the rows from there on are used", out.lines_before + 1));
  out.text = text.substr(from);
  return out;
}

}  // namespace

std::size_t Recording::line_of(std::size_t row) const {
  const auto next = std::upper_bound(lines.begin(), lines.end(), row,
                                     [](std::size_t r, const auto& entry) { return r < entry.first; });
  if (next == lines.begin()) return 0;
  return std::prev(next)->second + (row - std::prev(next)->first);
}

base::Problem of_recording(const Recording& recording, std::string limit, std::string cure) {
  return bounded(
      {.where = recording.name + ":", .value = "", .limit = std::move(limit), .cure = std::move(cure)});
}

base::Result<Recording> read_recording(const std::string& name, std::string_view bytes, RowsFrom from) {
  const std::optional<std::string> plain = plain_text(bytes);
  if (!plain)
    return of_file(name, "is not a text file", "export the recording as CSV, or unpack a .gz with gzip -d");
  if (plain->find_first_not_of(" \t\n") == std::string::npos)
    return of_file(name, "is empty", "export the recording again: headings, then rows of numbers");
  WholeRows rows{.text = *plain, .lines_before = 0, .notes = {}};
  if (from == RowsFrom::last_start) rows = from_last_start(*plain);
  base::Result<Recording> found = read_lines(name, rows.text, rows.lines_before, {});
  if (!found)
    if (const std::optional<RowsBeside> beside = rows_beside(rows.text))
      found = read_lines(name, rows.text, rows.lines_before, beside);
  if (found) found->notes = std::move(rows.notes);
  return found;
}

}  // namespace text
