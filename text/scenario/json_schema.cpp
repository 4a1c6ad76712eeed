// SPDX-License-Identifier: Apache-2.0
#include "text/scenario/json_schema.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "sixstep/base/plausible.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/run/run.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/key_tree.hpp"
#include "text/motor/motor_library.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;

struct Place {
  const std::vector<KeyEntry>& keys;
  bool partial = false;  ///< true: inside a table that only changes values, so that no key is required and
                         ///< frames are kept
};

bool is_bounded(double x) { return x - x == 0.0; }

Json schema_number(const base::Range& range) {
  Json schema = {{"type", "number"}};
  if (is_bounded(range.low)) schema[range.low_included ? "minimum" : "exclusiveMinimum"] = range.low;
  if (is_bounded(range.high)) schema[range.high_included ? "maximum" : "exclusiveMaximum"] = range.high;
  return schema;
}

/// Schema of a number in a file. It is a number in the key's unit, or a text with its own unit such as "20
/// ms", whose unit and range are checked on reading.
Json range_schema(const base::Range& range) {
  const Json with_unit = {{"type", "string"}, {"pattern", "^\\s*[-+]?[.0-9]"}};
  return {{"anyOf", {schema_number(range), with_unit}}};
}

/// Schema of a whole number, with the range of an int that the reader accepts.
Json whole_number(const base::Range& range) {
  Json schema = schema_number(range);
  schema["type"] = "integer";
  const auto bound = [&](const char* key, const char* excluding, double limit) {
    if (!schema.contains(key) && !schema.contains(excluding)) schema[key] = static_cast<int>(limit);
  };
  bound("minimum", "exclusiveMinimum", std::numeric_limits<int>::min());
  bound("maximum", "exclusiveMaximum", std::numeric_limits<int>::max());
  return schema;
}

Json one_of(const std::vector<std::pair<std::string, std::string>>& words) {
  Json choices = Json::array();
  for (const auto& [word, meaning] : words) choices.push_back({{"const", word}, {"description", meaning}});
  return {{"oneOf", choices}};
}

Json words_of(const std::vector<std::string>& words) { return {{"enum", words}}; }

/// Schema of a quantity: a number, or a table that also gives its frame and source. A motor file must name
/// the frame if the key allows several frames.
Json quantity(const KeyEntry& entry, const Place& place) {
  const std::vector<std::string> frames = frames_of(entry.about.frame);
  std::vector<std::string> trusts;
  for (const auto& trust : base::trust_choices) trusts.emplace_back(trust.word);
  Json parts = {{"value", range_schema(base::allowed(entry.about))}};
  if (!frames.empty()) parts["frame"] = words_of(frames);
  parts["source"] = {{"type", "string"}, {"description", "source of the value"}};
  parts["kind"] = {{"description", "reliability of the value"}};
  parts["kind"].update(words_of(trusts));
  parts["range"] = {{"type", "array"},
                    {"items", range_schema(base::allowed(entry.about))},
                    {"minItems", 2},
                    {"maxItems", 2},
                    {"description", "[low, high], where sources differ"}};
  const bool frame_needed = frames.size() > 1 && !place.partial;
  Json table = {{"type", "object"}, {"properties", parts}, {"additionalProperties", false}};
  table["required"] = frame_needed ? Json::array({"value", "frame"}) : Json::array({"value"});
  if (frame_needed) return table;
  return {{"anyOf", {range_schema(base::allowed(entry.about)), table}}};
}

Json list_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

/// Schema of a list of words, or of the word alone if there is only one.
Json words_or_one(const Json& word) { return {{"anyOf", {list_of(word), word}}}; }

Json known_columns() {
  std::vector<std::pair<std::string, std::string>> names;
  const auto& linear = study::all_columns(design::MotorKind::linear);
  for (const study::Column& column : study::all_columns()) names.emplace_back(column.name, column.meaning);
  for (std::size_t n = 0; n < linear.size(); ++n)
    if (linear[n].name != names[n].first) names.emplace_back(linear[n].name, linear[n].meaning);
  return one_of(names);
}

