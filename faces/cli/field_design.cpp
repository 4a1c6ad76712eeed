// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/field_design.hpp"

#include "faces/cli/design_use.hpp"
#include "faces/cli/open_or_report.hpp"
#include "faces/cli/terminal.hpp"
#include "files/atomic_file.hpp"
#include "sixstep/analysis/verify/field_study.hpp"
#include "text/results/field_design_text.hpp"

namespace cli {
Exit design_field(const DesignArguments& a, const study::Scenario& scenario) {
  base::Problems found = unread_by_field_design(a);
  std::optional<files::AtomicFile> file;
  if (!a.json.empty() && a.json != "-")
    open_or_report(file, files::AtomicFile::create({a.json, a.force}), found);
  if (!found.empty()) return refused(found);
  base::Result<analysis::FieldStudy> s = analysis::study_field(scenario);
  if (!s) return refused(s.problems());
  warn_of_sheet(scenario.sheet, scenario.motor, s->warnings);
  const std::string json = a.json.empty() ? "" : text::field_design_json(*s);
  if (file) {
    file->write(json);
    if (found = file->commit(); !found.empty()) return refused(found);
  }
  if (a.json == "-") print(json);
  std::FILE* to = a.json == "-" ? stderr : stdout;  // standard output then holds only the JSON
  if (!a.quiet) print(text::field_design_text(*s, may_colour(to)), to);
  return s->usable() ? Exit::ok : Exit::failed;
}

}  // namespace cli
