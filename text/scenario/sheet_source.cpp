// SPDX-License-Identifier: Apache-2.0
#include "text/scenario/sheet_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sixstep/design/sheet/sheet_constants.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/design/sheet/sheet_spellings.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/motor/motor_library.hpp"
#include "text/scenario/motion_words.hpp"
#include "text/scenario/reference_file.hpp"
#include "text/toml/file_kind.hpp"
#include "text/toml/table_reader.hpp"

namespace text {
namespace {

/// Whether the table has a key that no sheet has. Such a key may be misspelt, and the correct key is then
/// missing.
bool has_unknown_key(const std::string& table, const Document& document) {
  const std::vector<KeyEntry>& keys = sheet_keys();
  const toml::node* node =
      table.empty() ? &document.root() : document.find(table.substr(0, table.size() - 1));
  const toml::table* lines = node ? node->as_table() : nullptr;
  return lines && std::any_of(lines->begin(), lines->end(), [&](const auto& line) {
           return find_key(keys, std::string(line.first.str())) == nullptr;
         });
}

/// The keys of a sheet that occur in a text.
std::vector<std::string> keys_in_table(const std::string& text) {
  const std::vector<KeyEntry>& keys = sheet_keys();
  std::vector<std::string> found;
  std::string word;
  for (const char c : text + " ") {
    const bool letter =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (letter) {
      word += c;
      continue;
    }
    if (find_key(keys, word)) found.push_back(word);
    word.clear();
  }
  return found;
}

}  // namespace

void read_shape(const Document& document, const std::string& path, const Resolve& resolve,
                design::Sheet& sheet, Complaints& complaints, base::Problems& of_other_files) {
  const toml::node* node = document.find(path);
  if (!node || sheet.back_emf_file.empty()) return;
  const auto complain = [&](base::Problem problem) {
    problem.where = path;
    complaints.later(std::move(problem));
    complaints.told_elsewhere(path);
  };
  if (!sheet.back_emf_angle_deg.empty() || !sheet.back_emf_shape.empty())
    return complain({.limit = "contradicts back_emf_angle_deg and back_emf_shape: give the points only once",
                     .cure = "keep the file, or the two lists"});
  const base::Result<NamedText> file =
      find_text(resolve, {Naming::Kind::rows, sheet.back_emf_file, document.file_of(*node, path)});
  if (!file) return complain(file.problems().front());
  base::Result<ShapeRows> rows = shape_rows(file->name, file->text);
  if (!rows) {
    append(of_other_files, rows.problems());
    return complaints.told_elsewhere(path);
  }
  sheet.back_emf_angle_deg = std::move(rows->angles_deg);
  sheet.back_emf_shape = std::move(rows->values);
}

std::optional<int> pole_pairs_in(const Document& document, const std::string& table,
                                 const design::Sheet& sheet) {
  const auto whole = [&](std::string_view key) {
    const toml::node* node = document.find(table + std::string(key));
    const std::optional<std::int64_t> count = node ? node->value_exact<std::int64_t>() : std::nullopt;
    return count && std::in_range<int>(*count) ? std::optional(static_cast<int>(*count)) : std::nullopt;
  };
  const toml::node* code = document.find(table + "winding");
  design::Sheet poles;
  poles.pole_pairs = whole("pole_pairs");
  for (const base::Spelling& spelling : design::spellings::pole_pairs)
    if (!poles.pole_pairs) poles.pole_pairs = whole(spelling.key);
  poles.poles = whole("poles");
  poles.winding = code ? code->value<std::string>().value_or("") : "";
  const bool given = poles.pole_pairs || poles.poles || !poles.winding.empty();
  return design::sheet_constants(given ? poles : sheet).pole_pairs;
}

SheetSource sheet_of(Document document, const Resolve& resolve) {
  SheetSource source{std::move(document), {}};
  Complaints complaints(source.document);
  base::Problems of_other_files;
  complaints.set_pole_pairs(pole_pairs_in(source.document, "", source.sheet));
  read_root(source.document, source.sheet, complaints);
  complaints.set_linear_motor(source.sheet.kind == design::MotorKind::linear);
  refuse_other_motion(sheet_keys(), complaints);
  read_shape(source.document, "back_emf_file", resolve, source.sheet, complaints, of_other_files);
  if (complaints.empty() && of_other_files.empty()) return source;
  if (std::optional<base::Problem> problem = taken_for(FileKind::motor, source.document)) {
    source.problems = {*problem};
    return source;
  }
  base::Problems of_sheet;
  for (base::Problem& problem : design::sheet_constants(source.sheet).problems)
    if (!follows(problem, "", complaints))
      of_sheet.push_back(as_written(source.document, "", std::move(problem)));
  for (base::Problem& problem : of_sheet) complaints.later(std::move(problem));
  source.problems = complaints.in_order();
  append(source.problems, of_other_files);
  return source;
}

std::optional<SheetSource> named_sheet(const Document& scenario, const Resolve& resolve,
                                       Complaints& complaints, base::Problems& of_other_files) {
  const toml::node* name = scenario.find("motor");
  if (!name || !name->is_string()) return {};  // the description reports a value of another type
  base::Result<Document> document =
      find_motor(name->as_string()->get(), scenario.file_of(*name, "motor"), resolve);
  if (!document) {
    for (const base::Problem& problem : document.problems())
      problem.where.empty() ? complaints.value(*name, "motor", problem) : of_other_files.push_back(problem);
    return {};
  }
  SheetSource source = sheet_of(std::move(*document), resolve);
  append(of_other_files, source.problems);
  return source;
}

bool overridden(const Document& document, std::string_view key) {
  if (document.find(fmt::format("motor_override.{}", key))) return true;
  const std::vector<KeyEntry>& keys = sheet_keys();
  const KeyEntry* entry = find_key(keys, key);
  return entry && std::any_of(entry->about.also.begin(), entry->about.also.end(), [&](const auto& spelling) {
           return document.find(fmt::format("motor_override.{}", spelling.key)) != nullptr;
         });
}

bool is_sheet_key(const std::string& where) {
  const std::vector<KeyEntry>& keys = sheet_keys();
  return find_key(keys, where) != nullptr;
}

base::Problem as_written(const Document& document, const std::string& table, base::Problem problem) {
  const std::vector<KeyEntry>& keys = sheet_keys();
  const KeyEntry* entry = find_key(keys, problem.where);
  if (!entry || entry->path == problem.where) return problem;
  for (const char* part : {".value", ""}) {
    const std::string path = table + problem.where + part;
    const toml::node* node = document.find(path);
    if (!node) continue;
    problem.value = document.quote(*node, path);
    break;
  }
  return problem;
}

bool follows(const base::Problem& problem, const std::string& table, const Complaints& complaints) {
  const auto told = [&](const std::string& key) { return complaints.about(table + key); };
  if (told(problem.where)) return true;
  const bool misspelt = has_unknown_key(table, complaints.document());
  const std::vector<std::string> others = keys_in_table(problem.limit + " " + problem.cure);
  return std::any_of(others.begin(), others.end(), [&](const std::string& key) {
    const bool sure = key.find('_') != std::string::npos;  // a word such as "poles" or "winding" alone does
                                                           // not show that the text is a sheet
    return told(key) || (misspelt && sure && !complaints.document().find(table + key));
  });
}

}  // namespace text