std::vector<std::pair<std::string, std::string>> all_words(const KeyEntry& entry) {
  std::vector<std::pair<std::string, std::string>> words = entry.choices;
  for (const KeyEntry::LinearChoice& own : entry.linear_choices) words.emplace_back(own.word, own.meaning);
  return words;
}

/// Schema of a motor's name: suggests built-in names, and allows any path.
Json motor_names() {
  return {{"anyOf", {words_of(built_in_motors()), {{"type", "string"}, {"minLength", 1}}}}};
}

Json table(const std::string& path, const Place& place);

Json value_of(const KeyEntry& entry, const Place& place) {
  switch (entry.type) {
    case KeyType::number:
      return range_schema(base::allowed(entry.about));
    case KeyType::whole_number:
      return whole_number(base::allowed(entry.about));
    case KeyType::flag:
      return {{"type", "boolean"}};
    case KeyType::text:
      return entry.path == "motor" ? motor_names() : Json{{"type", "string"}};
    case KeyType::numbers:
      return list_of(range_schema(base::allowed(entry.about)));
    case KeyType::texts:
      if (entry.path == "vary.values") return list_of({{"type", {"number", "string", "boolean"}}});
      return words_or_one(entry.path == "record.columns" ? known_columns() : Json{{"type", "string"}});
    case KeyType::word:
      return one_of(all_words(entry));
    case KeyType::quantity:
      return quantity(entry, place);
    case KeyType::table:
      return table(entry.path, {place.keys, place.partial || entry.about.partial});
    case KeyType::list:
      return list_of(table(entry.path, place));
  }
  return {};
}

/// The text that an editor shows for the key.
std::string description(const KeyEntry& entry) {
  std::string text(entry.about.meaning);
  if (!entry.about.unit.empty()) text += fmt::format(", in {}", entry.about.unit);
  if (!entry.about.frame.empty()) text += fmt::format(", frame {}", entry.about.frame);
  return text;
}

Json schema_of(const KeyEntry& entry, const Place& place) {
  Json schema = {{"description", description(entry)}};
  schema.update(value_of(entry, place));
  // Defaults are written as TOML; numbers, words and flags are the same in JSON.
  if (const Json given = Json::parse(entry.default_value, nullptr, false); !given.is_discarded())
    schema["default"] = given;
  return schema;
}

/// A table with this key needs no other one.
void require_unless(Json& schema, const char* key) {
  if (!schema["properties"].contains(key) || !schema.contains("required")) return;
  schema["if"] = {{"required", Json::array({key})}};
  schema["else"] = {{"required", schema["required"]}};
  schema.erase("required");
}

Json table(const std::string& path, const Place& place) {
  Json properties = Json::object(), required = Json::array();
  for (const KeyEntry* entry : keys_in(place.keys, path)) {
    properties[std::string(name_of(*entry))] = schema_of(*entry, place);
    for (const base::Spelling& spelling : entry->about.also)
      properties[std::string(spelling.key)] = schema_of(spelled(*entry, spelling), place);
    if (entry->about.required && !place.partial) required.push_back(name_of(*entry));
  }
  Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  require_unless(schema, "file");  // a recording in place of a value
  return schema;
}

std::string document(const std::vector<KeyEntry>& keys, const char* title) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", title},
                 {"$comment", "written by sixstep schema, version " SIXSTEP_VERSION}};
  Json root = table("", {keys});
  require_unless(root, "extends");  // the other file may have the key
  schema.update(root);
  return schema.dump(1) + "\n";
}

}  // namespace

std::string scenario_schema() { return document(scenario_keys(), "sixstep scenario"); }
std::string motor_schema() { return document(sheet_keys(), "sixstep motor"); }
std::string plan_schema() { return document(plan_keys(), "sixstep plan"); }

}  // namespace text
