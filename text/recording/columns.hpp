// SPDX-License-Identifier: Apache-2.0
// Finds columns of a recording by their names and converts their values to the wanted unit.
#pragma once
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/keys/units.hpp"
#include "text/recording/recording.hpp"

namespace text {

/// A column and the unit of its values. The unit is the heading's unit, unless the unit's letter is part of
/// the name that was found.
struct Picked {
  const RecordedColumn* column = nullptr;
  std::string unit;
};

/// Whether the column's bare name is one of `names`.
bool is_called(const RecordedColumn& column, std::span<const std::string_view> names);

/// The column with one of these names; null if there is none. Problem: two columns match.
base::Result<Picked> find_column(const Recording& recording, std::span<const std::string_view> names);
inline base::Result<Picked> find_column(const Recording& recording,
                                        std::initializer_list<std::string_view> names) {
  return find_column(recording, std::span(names.begin(), names.size()));
}

/// The columns with these headings; "column 3" means a position. If a heading is given as often as it occurs,
/// it means each of its columns in turn. The Problem lists the headings.
base::Result<std::vector<Picked>> columns_called(const Recording& recording,
                                                 const std::vector<std::string>& headings);

/// The column's values in the wanted unit; unchanged if the column has no unit. Problems, with lines: an
/// unknown unit or a unit of another kind, cells that are not numbers, numbers that no instrument shows.
base::Result<std::vector<double>> values_of(const Recording& recording, const Picked& picked,
                                            const Wanted& wanted);

/// Like values_of(), but without a check of the numbers: NaN for a cell that is not a number.
base::Result<std::vector<double>> converted(const Recording& recording, const Picked& picked,
                                            const Wanted& wanted);

/// The headings for messages: "hall1, hall2, u_ab".
std::string headings_of(const Recording& recording);

/// Adds a note such as "not used: Comment, Remark (holds no numbers), Temp (in degC)": neither Comment nor Remark
/// has numbers, and no wanted value has Temp's unit. No note without columns.
struct NotUsed {
  std::string column, reason;
};
void note_not_used(const std::vector<NotUsed>& columns, Notes& notes);

}  // namespace text
