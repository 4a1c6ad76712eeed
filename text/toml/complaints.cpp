// SPDX-License-Identifier: Apache-2.0
#include "text/toml/complaints.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "text/keys/bounded.hpp"

namespace text {
namespace {

std::string table_of(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return std::string(dot == std::string_view::npos ? std::string_view() : path.substr(0, dot));
}

}  // namespace

std::string shown(std::string_view path) {
  std::string text;
  bool inside = false;
  for (const char c : path) {
    if (c == '[') inside = true;
    if (!inside) text += c;
    if (c == ']') inside = false;
  }
  return text;
}

void Complaints::add(const toml::source_region& at, std::string place, std::string_view path,
                     base::Problem problem) {
  // "--set a.b" already names the key, so that it is not repeated.
  if (place == "--set " + std::string(path))
    problem.where = std::move(place);
  else
    problem.where = std::move(place) + ": " + shown(path);
  told(path);
  found_.push_back({document_.order_of(at), at.begin, std::move(problem)});
}

bool Complaints::left_out(std::string_view path) {
  if (!full()) return false;
  ++left_out_;
  told(path);
  return true;
}

void Complaints::value(const toml::node& node, std::string_view path, base::Problem problem) {
  if (left_out(path)) return;
  if (problem.value.empty()) problem.value = document_.quote(node, path);
  add(node.source(), document_.place(node, path), path, std::move(problem));
}

void Complaints::key(const toml::key& key, const toml::node& node, std::string_view path,
                     base::Problem problem) {
  if (left_out(path)) return;
  const toml::source_region& at = key.source();
  add(at, at.begin ? document_.place(at) : document_.place(node, path), path, std::move(problem));
}

void Complaints::missing(std::string_view path, base::Problem problem) {
  if (left_out(path)) return;
  const toml::node* table = document_.find(table_of(path));
  add(table ? table->source() : toml::source_region{}, document_.nearest_place(path), path,
      std::move(problem));
}

void Complaints::later(base::Problem problem) {
  const std::string path = problem.where;
  if (const toml::node* node = document_.find(path); node && !path.empty())
    value(*node, path, std::move(problem));
  else
    missing(path, std::move(problem));
}

void Complaints::told(std::string_view path) {
  std::string table = table_of(path);
  for (std::string key = shown(path); !key.empty(); key = table_of(key)) keys_.insert(key);
  tables_.insert(table);
  for (table = table_of(table); table.find('[') != std::string::npos; table = table_of(table))
    tables_.insert(table);
}

void Complaints::told_elsewhere(std::string_view path) { told(path); }

bool Complaints::about_table_of(std::string_view path) const { return tables_.contains(table_of(path)); }

bool Complaints::about(std::string_view key) const { return keys_.contains(key); }

base::Problems Complaints::in_order() const {
  std::vector<Found> sorted = found_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Found& x, const Found& y) {
    return std::tuple(x.file, x.at.line, x.at.column) < std::tuple(y.file, y.at.line, y.at.column);
  });
  base::Problems problems;
  for (Found& found : sorted) problems.push_back(bounded(std::move(found.problem)));
  if (left_out_ > 0)
    problems.push_back({.where = document_.name() + ":",
                        .limit = "is wrong in " + std::to_string(left_out_) + " more places",
                        .cure = "correct the errors above first"});
  return problems;
}

}  // namespace text
