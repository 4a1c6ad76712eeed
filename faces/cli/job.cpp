// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/job.hpp"

#include <filesystem>
#include <utility>

#include "faces/cli/report_page.hpp"
#include "faces/cli/terminal.hpp"
#include "io/json_summary.hpp"

namespace cli {
namespace {

template <class File>
base::Problems keep(std::optional<File>& into, base::Result<File> file) {
  if (!file) return file.problems();
  into.emplace(std::move(*file));
  return {};
}

}  // namespace

std::string Job::name() const { return std::filesystem::path(file_).stem().string(); }

void Job::note(base::Problems problems) {
  problems_.insert(problems_.end(), problems.begin(), problems.end());
}

base::Problems Job::prepare(const OutputPaths& paths) {
  if (!paths.csv.empty()) {
    base::Result<std::vector<study::Column>> columns = study::record_columns(scenario_);
    if (!columns) return columns.problems();
    note(keep(csv_, io::CsvWriter::create(paths.csv, *columns)));
  }
  json_to_stdout_ = paths.json == "-";
  if (!paths.json.empty() && !json_to_stdout_) note(keep(json_, io::AtomicFile::create(paths.json)));
  if (!paths.html.empty()) note(keep(html_, io::AtomicFile::create(paths.html)));
  return std::exchange(problems_, {});
}

study::Listeners Job::listeners() {
  study::Listeners listeners;
  if (csv_) listeners.on_record = [this](study::Row row) { csv_->row(row); };
  if (html_) {
    events_.columns = study::all_columns();
    events_.values.resize(events_.columns.size());
    events_.every_event = true;
    listeners.on_event = [this](study::Row row) {
      for (std::size_t n = 0; n < row.size(); ++n) events_.values[n].push_back(row[n]);
    };
  }
  listeners.keep_going = [this](double) { return !(interrupted_ = interrupted_ || cli::interrupted()); };
  return listeners;
}

void Job::run() {
  base::Result<study::Outcome> result = study::run(scenario_, listeners());
  if (!result)
    note(result.problems());
  else
    outcome_ = std::move(*result);
  publish();
}

void Job::publish() {
  if (outcome_ && interrupted_ && csv_) note(csv_->commit_partial());
  if (outcome_ && !interrupted_) {
    if (csv_) note(csv_->commit());
    if (json_) {
      json_->write(io::json_summary(scenario_, *outcome_));
      note(json_->commit());
    }
    if (html_) {
      html_->write(report_page({scenario_, *outcome_, events_, file_, command_}));
      note(html_->commit());
    }
    if (json_to_stdout_) print(io::json_summary(scenario_, *outcome_));
  }
  // Temporary files of what was not put in place go now, and the events' memory with them.
  csv_.reset();
  json_.reset();
  html_.reset();
  events_ = {};
}

Exit Job::exit_code() const {
  if (interrupted_) return Exit::interrupted;
  if (!problems_.empty() || !outcome_) return Exit::bad_input;
  return exit_of(*outcome_);
}

}  // namespace cli
