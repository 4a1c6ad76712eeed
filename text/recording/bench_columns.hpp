// SPDX-License-Identifier: Apache-2.0
// What the headings of a bench's recording mean, which of its voltages belong together, and why a column was not used.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/identification/emf/emf_record.hpp"
#include "text/recording/columns.hpp"

namespace text {

using Columns = std::vector<Picked>;

/// What a heading says that stands in the tables of docs/howto/record-a-motor.md.
enum class Meaning : std::uint8_t { unknown, between_terminals, of_terminal, hall_line, hall_code };

/// Spellings of three columns that belong together, as bare names.
using ThreeNames = std::array<std::vector<std::string_view>, 3>;
const ThreeNames& names_between_terminals();  ///< u_ab, u_bc, u_ca
const ThreeNames& names_of_terminals();       ///< u_a, u_b, u_c
const ThreeNames& names_of_hall_lines();      ///< H1, H2, H3
const std::vector<std::string_view>& names_of_hall_codes();

Meaning meaning_of(const RecordedColumn& column);

/// Each of the three that is there. A Problem where two columns have one name.
using Three = std::array<std::optional<Picked>, 3>;
base::Result<Three> three_of(const Recording& recording, const ThreeNames& names);

/// As many as come before the first that is missing: readers who need the first two.
Columns from_the_first(const Three& found);
/// All of them in the order in which they follow each other, c a where b is missing: any of them do.
Columns in_turn(const Three& found);

/// The voltages to go by, and what they are of where that is known.
struct Voltages {
  Columns columns;
  std::optional<analysis::EmfBetween> between;
};
/// What was asked for, where there is any; else those between terminals where there are two, the three of terminals, what there is.
Voltages chosen(Columns lines, Columns terminals, std::optional<analysis::EmfBetween> wanted);

/// Of what the reading goes by.
struct BenchUse {
  bool hall_log = false;                ///< Hall lines are read, too
  bool by_codes = false;                ///< of them a column of codes
  bool voltages_are_asked = false;      ///< by their headings
  Meaning voltages = Meaning::unknown;  ///< those in use; unknown where there are none
};
/// Why a column that holds numbers was not used.
std::string why_not_used(const RecordedColumn& column, const BenchUse& use);

/// Whether a column's unit, if it has one, is none of volts.
bool is_of_other_unit(const RecordedColumn& column);

}  // namespace text
