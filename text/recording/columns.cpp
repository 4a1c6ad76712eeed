// SPDX-License-Identifier: Apache-2.0
#include "text/recording/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "text/keys/bounded.hpp"
#include "text/keys/key_advice.hpp"
#include "text/recording/heading.hpp"

namespace text {
namespace {

/// The positions of columns in words: "column 2 or column 4".
std::string places_of(const Recording& r, const std::vector<const RecordedColumn*>& columns) {
  std::string out;
  for (std::size_t n = 0; n < columns.size(); ++n)
    out += fmt::format("{}column {}",
                       n == 0                   ? ""
                       : n + 1 < columns.size() ? ", "
                                                : " or ",
                       columns[n] - r.columns.data() + 1);
  return out;
}

base::Problem several(const Recording& r, std::string_view heading,
                      const std::vector<const RecordedColumn*>& columns) {
  return of_recording(r, fmt::format("has {} columns \"{}\"", columns.size(), heading),
                      "name one column by its number: " + places_of(r, columns));
}

std::vector<const RecordedColumn*> columns_like(const Recording& r, const std::string& heading) {
  std::vector<const RecordedColumn*> exact, alike;
  const std::string bare = bare_name(heading);
  for (const RecordedColumn& column : r.columns) {
    if (column.name == heading || column.heading == heading) exact.push_back(&column);
    if (!bare.empty() && (column.bare == bare || bare_name(column.heading) == bare)) alike.push_back(&column);
  }
  if (exact.empty()) exact = std::move(alike);
  for (std::size_t n = 0; exact.empty() && n < r.columns.size(); ++n)
    if (bare == fmt::format("column{}", n + 1)) exact.push_back(&r.columns[n]);
  return exact;
}

base::Problem none_called(const Recording& r, const std::string& heading) {
  std::vector<std::string> known;
  for (const RecordedColumn& column : r.columns) known.push_back(column.name);
  const std::string near = nearest(heading, known);
  return of_recording(r, fmt::format("has no column \"{}\"", bounded(heading, 200)),
                      near.empty() ? "it has " + headings_of(r) : fmt::format("did you mean \"{}\"?", near));
}

/// Whether the apparent unit is part of the name: a letter after the name of a voltage is a phase, as in
/// "phase_A" and "hall_C". V and s are always units.
bool is_part_of_name(const Picked& picked, const Wanted& wanted) {
  return wanted.unit == "V" && picked.column->letter && picked.unit != "V" && picked.unit != "s";
}

/// Converts from the column's unit. The values already contain the unit's power of ten.
base::Result<Conversion> conversion_of(const Recording& r, const Picked& picked, const Wanted& wanted) {
  const std::string belongs = wanted.unit.empty() ? "a plain number" : wanted.unit;
  const RecordedColumn& column = *picked.column;
  if (!column.odd_unit.empty())
    return of_recording(r,
                        fmt::format("has the heading {} in \"{}\", which is not a unit; {} is expected",
                                    column.name, column.odd_unit, belongs),
                        wanted.unit.empty() ? "write the heading without a unit"
                                            : "units that fit: " + units_that_fit(wanted.unit));
  if (picked.unit.empty()) return Conversion{};
  base::Result<Conversion> found = conversion(picked.unit, wanted);
  if (!found)
    return of_recording(
        r, fmt::format("has the heading {} in {}, but {} is expected", column.name, picked.unit, belongs),
        wanted.unit.empty() ? "name another column" : "name another column; " + found.problems()[0].cure);
  found->ten -= unit_of(picked.unit)->ten;
  return found;
}

bool is_one_of(std::string_view bare, std::span<const std::string_view> names) {
  return std::find(names.begin(), names.end(), bare) != names.end();
}

/// Compares the name including the apparent unit: "u_a" does not mean u in amperes.
bool is_called_as_a_whole(const RecordedColumn& column, std::span<const std::string_view> names) {
  return (column.unit.empty() || column.letter) && is_one_of(bare_name(column.heading), names);
}

}  // namespace

bool is_called(const RecordedColumn& column, std::span<const std::string_view> names) {
  return is_called_as_a_whole(column, names) || is_one_of(column.bare, names);
}

base::Result<Picked> find_column(const Recording& recording, std::span<const std::string_view> names) {
  Picked found;
  std::vector<const RecordedColumn*> all;
  for (const RecordedColumn& column : recording.columns) {
    if (!is_called(column, names)) continue;
    if (all.empty()) found = {&column, is_called_as_a_whole(column, names) ? std::string() : column.unit};
    all.push_back(&column);
  }
  if (all.size() > 1) return several(recording, found.column->name, all);
  return found;
}

base::Result<std::vector<Picked>> columns_called(const Recording& recording,
                                                 const std::vector<std::string>& headings) {
  std::vector<Picked> out;
  for (std::size_t n = 0; n < headings.size(); ++n) {
    const std::string& heading = headings[n];
    const std::vector<const RecordedColumn*> found = columns_like(recording, heading);
    if (found.empty()) return none_called(recording, heading);
    const auto asked = static_cast<std::size_t>(std::count(headings.begin(), headings.end(), heading));
    const auto before = static_cast<std::size_t>(
        std::count(headings.begin(), headings.begin() + static_cast<std::ptrdiff_t>(n), heading));
    if (found.size() == 1 && before > 0)
      return of_recording(recording, fmt::format("is asked twice for the column \"{}\"", heading),
                          "name each column once; the file has " + headings_of(recording));
    if (found.size() > 1 && asked != found.size()) return several(recording, heading, found);
    const RecordedColumn* const column = found[before];
    out.push_back({column, column->unit});
  }
  return out;
}

base::Result<std::vector<double>> converted(const Recording& recording, const Picked& picked,
                                            const Wanted& wanted) {
  Picked of = picked;
  if (is_part_of_name(of, wanted)) of.unit.clear();
  const base::Result<Conversion> by = conversion_of(recording, of, wanted);
  if (!by) return by.problems();
  std::vector<double> out = of.column->values;
  if (by->ten != 0 || by->multiply != by->divide)
    for (double& x : out) x = by->of(x);
  return out;
}

base::Result<std::vector<double>> values_of(const Recording& recording, const Picked& picked,
                                            const Wanted& wanted) {
  const RecordedColumn& column = *picked.column;
  if (column.bad_cells > 0) {
    const BadCell& first = column.bad.front();
    const std::size_t others = column.bad_cells - 1;
    const std::string more = others == 0   ? ""
                             : others == 1 ? ", and 1 more cell below is not a number"
                                           : fmt::format(", and {} more cells below are not numbers", others);
    return bounded(
        {.where = fmt::format("{}:{}:", recording.name, first.line),
         .value = "",
         .limit = bounded(fmt::format("{} \"{}\"", column.name, first.cell), 400) + " is not a number" + more,
         .cure = "remove such rows, and write numbers as 0.5 or 5e-1"});
  }
  base::Result<std::vector<double>> out = converted(recording, picked, wanted);
  if (!out) return out;
  constexpr double most = 1e12;  // beyond the range of all instruments; products of such values are still
                                 // finite
  for (std::size_t n = 0; n < out->size(); ++n)
    if (!(std::fabs((*out)[n]) <= most))
      return of_recording(
          recording,
          fmt::format("{} {:g} in row {} is too large for any instrument", column.name, (*out)[n], n + 1),
          "correct the unit in this column's heading");
  return out;
}

std::string headings_of(const Recording& recording) {
  constexpr std::size_t shown = 12;
  std::string out;
  for (std::size_t n = 0; n < recording.columns.size() && n < shown; ++n)
    out += (n == 0 ? "" : ", ") + recording.columns[n].name;
  return recording.columns.size() > shown
             ? out + fmt::format(" and {} more", recording.columns.size() - shown)
             : out;
}

void note_not_used(const std::vector<NotUsed>& columns, Notes& notes) {
  if (columns.empty()) return;
  std::string out = "not used: ";
  for (std::size_t n = 0; n < columns.size(); ++n) {
    const bool last_of_reason = n + 1 == columns.size() || columns[n + 1].reason != columns[n].reason;
    out += columns[n].column + (last_of_reason ? fmt::format(" ({})", columns[n].reason) : "") +
           (n + 1 < columns.size() ? ", " : "");
  }
  notes.push_back(bounded(std::move(out), 2000));
}

}  // namespace text
