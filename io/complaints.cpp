// SPDX-License-Identifier: Apache-2.0
#include "io/complaints.hpp"

#include <algorithm>
#include <utility>

namespace io {
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

void Complaints::add(toml::source_position at, std::string place, std::string_view path,
                     base::Problem problem) {
  // "--set a.b" already names the key.
  if (place == "--set " + std::string(path))
    problem.where = std::move(place);
  else
    problem.where = std::move(place) + ": " + shown(path);
  tables_.insert(table_of(path));
  found_.push_back({at, std::move(problem)});
}

void Complaints::value(const toml::node& node, std::string_view path, base::Problem problem) {
  if (problem.value.empty()) problem.value = document_.quote(node, path);
  add(node.source().begin, document_.place(node, path), path, std::move(problem));
}

void Complaints::key(const toml::key& key, const toml::node& node, std::string_view path,
                     base::Problem problem) {
  const toml::source_position at = key.source().begin;
  add(at, at ? document_.place(at) : document_.place(node, path), path, std::move(problem));
}

void Complaints::missing(std::string_view path, base::Problem problem) {
  const toml::node* table = document_.find(table_of(path));
  add(table ? table->source().begin : toml::source_position{}, document_.nearest_place(path), path,
      std::move(problem));
}

void Complaints::later(base::Problem problem) {
  const std::string path = problem.where;
  if (const toml::node* node = document_.find(path); node && !path.empty())
    value(*node, path, std::move(problem));
  else
    missing(path, std::move(problem));
}

bool Complaints::about_table_of(std::string_view path) const { return tables_.contains(table_of(path)); }

base::Problems Complaints::in_order() const {
  std::vector<Found> sorted = found_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Found& x, const Found& y) {
    return std::pair(x.at.line, x.at.column) < std::pair(y.at.line, y.at.column);
  });
  base::Problems problems;
  for (Found& found : sorted) problems.push_back(std::move(found.problem));
  return problems;
}

}  // namespace io
