// SPDX-License-Identifier: Apache-2.0
#include "text/toml/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "text/keys/bounded.hpp"
#include "text/toml/foreign_file.hpp"
#include "text/toml/nesting.hpp"
#include "text/toml/syntax_cure.hpp"

namespace text {
namespace {

bool is_number(std::string_view word) {
  return !word.empty() && word.size() < 7 &&
         std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// The child is const if the node is const.
template <class Node>
Node* child(Node& node, const std::string& word) {
  if (auto* table = node.as_table()) return table->get(word);
  auto* array = node.as_array();
  if (array && is_number(word)) return array->get(std::stoul(word));
  return nullptr;
}

std::vector<std::size_t> line_starts(std::string_view text) {
  std::vector<std::size_t> starts{0};
  for (std::size_t n = 0; n < text.size(); ++n)
    if (text[n] == '\n') starts.push_back(n + 1);
  return starts;
}

/// The byte offset of a line and column, both counted from 1, columns in code points.
std::size_t offset_of(std::string_view text, const std::vector<std::size_t>& lines,
                      toml::source_position at) {
  if (at.line == 0 || at.line > lines.size()) return text.size();
  std::size_t offset = lines[at.line - 1];
  for (toml::source_index column = 1; column < at.column && offset < text.size(); ++column) {
    ++offset;
    while (offset < text.size() && (static_cast<unsigned char>(text[offset]) & 0xC0U) == 0x80U) ++offset;
  }
  return offset;
}

void put(toml::table& table, const std::string& key, toml::node& value) {
  value.visit([&](auto& node) { table.insert_or_assign(key, node); });
}

void put(toml::array& array, std::size_t index, toml::node& value) {
  value.visit([&](auto& node) { array.replace(array.cbegin() + static_cast<std::ptrdiff_t>(index), node); });
}

/// Puts the tables of `first` before the tables of the list.
void put_first(toml::array& list, toml::array& first) {
  toml::array own = std::move(list);
  list = {};
  for (toml::array* from : {&first, &own})
    for (toml::node& item : *from) list.push_back(std::move(*item.as_table()));
}

/// Whether a node is `name = {}`.
bool is_empty_inline(const toml::node* node) {
  const toml::table* table = node ? node->as_table() : nullptr;
  return table && table->is_inline() && table->empty();
}

struct Dropped {
  toml::table* holder;
  std::string key;
};

void fill(toml::table& over, toml::table& base, std::vector<Dropped>& dropped);

/// Joins a table with the base's table. A base's table in braces replaces the tables of weaker bases: the
/// mark is_inline prevents weaker bases from adding keys.
void join(toml::table& over, toml::table& base, std::vector<Dropped>& dropped) {
  fill(over, base, dropped);
  if (base.is_inline()) over.is_inline(true);
}

/// Moves the keys that `over` does not have from `base` to `over`; each key keeps its place in its file. A
/// dropped table stays as a mark until all bases are processed, because a weaker base may contain the same
/// table.
void fill(toml::table& over, toml::table& base, std::vector<Dropped>& dropped) {
  for (auto&& [key, node] : base) {
    toml::node* mine = over.get(key.str());
    toml::table *a = mine ? mine->as_table() : nullptr, *b = node.as_table();
    if (is_empty_inline(mine) && b)
      dropped.push_back({&over, std::string(key.str())});
    else if (!mine)
      node.visit([&, &key = key](auto& value) { over.insert(key, std::move(value)); });
    else if (a && b && !a->is_inline())
      join(*a, *b, dropped);
    else if (mine->is_array_of_tables() && node.is_array_of_tables())
      put_first(*mine->as_array(), *node.as_array());
  }
}

}  // namespace

void Document::lay_over(std::vector<Document> bases) {
  std::vector<Dropped> dropped;
  for (; !bases.empty(); bases.pop_back()) {
    fill(root_, bases.back().root_, dropped);
    for (File& file : bases.back().files_) files_.push_back(std::move(file));
  }
  for (const Dropped& table : dropped) table.holder->erase(table.key);
}

std::size_t Document::order_of(const toml::source_region& region) const {
  for (std::size_t n = 0; region.path && n < files_.size(); ++n)
    if (files_[n].name == *region.path) return n;
  return 0;
}

const std::string& Document::file_of(const toml::node& node, std::string_view path) const {
  return files_[setting_of(path) ? 0 : order_of(node.source())].name;
}

std::vector<std::string> path_words(std::string_view path) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : path) {
    if (c == '.' || c == '[' || c == ']') {
      if (!word.empty()) words.push_back(std::move(word));
      word.clear();
    } else {
      word += c;
    }
  }
  if (!word.empty()) words.push_back(std::move(word));
  return words;
}

Document::Document(std::string name, std::string text, toml::table root)
    : files_{{std::move(name), text, line_starts(text)}}, root_(std::move(root)) {}

