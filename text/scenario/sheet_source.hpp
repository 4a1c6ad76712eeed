// SPDX-License-Identifier: Apache-2.0
// Reads a motor's file: its sheet, and everything that is wrong with it.
#pragma once
#include <optional>
#include <string>

#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/sheet.hpp"
#include "text/sources.hpp"
#include "text/toml/complaints.hpp"
#include "text/toml/document.hpp"

namespace text {

struct SheetSource {
  Document document;
  design::Sheet sheet;
  base::Problems problems{};  ///< with places in the file; if there are problems, `sheet` contains the values
                              ///< that could be read
};

SheetSource sheet_of(Document document, const Resolve& resolve);

/// The sheet that the scenario's `motor` names; empty if there is no such file. Mistakes in the motor's file
/// are reported in of_other_files with their places there. A wrong name is reported in `complaints` at the
/// name.
std::optional<SheetSource> named_sheet(const Document& scenario, const Resolve& resolve,
                                       Complaints& complaints, base::Problems& of_other_files);

/// Reads the points of a back-EMF from the file that the text at `path` names.
void read_shape(const Document& document, const std::string& path, const Resolve& resolve,
                design::Sheet& sheet, Complaints& complaints, base::Problems& of_other_files);

/// The pole pairs that the table gives by any of its keys, else the pole pairs of `sheet`. Mistakes in these
/// keys are reported elsewhere.
std::optional<int> pole_pairs_in(const Document& document, const std::string& table,
                                 const design::Sheet& sheet);

/// Whether [motor_override] has the key, in any of its spellings.
bool overridden(const Document& document, std::string_view key);

/// Whether the `where` of a check is a key of the motor's sheet: such a name contains no table.
bool is_sheet_key(const std::string& where);

/// Quotes the file's value if the file has the key in another spelling, because a sheet's check names the
/// standard key and its unit.
base::Problem as_written(const Document& document, const std::string& table, base::Problem problem);

/// Whether a sheet's problem only follows from mistakes already reported in its table. These mistakes are
/// about:
/// - the same key,
/// - another key that the problem names,
/// - a misspelt key, while the problem is about a missing key.
bool follows(const base::Problem& problem, const std::string& table, const Complaints& complaints);

}  // namespace text
