// SPDX-License-Identifier: Apache-2.0
#include "text/scenario/scenario_family.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/toml/complaints.hpp"

namespace text {
namespace {

constexpr std::size_t most_files = 64;

class Family {
 public:
  explicit Family(const Resolve& resolve) : resolve_(resolve) {}

  base::Result<Document> read(const std::string& name, std::string text) {
    base::Result<Document> document = Document::parse(name, std::move(text));
    if (!document) return document.problems();
    chain_.push_back(beside("", name));
    Complaints complaints(*document);
    std::vector<Document> bases;
    base::Problems of_bases;
    for (const Named& base : named(*document)) {
      base::Result<Document> read = follow(base, name, complaints);
      if (read)
        bases.push_back(std::move(*read));
      else
        append(of_bases, read.problems());
    }
    chain_.pop_back();
    base::Problems problems = complaints.in_order();
    append(problems, of_bases);
    if (!problems.empty()) return problems;
    document->lay_over(std::move(bases));
    return document;
  }

 private:
  struct Named {
    const toml::node* node;
    std::string path, file;
  };

  /// Omits a value of another type, because the scenario's description reports such a value.
  static std::vector<Named> named(const Document& document) {
    std::vector<Named> all;
    const toml::node* node = document.find("extends");
    const auto add = [&](const toml::node& item, std::string path) {
      if (const auto* text = item.as_string()) all.push_back({&item, std::move(path), text->get()});
    };
    if (node) add(*node, "extends");
    if (const toml::array* list = node ? node->as_array() : nullptr)
      for (std::size_t n = 0; n < list->size(); ++n) add(*list->get(n), fmt::format("extends[{}]", n));
    return all;
  }

  /// Returns the base with its own `extends` already applied.
  base::Result<Document> follow(const Named& base, const std::string& from, Complaints& complaints) {
    const auto refuse = [&](std::string limit, std::string cure) -> base::Result<Document> {
      complaints.value(*base.node, base.path, {.limit = std::move(limit), .cure = std::move(cure)});
      return base::Problems{};
    };
    if (std::find(chain_.begin(), chain_.end(), beside(from, base.file)) != chain_.end())
      return refuse("names a file that extends this file", "put the common keys into a third file");
    if (++files_ > most_files)
      return refuse(fmt::format("extends more than {} files", most_files), "merge some of the files");
    base::Result<NamedText> found = find_text(resolve_, {Naming::Kind::scenario, base.file, from});
    if (!found) return refuse(found.problems().front().limit, found.problems().front().cure);
    base::Result<Document> read_base = read(found->name, std::move(found->text));
    if (read_base) read_base->root().erase("extends");
    return read_base;
  }

  const Resolve& resolve_;
  std::vector<std::string> chain_;  ///< the files being read, each named by the preceding file
  std::size_t files_ = 1;
};

}  // namespace

base::Result<Document> read_family(const std::string& name, std::string text, const Resolve& resolve) {
  return Family(resolve).read(name, std::move(text));
}

}  // namespace text
