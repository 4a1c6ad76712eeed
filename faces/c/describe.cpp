// SPDX-License-Identifier: Apache-2.0
#include "faces/c/describe.hpp"

#include <nlohmann/json.hpp>

#include "text/keys/key_catalog.hpp"

namespace c_face {

namespace {

using Json = nlohmann::ordered_json;

/// The signals as JSON. For a linear motor, each signal also has its name in files, its unit in files, and
/// the factor from the value to that unit.
Json signals(const Session& session) {
  Json list = Json::array();
  const std::vector<study::Column>& columns = study::all_columns();
  const std::vector<study::Column>& of_motor = study::all_columns(session.scenario()->sheet.kind);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    list.push_back({{"index", c},
                    {"name", columns[c].name},
                    {"unit", columns[c].unit},
                    {"frame", columns[c].frame},
                    {"meaning", columns[c].meaning},
                    {"applies", session.applies(static_cast<int>(c))}});
    if (of_motor[c].name != columns[c].name)
      list.back()["linear"] = {
          {"name", of_motor[c].name}, {"unit", of_motor[c].unit}, {"factor", of_motor[c].per_turning}};
  }
  return list;
}

/// The keys of [[at]], without the prefix "at." and without time_s.
Json changes() {
  constexpr std::string_view list_name = "at.";
  Json list = Json::array();
  for (const text::KeyEntry& key : text::scenario_keys()) {
    if (!key.path.starts_with(list_name) || key.type == text::KeyType::table || key.path == "at.time_s")
      continue;
    Json words = Json::array();
    for (const auto& [word, meaning] : key.choices) words.push_back({{"word", word}, {"meaning", meaning}});
    list.push_back({{"key", key.path.substr(list_name.size())},
                    {"unit", std::string(key.about.unit)},
                    {"meaning", std::string(key.about.meaning)},
                    {"words", words}});
  }
  return list;
}

}  // namespace

std::string described(const Session& session) {
  const study::Scenario& s = *session.scenario();
  const Json out = {{"version", SIXSTEP_VERSION},
                    {"duration_s", s.duration_s},
                    {"control_period_s", s.pwm.period_s},
                    {"signals", signals(session)},
                    {"changes", changes()}};
  return out.dump(1);
}

}  // namespace c_face
