// SPDX-License-Identifier: Apache-2.0
#include "text/recording/board_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "sixstep/study/measure/columns.hpp"
#include "text/keys/units.hpp"
#include "text/recording/recording.hpp"

namespace text {
namespace {

bool begins_with_letter(std::string_view line) {
  return !line.empty() && std::isalpha(static_cast<unsigned char>(line.front())) != 0;
}

/// From the last line of headings to the last line that is whole.
std::string_view last_start(std::string_view text) {
  if (const std::size_t end = text.rfind('\n'); end != std::string_view::npos) text = text.substr(0, end + 1);
  std::size_t from = 0;
  for (std::size_t at = 0; at < text.size(); at = std::min(text.find('\n', at), text.size() - 1) + 1)
    if (begins_with_letter(text.substr(at))) from = at;
  return text.substr(from);
}

/// "i_m" of i_m_A, as a log's heading has it.
std::string bare_column(const study::Column& column) {
  std::string unit = "_" + column.unit;
  std::replace(unit.begin(), unit.end(), '/', '_');
  std::string_view name = column.name;
  if (name.ends_with(unit)) name.remove_suffix(unit.size());
  return bare_name(name);
}

bool fits(const RecordedColumn& recorded, const study::Column& column) {
  const std::optional<Unit> a = unit_of(recorded.unit), b = unit_of(column.unit);
  return recorded.unit.empty() || (a && b && same_kind(*a, *b));
}

/// Null: no trace has it. Of two of one name, as the bus's voltage and current, the one that the unit fits.
const study::Column* column_of(const RecordedColumn& recorded) {
  const study::Column* found = nullptr;
  for (const study::Column& column : study::all_columns()) {
    const std::string name = bare_name(recorded.name);
    if (name != bare_column(column) && name != bare_name(column.name)) continue;
    if (fits(recorded, column)) return &column;
    if (found == nullptr) found = &column;
  }
  return found;
}

base::Problems add_columns(const Recording& recording, study::Trace& out) {
  base::Problems problems;
  for (const RecordedColumn& recorded : recording.columns) {
    const study::Column* const column = column_of(recorded);
    if (column == nullptr || column->name == out.columns.front().name) continue;
    base::Result<std::vector<double>> values =
        values_of(recording, recorded, column->unit == "1" ? "" : column->unit);
    if (!values) {
      problems.insert(problems.end(), values.problems().begin(), values.problems().end());
      continue;
    }
    out.columns.push_back(*column);
    out.values.push_back(std::move(*values));
  }
  return problems;
}

base::Problem too_short(const std::string& name, std::string limit) {
  return {name + ":", "", std::move(limit), "log for longer, and end the last line"};
}

}  // namespace

base::Result<study::Trace> read_board_log(const std::string& name, std::string_view text) {
  const std::string_view whole_lines = last_start(text);
  const base::Result<Recording> recording = read_recording(name, whole_lines);
  // The last line of a board that was pulled off may be a part of one.
  const bool short_of_rows = !recording || recording->rows() < 2;
  if (short_of_rows && !text.ends_with('\n') && static_cast<bool>(read_recording(name, text)))
    return too_short(name, "has not two rows whose line has ended");
  if (!recording) return recording.problems();
  if (recording->rows() < 2)
    return too_short(name, "has one row, and when it was sent is found by how a log moves");
  base::Result<std::vector<double>> times = times_of(*recording, {});
  if (!times) return times.problems();
  study::Trace out{.columns = {study::all_columns().front()}, .values = {std::move(*times)}};
  if (base::Problems problems = add_columns(*recording, out); !problems.empty()) return problems;
  if (out.columns.size() < 2)
    return base::Problem{
        name + ":", headings_of(*recording), "has no column that a simulation has",
        "head the columns as a trace names them: t [us], i_m [mA], duty, speed [rad/s], hall"};
  return out;
}

}  // namespace text
