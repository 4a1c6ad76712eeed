// SPDX-License-Identifier: Apache-2.0
#include "text/sources.hpp"

#include <algorithm>
#include <utility>

namespace text {

base::Result<NamedText> find_text(const Resolve& resolve, const Naming& naming) {
  base::Result<NamedText> found = base::Problem{.where = naming.name};
  if (resolve) found = resolve(naming);
  if (found) return found;
  base::Problem problem = found.problems().front();
  if (problem.limit.empty()) problem.limit = "does not exist";
  return base::Problem{.limit = "names " + problem.where + ", which " + problem.limit, .cure = problem.cure};
}

Resolve among(std::vector<NamedText> texts) {
  return [texts = std::move(texts)](const Naming& naming) -> base::Result<NamedText> {
    const std::string name = beside(naming.from, naming.name);
    const auto found = std::find_if(texts.begin(), texts.end(), [&](const NamedText& text) {
      return text.name == name || (naming.kind == Naming::Kind::motor && text.name == name + ".toml");
    });
    if (found == texts.end()) return base::Problem{.where = name};
    return *found;
  };
}

std::string beside(std::string_view from, std::string_view name) {
  std::string joined(name.starts_with('/') ? "" : from.substr(0, from.rfind('/') + 1));
  joined += name;
  std::vector<std::string_view> parts;
  for (std::string_view rest = joined; !rest.empty();) {
    const std::size_t cut = std::min(rest.find('/'), rest.size());
    const std::string_view part = rest.substr(0, cut);
    rest.remove_prefix(std::min(cut + 1, rest.size()));
    if (part == ".." && !parts.empty() && parts.back() != "..")
      parts.pop_back();
    else if (!part.empty() && part != ".")
      parts.push_back(part);
  }
  std::string path;
  for (const std::string_view part : parts)
    path.append(path.empty() && !joined.starts_with('/') ? "" : "/").append(part);
  return path;
}

std::string stem_of(std::string_view name) {
  name.remove_prefix(name.rfind('/') + 1);
  const std::size_t point = name.rfind('.');
  return std::string(name.substr(0, point == 0 ? name.npos : point));
}

}  // namespace text
