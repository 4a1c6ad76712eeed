// SPDX-License-Identifier: Apache-2.0
#include "text/motor/motor_library.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "text/keys/key_advice.hpp"
#include "text/motors.hpp"
#include "text/toml/text_file.hpp"

namespace text {
namespace {

namespace fs = std::filesystem;

/// Where the motor may lie, in the order of precedence.
std::vector<std::string> candidates(const MotorQuery& query) {
  const fs::path folder(query.folder);
  const std::string file = query.name.ends_with(".toml") ? query.name : query.name + ".toml";
  std::vector<std::string> paths{(folder / query.name).string()};
  if (file != query.name) paths.push_back((folder / file).string());
  if (!query.data_dir.empty()) paths.push_back((fs::path(query.data_dir) / "motors" / file).string());
  return paths;
}

/// A slip of the pen means one motor; a maker's name or an order number all that contain it.
std::string motor_meant(const std::string& name) {
  const std::vector<std::string> all = built_in_motors();
  if (const std::string near = nearest(name, all); !near.empty())
    return fmt::format("did you mean \"{}\"?", near);
  std::string word = fs::path(name).stem().string();
  for (char& c : word)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  std::vector<std::string> holding;
  constexpr std::size_t fewest_letters = 2;
  for (const std::string& motor : all)
    if (word.size() >= fewest_letters && motor.find(word) != std::string::npos) holding.push_back(motor);
  if (holding.empty())
    return "sixstep motor list shows the built-in ones, sixstep motor new writes the file of another";
  return "did you mean " + quoted_alternatives(holding) + "?";
}

}  // namespace

std::vector<std::string> built_in_motors() {
  std::vector<std::string> names;
  names.reserve(motors::all.size());
  for (const motors::File& file : motors::all) names.emplace_back(file.name);
  return names;
}

base::Result<Document> find_motor(const MotorQuery& query) {
  if (query.name.empty())
    return base::Problem{.limit = "names no motor",
                         .cure = "give a motor file's path or a built-in motor's name"};
  const std::vector<std::string> paths = candidates(query);
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (!fs::exists(path, ignored) || fs::is_directory(path, ignored)) continue;
    base::Result<std::string> text = read_text(path);
    if (!text) return text.problems();
    return Document::parse(path, std::move(*text));
  }
  for (const motors::File& file : motors::all)
    if (file.name == query.name)
      return Document::parse(fmt::format("built-in {}", file.name), std::string(file.text));
  return base::Problem{.limit = fmt::format("is neither {} nor a built-in motor", fmt::join(paths, " nor ")),
                       .cure = motor_meant(query.name)};
}

}  // namespace text
