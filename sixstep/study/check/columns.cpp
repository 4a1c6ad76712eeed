// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/check/check.hpp"

namespace sixstep::study {

base::Problems check_columns(const Scenario& s) {
  base::Problems out;
  const auto columns = record_indices(s);
  if (!columns || s.record.columns.empty()) return out;  // unknown ones are told by check()
  for (const std::size_t n : *columns) {
    const auto id = static_cast<ColumnId>(n);
    if (applies(id, s) || id == ColumnId::loop_A) continue;  // a star's is 0
    const bool of_field = id >= ColumnId::i_d && s.control.drive != FirmwareKind::field;
    out.push_back(
        {"record.columns", "\"" + all_columns(s.sheet.kind)[n].name + "\"",
         of_field ? "is held by the field-oriented drive only" : "has no value in this control.mode",
         of_field ? "remove it, or set control.drive = \"field-oriented\""
                  : "remove it, or control what it is the reference of"});
  }
  return out;
}

}  // namespace sixstep::study
