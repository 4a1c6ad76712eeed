// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/outputs.hpp"

#include <filesystem>
#include <utility>

#include "faces/cli/keep.hpp"
#include "faces/cli/report_page.hpp"
#include "faces/cli/terminal.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "text/results/json_summary.hpp"

namespace cli {

std::vector<std::pair<std::string, std::string>> OutputPaths::files() const {
  std::vector<std::pair<std::string, std::string>> wanted;
  for (const auto& [option, path] : {std::pair{"--csv", &csv},
                                     {"--mat", &mat},
                                     {"--mat73", &mat73},
                                     {"--vcd", &vcd},
                                     {"--json", &json},
                                     {"--html", &html}})
    if (!path->empty() && *path != "-") wanted.emplace_back(option, *path);
  return wanted;
}

base::Problems Outputs::open(const OutputPaths& paths, const study::Scenario& scenario,
                             const files::TraceOrigin& origin) {
  paths_ = paths;
  const auto to = [&](const std::string& path) { return files::Destination(path, paths.force); };
  base::Problems problems;
  base::Result<std::vector<study::Column>> columns = study::record_columns(scenario);
  if (!columns) return columns.problems();
  if (!paths.csv.empty())
    keep(csv_, files::CsvWriter::create(to(paths.csv), *columns, files::origin_lines(origin)), problems);
  if (!paths.mat.empty())
    keep(mat_, files::MatWriter::create(to(paths.mat), *columns, files::MatVersion::v5, origin), problems);
  if (!paths.mat73.empty())
    keep(mat73_, files::MatWriter::create(to(paths.mat73), *columns, files::MatVersion::v7_3, origin),
         problems);
  if (!paths.vcd.empty())
    keep(vcd_, files::VcdWriter::create(to(paths.vcd), study::logic_signals(), origin), problems);
  if (!paths.json.empty() && paths.json != "-")
    keep(json_, files::AtomicFile::create(to(paths.json)), problems);
  if (!paths.html.empty()) keep(html_, files::AtomicFile::create(to(paths.html)), problems);
  return problems;
}

void Outputs::listen(const study::Scenario& scenario, study::Listeners& listeners) {
  if (csv_ || mat_ || mat73_)
    listeners.on_record = [this](study::Row row) {
      if (csv_) csv_->row(row);
      if (mat_) mat_->row(row);
      if (mat73_) mat73_->row(row);
    };
  if (vcd_)
    listeners.on_logic = [this](std::int64_t ps, std::span<const std::uint32_t> row) {
      vcd_->change(ps, row);
    };
  if (!html_) return;
  events_.emplace(scenario);
  listeners.on_event = [this](study::Row row) { events_->add(row); };
}

bool Outputs::failed() const {
  return (csv_ && csv_->failed()) || (mat_ && mat_->failed()) || (mat73_ && mat73_->failed()) ||
         (vcd_ && vcd_->failed());
}

/// Put in place and closed: under which name, if so. A file that was not put in place takes its temporary
/// name with it.
template <class File, class... Facts>
std::string Outputs::put(std::optional<File>& file, const std::string& path, bool whole, Facts... facts) {
  if (!file) return {};
  const base::Problems problems = whole ? file->commit(facts...) : file->commit_partial(facts...);
  problems_.insert(problems_.end(), problems.begin(), problems.end());
  file.reset();
  if (!problems.empty()) return {};
  // What is no regular file has no such name.
  std::string partial = files::partial_name(path);
  if (whole || !std::filesystem::exists(partial)) return path;
  partial_files_.push_back(partial);
  return partial;
}

base::Problems Outputs::publish(const RunStory& s, bool whole) {
  put(csv_, paths_.csv, whole);
  put(mat_, paths_.mat, whole, s.outcome.digest);
  put(mat73_, paths_.mat73, whole, s.outcome.digest);
  put(vcd_, paths_.vcd, whole);
  if (json_) json_->write(text::json_summary(s.scenario, s.outcome));
  put(json_, paths_.json, whole);
  if (html_) rows_told_ = report::rows_told(events_->trace());
  if (html_)
    html_->write(report_page({s.scenario, s.outcome, events_->trace(), s.origin.text, s.origin.command}));
  report_ = put(html_, paths_.html, whole);
  if (paths_.json == "-" && whole) print(text::json_summary(s.scenario, s.outcome));
  events_.reset();
  return std::exchange(problems_, {});
}

}  // namespace cli
