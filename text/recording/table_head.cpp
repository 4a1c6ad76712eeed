// SPDX-License-Identifier: Apache-2.0
#include "text/recording/table_head.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "text/keys/bounded.hpp"
#include "text/keys/units.hpp"
#include "text/recording/cells.hpp"
#include "text/recording/heading.hpp"
#include "text/recording/known_names.hpp"

namespace text {
namespace {

using Cells = std::vector<std::string_view>;

/// Longest heading that messages and results quote.
constexpr std::size_t longest_name = 80;

bool is_in_brackets(std::string_view cell) {
  return cell.size() > 1 && (cell.front() == '(' || cell.front() == '[') &&
         (cell.back() == ')' || cell.back() == ']');
}

std::string_view without_brackets(std::string_view cell) {
  return is_in_brackets(cell) ? cell.substr(1, cell.size() - 2) : cell;
}

/// Whether the cells are units below names, as in "Second,Volt" and "(ms),(foo)". Some may be unknown if
/// brackets show that they are units.
bool are_units(const Cells& cells) {
  const auto is_unit = [](std::string_view cell) { return !unit_in_words(cell).empty(); };
  return std::any_of(cells.begin(), cells.end(), is_unit) &&
         std::all_of(cells.begin(), cells.end(), [&](std::string_view cell) {
           return is_unit(cell) || is_in_brackets(cell) || (cell.empty() && cells.size() > 1);
         });
}

/// Whether cells such as "s,foo" below "t,u_ab" are units: at least one cell is a unit below a known name,
/// and no cell is itself a known name. The other cells must then be units.
bool are_units_below(const Cells& names, const Cells& cells) {
  const auto known = [](std::string_view cell) { return is_known_name(bare_name(heading_of(cell).name)); };
  if (std::any_of(cells.begin(), cells.end(), known)) return false;
  for (std::size_t n = 0; n < std::min(names.size(), cells.size()); ++n)
    if (known(names[n]) && unit_in_words(names[n]).empty() && !unit_in_words(cells[n]).empty()) return true;
  return false;
}

/// Joins names and units if blanks separate them, as in "t [s] u_ab [V]".
Cells with_units_joined(const Cells& cells) {
  Cells out;
  for (const std::string_view cell : cells)
    if (!out.empty() && is_in_brackets(cell))
      out.back() = {out.back().data(), static_cast<std::size_t>(cell.end() - out.back().data())};
    else
      out.push_back(cell);
  return out;
}

struct Head {
  Cells names, units;
};

class HeadReader {
 public:
  HeadReader(const LinesAbove& above, std::size_t cells, Recording& out)
      : above_(above), cells_(cells), out_(out) {}

  std::size_t take() {
    find_clock();
    Head head = find_head();
    // Cells with '=' give start and step of the time, and are not columns.
    while (head.names.size() > cells_ && head.names.back().find('=') != std::string_view::npos)
      head.names.pop_back();
    out_.has_headings = !head.names.empty();
    for (std::size_t n = 0; n < std::max(cells_, head.names.size()); ++n)
      out_.columns.push_back(column(head, n));
    name_by_keys();
    name_channels();
    keep_names_apart();
    return head.names.size();
  }

 private:
  Cells cells_of(const std::string& line) const {
    Cells cells = cells_of_line(line, above_.separator);
    cells.erase(cells.begin(),
                cells.begin() + static_cast<std::ptrdiff_t>(std::min(above_.cells_before, cells.size())));
    return cells;
  }

  void find_clock() {
    for (const auto* lines : {&above_.lines, &above_.remarks})
      for (const std::string& line : *lines)
        if (!out_.clock) out_.clock = clock_in(line, above_.separator);
  }

  /// The last lines above the rows: the headings, and a line of units if there is one below them.
  Head find_head() {
    Head head;
    const std::vector<std::string>& lines = above_.lines;
    if (above_.cells_before > 1) return head;  // such lines also contain rows
    if (lines.size() > 1) {
      const Cells names = cells_of(lines[lines.size() - 2]), below = cells_of(lines.back());
      if (const std::optional<RowClock> clock = clock_below(names, below)) {
        out_.clock = clock;
        head = {names, below};
        // Start and Increment are the headings of no column.
        head.names.resize(std::min(cells_, names.size()));
        for (std::string_view& unit : head.units)
          if (unit_in_words(unit).empty()) unit = {};
        return head;
      }
    }
    for (std::size_t n = lines.size(); n-- > 0 && head.names.empty();) {
      Cells cells = cells_of(lines[n]);
      if (above_.separator == ' ' && cells.size() > cells_) cells = with_units_joined(cells);
      const bool below = n > 0 && are_units_below(cells_of(lines[n - 1]), cells);
      if (head.units.empty() && (are_units(cells) || below))
        head.units = std::move(cells);
      else if (cells.size() > 1 || (cells_ == 1 && !cells.empty()))
        head.names = std::move(cells);
      else
        break;
    }
    if (head.names.empty())
      head.names = std::exchange(head.units, {});  // for "s,V": the cells may be units without names, or
                                                   // names that look like units
    if (head.units.empty()) head.units = units_by_keys();
    return head;
  }

