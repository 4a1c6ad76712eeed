// SPDX-License-Identifier: Apache-2.0
// Columns of a recording by their names, and their values in the unit that is wanted.
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

/// A column, and the unit that its values are in: that of its heading, unless a letter of it belongs to the name that was found.
struct Picked {
  const RecordedColumn* column = nullptr;
  std::string unit;
};

/// Whether its bare name is one of these.
bool is_called(const RecordedColumn& column, std::span<const std::string_view> names);

/// The column that is called so; null where there is none. A Problem where two are.
base::Result<Picked> find_column(const Recording& recording, std::span<const std::string_view> names);
inline base::Result<Picked> find_column(const Recording& recording,
                                        std::initializer_list<std::string_view> names) {
  return find_column(recording, std::span(names.begin(), names.size()));
}

/// The columns with those headings, "column 3" by its place; of one heading that is given as often as columns have it, each in turn. A
/// Problem that says which there are.
base::Result<std::vector<Picked>> columns_called(const Recording& recording,
                                                 const std::vector<std::string>& headings);

/// Its values in the unit that is wanted; as they stand where it has none. Problems, with their lines: a unit that is none or of another kind, cells that
/// are no numbers, numbers that no instrument shows.
base::Result<std::vector<double>> values_of(const Recording& recording, const Picked& picked,
                                            const Wanted& wanted);

/// The same before anybody looks at the numbers: NaN in cells that are none.
base::Result<std::vector<double>> converted(const Recording& recording, const Picked& picked,
                                            const Wanted& wanted);

/// "hall1, hall2, u_ab": what messages say there is.
std::string headings_of(const Recording& recording);

/// "not used: Comment, Remark (holds no numbers), Temp (in degC)"; nothing where nothing is.
struct NotUsed {
  std::string column, reason;
};
void note_not_used(const std::vector<NotUsed>& columns, Notes& notes);

}  // namespace text
