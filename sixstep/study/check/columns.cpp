// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/check/check.hpp"

namespace sixstep::study {

base::Problems check_columns(const Scenario& s) {
  base::Problems out;
  const auto columns = record_indices(s);
  if (!columns || s.record.columns.empty()) return out;  // unknown ones are told by check()
  for (const std::size_t n : *columns)
    if (!applies(static_cast<ColumnId>(n), s) &&
        static_cast<ColumnId>(n) != ColumnId::loop_A)  // a star's is 0
      out.push_back({"record.columns", "\"" + all_columns(s.sheet.kind)[n].name + "\"",
                     "has no value in this control.mode",
                     "remove it, or control what it is the reference of"});
  return out;
}

}  // namespace sixstep::study
