// SPDX-License-Identifier: Apache-2.0
// Finds the meaning of a bench recording's headings, the voltages that belong together, and the reason why a
// column was not used.
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

/// Meaning of a heading by the tables of docs/howto/record-a-motor.md.
enum class Meaning : std::uint8_t { unknown, between_terminals, of_terminal, hall_line, hall_code };

/// Spellings of three columns that belong together, as bare_name() writes them.
using ThreeNames = std::array<std::vector<std::string_view>, 3>;
const ThreeNames& names_between_terminals();  ///< names of u_ab, u_bc, u_ca
const ThreeNames& names_of_terminals();       ///< names of u_a, u_b, u_c
const ThreeNames& names_of_hall_lines();      ///< names of H1, H2, H3
const std::vector<std::string_view>& names_of_hall_codes();

Meaning meaning_of(const RecordedColumn& column);

/// Three columns, each empty if it does not exist. Problem: two columns have the same name.
using Three = std::array<std::optional<Picked>, 3>;
base::Result<Three> three_of(const Recording& recording, const ThreeNames& names);

/// The columns before the first missing column, for readers that need the first two.
Columns from_the_first(const Three& found);
/// The columns in cyclic order, beginning after a missing column: c a if b is missing. For readers that
/// accept any two of the three.
Columns in_turn(const Three& found);

/// The voltages to use, and between which points they are, if known.
struct Voltages {
  Columns columns;
  std::optional<analysis::EmfBetween> between;
};
/// Chooses voltages: the wanted kind if it exists; else line-to-line voltages if there are two; else all
/// three terminal voltages; else any.
Voltages chosen(Columns lines, Columns terminals, std::optional<analysis::EmfBetween> wanted);

/// The columns of the recording that a reading uses.
struct BenchUse {
  bool hall_log = false;                ///< true: Hall lines are read too
  bool by_codes = false;                ///< true: Hall lines come from a column of codes
  bool voltages_are_asked = false;      ///< true: the request names the voltages by their headings
  Meaning voltages = Meaning::unknown;  ///< meaning of the voltages in use; `unknown` if none are in use
};
/// The reason why a column with numbers was not used.
std::string why_not_used(const RecordedColumn& column, const BenchUse& use);

/// Whether the column has a unit that is not a unit of voltage.
bool is_of_other_unit(const RecordedColumn& column);

}  // namespace text
