// SPDX-License-Identifier: Apache-2.0
#include "text/motor/motor_library.hpp"

#include <fmt/format.h>

#include "text/keys/key_advice.hpp"
#include "text/motors.hpp"

namespace text {
namespace {

/// The cure for an unknown name: the one motor whose name is similar, or all motors that contain the maker's
/// name or order number.
std::string motor_meant(const std::string& name) {
  const std::vector<std::string> all = built_in_motors();
  if (const std::string near = nearest(name, all); !near.empty())
    return fmt::format("did you mean \"{}\"?", near);
  std::string word = stem_of(name);
  for (char& c : word)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  std::vector<std::string> holding;
  constexpr std::size_t fewest_letters = 2;
  for (const std::string& motor : all)
    if (word.size() >= fewest_letters && motor.find(word) != std::string::npos) holding.push_back(motor);
  if (holding.empty())
    return "see the built-in motors with sixstep motor list, or write a file for another motor with sixstep motor new";
  return "did you mean " + quoted_alternatives(holding) + "?";
}

}  // namespace

std::vector<std::string> built_in_motors() {
  std::vector<std::string> names;
  names.reserve(motors::all().size());
  for (const motors::File& file : motors::all()) names.emplace_back(file.name);
  return names;
}

base::Result<Document> find_motor(const std::string& name, const std::string& from, const Resolve& resolve) {
  if (name.empty())
    return base::Problem{.limit = "names no motor",
                         .cure = "give a motor file's path or a built-in motor's name"};
  base::Result<NamedText> found = base::Problem{};
  if (resolve) found = resolve({Naming::Kind::motor, name, from});
  if (found) return Document::parse(std::move(found->name), std::move(found->text));
  const base::Problem& missing = found.problems().front();
  if (!missing.limit.empty()) return missing;
  for (const motors::File& file : motors::all())
    if (file.name == name)
      return Document::parse(fmt::format("built-in {}", file.name), std::string(file.text));
  return base::Problem{.limit = missing.where.empty()
                                    ? "is no built-in motor"
                                    : fmt::format("is neither {} nor a built-in motor", missing.where),
                       .cure = motor_meant(name)};
}

}  // namespace text
