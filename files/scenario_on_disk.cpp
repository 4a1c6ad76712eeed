// SPDX-License-Identifier: Apache-2.0
#include "files/scenario_on_disk.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "files/controller_file.hpp"
#include "files/text_file.hpp"

namespace files {
namespace {

namespace fs = std::filesystem;

base::Result<text::NamedText> named(const std::string& path, base::Result<std::string> text) {
  if (text) return text::NamedText{path, std::move(*text)};
  base::Problem problem = text.problems().front();
  problem.where = path;
  return problem;
}

/// Possible paths of a motor, the preferred path first.
std::vector<std::string> places_of(const text::Naming& motor, const std::string& data_dir) {
  const fs::path folder = fs::path(motor.from).parent_path();
  const std::string file = motor.name.ends_with(".toml") ? motor.name : motor.name + ".toml";
  std::vector<std::string> paths{(folder / motor.name).string()};
  if (file != motor.name) paths.push_back((folder / file).string());
  if (!data_dir.empty()) paths.push_back((fs::path(data_dir) / "motors" / file).string());
  return paths;
}

base::Result<text::NamedText> find_motor(const text::Naming& motor, const std::string& data_dir) {
  const std::vector<std::string> paths = places_of(motor, data_dir);
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (!fs::exists(path, ignored) || fs::is_directory(path, ignored)) continue;
    if (fs::equivalent(path, motor.from, ignored)) continue;  // a scenario may have its motor's name
    base::Result<std::string> text = read_text(path);
    if (!text) return text.problems();
    return text::NamedText{path, std::move(*text)};
  }
  return base::Problem{.where = fmt::format("{}", fmt::join(paths, " nor "))};
}

}  // namespace

text::Resolve on_disk(const std::string& data_dir) {
  return [data_dir](const text::Naming& naming) -> base::Result<text::NamedText> {
    if (naming.kind == text::Naming::Kind::motor) return find_motor(naming, data_dir);
    const std::string path = (fs::path(naming.from).parent_path() / naming.name).string();
    if (naming.kind == text::Naming::Kind::controller) return load_controller(path);
    return named(path, read_regular_text(path));
  };
}

base::Result<study::Scenario> read_scenario(const std::string& path, const ReadOptions& options) {
  base::Result<std::string> text = read_text(path);
  if (!text) return text.problems();
  return read_scenario_text(path, std::move(*text), options);
}

base::Result<study::Scenario> read_scenario_text(const std::string& path, std::string text,
                                                 const ReadOptions& options) {
  return text::read_scenario_text(path, std::move(text),
                                  {.overrides = options.overrides, .resolve = on_disk(options.data_dir)});
}

base::Result<design::Sheet> read_sheet(const std::string& name, const std::string& data_dir) {
  return text::read_sheet(name, on_disk(data_dir));
}

}  // namespace files
