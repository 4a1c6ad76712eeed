// SPDX-License-Identifier: Apache-2.0
// A motor's file, read: its sheet, and everything that is wrong with it at once.
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
  base::Problems problems{};  ///< of the file, with place; the sheet has then what could be read
};

SheetSource sheet_of(Document document, const Resolve& resolve);

/// The sheet that the scenario's `motor` names; nothing where there is no such file. What is wrong in the motor's own file is
/// told of that file, what is wrong with the name at the name.
std::optional<SheetSource> named_sheet(const Document& scenario, const Resolve& resolve,
                                       Complaints& complaints, base::Problems& of_other_files);

/// The points of a back-EMF, from the file that the text at `path` names.
void read_shape(const Document& document, const std::string& path, const Resolve& resolve,
                design::Sheet& sheet, Complaints& complaints, base::Problems& of_other_files);

/// As the table says it in one of the ways, else as `sheet` has it. What is wrong with it is told elsewhere.
std::optional<int> pole_pairs_in(const Document& document, const std::string& table,
                                 const design::Sheet& sheet);

/// In any of the key's spellings.
bool overridden(const Document& document, std::string_view key);

/// Whether a check speaks of the motor's sheet, whose keys it names without a table.
bool is_sheet_key(const std::string& where);

/// A sheet's check speaks in the standard key's unit: what stands in another spelling is quoted from the
/// file.
base::Problem as_written(const Document& document, const std::string& table, base::Problem problem);

/// Whether a sheet's problem only follows from what has been told of its table: it is of the same key, or of another one that is
/// told of or, where a key was misspelt, missing.
bool follows(const base::Problem& problem, const std::string& table, const Complaints& complaints);

}  // namespace text