  /// The units that Tektronix writes above the headings: "Horizontal Units,s" and "Vertical Units,V,V".
  Cells units_by_keys() const {
    Cells units;
    for (const std::string& line : above_.lines) {
      const Cells cells = cells_of(line);
      if (cells.size() < 2) continue;
      const std::string key = bare_name(cells[0]);
      if (key != "horizontalunits" && key != "verticalunits") continue;
      const std::size_t first = key == "horizontalunits" ? 0 : 1, last = first == 0 ? 1 : cells.size() - 1;
      if (units.size() < last + first) units.resize(last + first);
      for (std::size_t n = 0; n < last; ++n) units[first + n] = cells[1 + n];
    }
    return units;
  }

  RecordedColumn column(const Head& head, std::size_t n) const {
    RecordedColumn out;
    if (n < head.names.size()) {
      Heading heading = heading_of(head.names[n]);
      out.heading = bounded(std::string(head.names[n]), longest_name);
      out.name = bounded(std::move(heading.name), longest_name);
      out.unit = std::move(heading.unit);
      out.odd_unit = bounded(std::move(heading.odd_unit), longest_name);
      out.letter = heading.letter;
    }
    if (n < head.units.size() && !head.units[n].empty() && head.units[n] != "-") {
      const std::string named = out.letter ? std::string() : out.unit;
      out.unit = unit_in_words(head.units[n]);
      if (out.unit.empty())
        out.odd_unit = bounded(std::string(without_brackets(head.units[n])), longest_name);
      else if (!named.empty() && named != out.unit)
        out.odd_unit = bounded(named + " and " + out.unit, longest_name);
      out.letter = false;
    }
    const bool is_time = !out.unit.empty() && same_kind(*unit_of(out.unit), *unit_of("s"));
    if (out.name.empty()) out.name = is_time && n == 0 ? "time" : fmt::format("column {}", n + 1);
    return out;
  }

  /// Names columns without headings: Tektronix writes "Source,CH1" and "Vertical Units,V" next to the rows.
  void name_by_keys() {
    if (above_.cells_before < 2 || out_.has_headings || out_.columns.size() < 2) return;
    std::map<std::string, std::string> values;
    for (const std::string& line : above_.lines)
      if (const Cells cells = cells_of_line(line, above_.separator); cells.size() > 1)
        values.emplace(bare_name(cells[0]), cells[1]);
    RecordedColumn &time = out_.columns[0], &voltage = out_.columns[1];
    const auto unit = [&](const char* key, RecordedColumn& of) {
      if (values[key].empty()) return;
      of.unit = unit_in_words(values[key]);
      if (of.unit.empty()) of.odd_unit = bounded(values[key], longest_name);
    };
    unit("horizontalunits", time);
    unit("verticalunits", voltage);
    if (!values["source"].empty()) voltage.heading = voltage.name = bounded(values["source"], longest_name);
    time.heading = time.name = "time";
  }

  /// Names channels: sigrok heads all lines "logic" and lists their names above.
  void name_channels() {
    std::vector<RecordedColumn*> lines;
    for (RecordedColumn& column : out_.columns)
      if (bare_name(column.heading) == "logic") lines.push_back(&column);
    for (const std::string& line : above_.lines)
      if (const std::vector<std::string> channels = channels_in(line);
          !lines.empty() && channels.size() == lines.size())
        for (std::size_t n = 0; n < lines.size(); ++n) lines[n]->name = bounded(channels[n], longest_name);
  }

  void keep_names_apart() {
    std::map<std::string, std::size_t> seen;
    for (RecordedColumn& column : out_.columns) column.bare = bare_name(column.name);
    for (std::size_t n = 0; n < out_.columns.size(); ++n)
      if (++seen[out_.columns[n].name] > 1) out_.columns[n].name += fmt::format(" (column {})", n + 1);
  }

  const LinesAbove& above_;
  std::size_t cells_;
  Recording& out_;
};

}  // namespace

std::size_t take_head(const LinesAbove& above, std::size_t cells, Recording& out) {
  return HeadReader(above, cells, out).take();
}

}  // namespace text
