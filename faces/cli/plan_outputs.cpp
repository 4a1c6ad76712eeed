// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/plan_outputs.hpp"

#include <filesystem>

#include "faces/cli/plan_reports.hpp"
#include "faces/cli/report_page.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view of_a_plan[] = {"--csv", "--json", page_option};

bool has_format(std::string_view option) {
  return std::find(std::begin(of_a_plan), std::end(of_a_plan), option) != std::end(of_a_plan);
}

OutputPaths paths_of(const RunArguments& a, const ReadPlan& plan) {
  if (a.out.empty()) return a.paths;
  OutputPaths paths;
  const std::string base = (fs::path(a.out) / plan.name).string();
  for (std::size_t n = 0; n < formats().size(); ++n)
    if (has_format(formats()[n].option)) paths.of_formats[n] = base + std::string(formats()[n].in_folder);
  return paths;
}

void write_csv(files::AtomicFile& file, const text::PlanStory& story, const ReadPlan& plan) {
  for (const std::string& line : files::origin_lines(plan.origin)) file.write("# " + line + "\n");
  file.write(text::plan_csv_head(story.columns));
  story.each([&](const analysis::RunRecord& record) {
    if (!file.failed()) file.write(text::plan_csv_row(record));
  });
}

}  // namespace

base::Problems PlanOutputs::open(const RunArguments& arguments, const ReadPlan& plan) {
  arguments_ = &arguments;
  const OutputPaths paths = paths_of(arguments, plan);
  for (std::size_t n = 0; n < formats().size(); ++n) {
    const std::string& path = paths.of_formats[n];
    const std::string_view option = formats()[n].option;
    if (path.empty()) continue;
    if (!has_format(option))
      return {{.where = std::string(option),
               .limit = "is the trace of one run, and this is a plan of many runs",
               .cure = "choose one run: --only N " + std::string(option) + " FILE"}};
    if (path == "-" && option == "--json") {
      prints_json_ = true;
      continue;
    }
    base::Result<files::AtomicFile> file = files::AtomicFile::create({path, arguments.paths.force});
    if (!file) return file.problems();
    open_.push_back({option, std::move(*file)});
  }
  return {};
}

/// If the page is written into a folder, also writes reports of the worst runs there.
std::string PlanOutputs::page(const text::PlanStory& story, const ReadPlan& plan,
                              base::Problems& problems) const {
  WorstReports worst;
  if (!arguments_->out.empty() && !interrupted()) worst = write_worst_reports(*arguments_, plan, story);
  append(problems, worst.problems);
  return plan_page({page_of(*arguments_, plan, story, std::move(worst.files))}, plan.origin.command);
}

base::Problems PlanOutputs::publish(const text::PlanStory& story, const ReadPlan& plan, bool whole) {
  base::Problems problems;
  const std::string json = prints_json_ || std::any_of(open_.begin(), open_.end(),
                                                       [](const Open& o) { return o.option == "--json"; })
                               ? text::plan_json(story, plan.title, plan.origin.motor)
                               : std::string();
  for (Open& open : open_) {
    if (open.option == "--csv") write_csv(open.file, story, plan);
    if (open.option == "--json") open.file.write(json);
    if (open.option == page_option) open.file.write(page(story, plan, problems));
    // After an interrupt, the page may lack reports of the worst runs.
    const bool in_place = whole && !interrupted();
    const base::Problems unwritten = in_place ? open.file.commit() : open.file.commit_partial();
    append(problems, unwritten);
    // A path that is not a regular file, such as a pipe, has no partial name.
    const std::string partial = files::partial_name(open.file.path());
    if (!in_place && unwritten.empty() && fs::exists(partial)) partial_files_.push_back(partial);
  }
  if (prints_json_ && whole) print(json);
  return problems;
}

}  // namespace cli