base::Result<Document> Document::parse(std::string name, std::string text) {
  if (std::optional<base::Problem> deep = nests_too_deep(name, text)) return std::move(*deep);
  toml::parse_result parsed = toml::parse(std::string_view(text), std::string_view(name));
  if (!parsed) {
    if (std::optional<base::Problem> foreign = foreign_file(name, text)) return bounded(std::move(*foreign));
    const toml::parse_error& error = parsed.error();
    const toml::source_position at = error.source().begin;
    return bounded(base::Problem{.where = fmt::format("{}:{}:{}:", name, at.line, at.column),
                                 .limit = std::string(error.description()),
                                 .cure = std::string(syntax_cure(error.description()))});
  }
  return Document(std::move(name), std::move(text), std::move(parsed).table());
}

base::Problems Document::set(std::span<const Setting> settings) {
  base::Problems problems;
  for (const Setting& setting : settings) {
    const std::vector<std::string> words = path_words(setting.path);
    const std::string line = fmt::format("x = {}", setting.text);
    if (words.size() > deepest || nests_too_deep("", line)) {
      problems.push_back(
          bounded({.where = fmt::format("--set {}", setting.path),
                   .value = setting.text,
                   .limit = "nests too deep",
                   .cure = "write --set table.key=value, for example --set supply.voltage_V=12"}));
      continue;
    }
    toml::parse_result parsed = toml::parse(line);
    toml::table holder;
    if (parsed && parsed.table().size() == 1)
      holder = std::move(parsed).table();
    else
      holder.insert("x", setting.text);
    toml::node* place = words.empty() ? nullptr : &root_;
    for (std::size_t n = 0; place && n + 1 < words.size(); ++n) {
      if (toml::table* table = place->as_table(); table && !table->contains(words[n]))
        table->insert(words[n], toml::table{});
      place = child(*place, words[n]);
    }
    if (toml::table* table = place ? place->as_table() : nullptr) {
      put(*table, words.back(), *holder.get("x"));
    } else if (toml::array* array = place ? place->as_array() : nullptr;
               array && child(*place, words.back())) {
      put(*array, std::stoul(words.back()), *holder.get("x"));
    } else {
      problems.push_back({.where = fmt::format("--set {}", setting.path),
                          .value = setting.text,
                          .limit = "does not name a key",
                          .cure = "write --set table.key=value, for example --set supply.voltage_V=12"});
      continue;
    }
    settings_.push_back(setting);
  }
  return problems;
}

const toml::node* Document::find(std::string_view path) const {
  const toml::node* node = &root_;
  for (const std::string& word : path_words(path)) {
    node = child(*node, word);
    if (!node) return nullptr;
  }
  return node;
}

const Setting* Document::setting_of(std::string_view path) const {
  const std::vector<std::string> words = path_words(path);
  // The last of several settings of one key applies.
  for (auto setting = settings_.rbegin(); setting != settings_.rend(); ++setting)
    if (path_words(setting->path) == words) return &*setting;
  return nullptr;
}

const Setting* Document::only_setting_in(const toml::node& node, const std::string& path) const {
  const toml::table* table = node.as_table();
  if (!table) return setting_of(path);
  const Setting* last = nullptr;
  for (const auto& [key, value] : *table) {
    last = only_setting_in(value, path + "." + std::string(key.str()));
    if (!last) return nullptr;
  }
  return last;
}

std::string_view Document::slice(const toml::source_region& region) const {
  const File& file = files_[order_of(region)];
  const std::string_view text = file.text;
  const std::size_t begin = offset_of(text, file.lines, region.begin),
                    end = offset_of(text, file.lines, region.end);
  return begin < end ? text.substr(begin, end - begin) : std::string_view();
}

std::string Document::quote(const toml::node& node, std::string_view path) const {
  if (const Setting* setting = setting_of(path)) return setting->text;
  if (node.is_table() || node.is_array_of_tables() || !node.source().begin) return {};
  std::string_view text = slice(node.source());
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
    text.remove_suffix(1);
  if (text.find('\n') != std::string_view::npos) return {};
  return std::string(text);
}

std::string Document::written_as_text(const toml::node& node, std::string_view path) const {
  const std::string value = quote(node, path);
  if (const Setting* setting = setting_of(path))
    return fmt::format("--set '{}=\"{}\"'", setting->path, value);
  return fmt::format("{} = \"{}\"", path_words(path).back(), value);
}

std::string Document::place(const toml::source_region& region) const {
  return fmt::format("{}:{}:{}", files_[order_of(region)].name, region.begin.line, region.begin.column);
}

std::string Document::place(const toml::node& node, std::string_view path) const {
  if (const Setting* setting = setting_of(path)) return fmt::format("--set {}", setting->path);
  if (const Setting* setting = only_setting_in(node, std::string(path)))
    return fmt::format("--set {}", setting->path);
  if (node.source().begin) return place(node.source());
  return nearest_place(path);
}

std::string Document::nearest_place(std::string_view path) const {
  std::vector<std::string> words = path_words(path);
  while (!words.empty()) {
    const std::string joined = fmt::format("{}", fmt::join(words, "."));
    if (const Setting* setting = setting_of(joined)) return fmt::format("--set {}", setting->path);
    const toml::node* node = find(joined);
    if (node && node->source().begin) return place(node->source());
    words.pop_back();
  }
  return fmt::format("{}:1:1", name());
}

}  // namespace text
