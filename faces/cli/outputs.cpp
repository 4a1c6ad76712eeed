// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <utility>

#include "faces/cli/terminal.hpp"
#include "text/results/quantity_text.hpp"

namespace cli {
namespace {

bool is_stdout(const Format& format, const std::string& path) { return format.printed && path == "-"; }

files::Sink stdout_sink(const Format& format) {
  files::Sink sink;
  sink.finish = [printed = format.printed](const files::RunStory& story, bool whole) {
    if (whole) print(printed(story));
    return base::Problems{};
  };
  return sink;
}

/// A message if the control period is shorter than 1 us and makes the run slow. No board has such a period;
/// each period takes 0.3 us to 3 us of computing time.
std::string length_foretold(const study::Scenario& s) {
  constexpr double short_s = 1e-6, many = 1e7, one_s = 1e-6;
  const double periods = s.duration_s / s.pwm.period_s;
  if (!(s.pwm.period_s < short_s && periods > many)) return "";
  const double minutes = periods * one_s / 60.0;
  return fmt::format("the {:.0f} million control periods of {} take {}", periods / 1e6,
                     text::quantity_text(s.pwm.period_s, "s", 3),
                     minutes < 1.5    ? "up to a minute"
                     : minutes < 90.0 ? fmt::format("some {:.0f} minutes", minutes)
                                      : fmt::format("some {:.2g} hours", minutes / 60.0));
}

/// One function that calls all functions that are not empty; empty if all are empty.
template <class... Arguments>
std::function<void(Arguments...)> one_of_all(std::vector<std::function<void(Arguments...)>> all) {
  std::erase_if(all, [](const auto& function) { return !function; });
  if (all.size() < 2) return all.empty() ? nullptr : all.front();
  return [all = std::move(all)](Arguments... arguments) {
    for (const auto& function : all) function(arguments...);
  };
}

}  // namespace

base::Problems make_folder(const std::string& out) {
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (!error) return {};
  return {{.where = out + ":",
           .limit = fmt::format("cannot be created: {}", error.message()),
           .cure = "name another folder with --out"}};
}

const std::string& OutputPaths::of(std::string_view option) const {
  const auto found = std::ranges::find(formats(), option, &Format::option);
  return of_formats[static_cast<std::size_t>(found - formats().begin())];
}

std::vector<std::pair<std::string, std::string>> OutputPaths::files() const {
  std::vector<std::pair<std::string, std::string>> wanted;
  for (std::size_t n = 0; n < of_formats.size(); ++n)
    if (!of_formats[n].empty() && !is_stdout(formats()[n], of_formats[n]))
      wanted.emplace_back(formats()[n].option, of_formats[n]);
  return wanted;
}

bool OutputPaths::prints() const {
  for (std::size_t n = 0; n < of_formats.size(); ++n)
    if (is_stdout(formats()[n], of_formats[n])) return true;
  return false;
}

base::Problems Outputs::open(const OutputPaths& paths, const study::Scenario& scenario,
                             const files::TraceOrigin& origin) {
  base::Problems problems;
  for (std::size_t n = 0; n < paths.of_formats.size(); ++n) {
    const Format& format = formats()[n];
    const std::string& path = paths.of_formats[n];
    if (path.empty()) continue;
    base::Result<files::Sink> sink =
        is_stdout(format, path) ? stdout_sink(format)
                                : format.open(files::Destination(path, paths.force), scenario, origin);
    if (sink)
      open_.push_back({format.option, is_stdout(format, path) ? "" : path, std::move(*sink)});
    else
      append(problems, sink.problems());
  }
  return problems;
}

void Outputs::listen(study::Listeners& listeners) const {
  std::vector<std::function<void(study::Row)>> on_record, on_event;
  std::vector<study::LogicSink> on_logic;
  for (const Open& output : open_) {
    on_record.push_back(output.sink.on_record);
    on_event.push_back(output.sink.on_event);
    on_logic.push_back(output.sink.on_logic);
  }
  listeners.on_record = one_of_all(std::move(on_record));
  listeners.on_event = one_of_all(std::move(on_event));
  listeners.on_logic = one_of_all(std::move(on_logic));
}

std::string Outputs::foretold(const OutputPaths& paths, const study::Scenario& scenario) {
  std::string text = length_foretold(scenario);
  for (std::size_t n = 0; n < paths.of_formats.size(); ++n) {
    if (!formats()[n].foretold || paths.of_formats[n].empty()) continue;
    if (const std::string told = formats()[n].foretold(scenario); !told.empty())
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", formats()[n].option, told);
  }
  return text;
}

bool Outputs::failed() const {
  return std::ranges::any_of(open_,
                             [](const Open& output) { return output.sink.failed && output.sink.failed(); });
}

base::Problems Outputs::publish(const files::RunStory& story, bool whole) {
  base::Problems problems;
  for (const Open& output : open_) {
    const base::Problems failed = output.sink.finish(story, whole);
    append(problems, failed);
    if (output.sink.left_out) left_out_ += output.sink.left_out();
    if (!failed.empty() || output.path.empty()) continue;
    // A path that is not a regular file, such as a pipe, has no partial name.
    const std::string partial = files::partial_name(output.path);
    const bool is_partial = !whole && std::filesystem::exists(partial);
    if (is_partial) partial_files_.push_back(partial);
    if (output.option == page_option) page_ = is_partial ? partial : output.path;
  }
  open_.clear();
  return problems;
}

}  // namespace cli
