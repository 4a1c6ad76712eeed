// SPDX-License-Identifier: Apache-2.0
// Lists all keys of a file as data, for help texts, tables and forms.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sixstep/base/describe.hpp"
#include "text/rooms.hpp"

namespace text {

enum class KeyType { number, whole_number, flag, text, numbers, texts, word, quantity, table, list };

struct KeyEntry {
  std::string path;  ///< "supply.voltage_V"; keys of lists as "require.metric"
  KeyType type = KeyType::number;
  base::About about;
  bool optional = false;        ///< true: the key may be omitted, and then has no value
  std::string default_value{};  ///< as TOML; empty if there is no default
  std::vector<std::pair<std::string, std::string>> choices{};  ///< the words with their meanings
  struct LinearChoice {
    std::string turning, word, meaning;
  };
  std::vector<LinearChoice> linear_choices{};  ///< words of a linear motor's file that replace some choices
  std::string meaning{};                       ///< meaning for a linear motor; empty: about.meaning
};

// All keys of a scenario. The list is made only once, because a plan reads a file for each of its points.
const std::vector<KeyEntry>& scenario_keys();
const std::vector<KeyEntry>& sheet_keys();
const std::vector<KeyEntry>& plan_keys();

/// The entry of a key or of one of its other spellings; null if unknown.
const KeyEntry* find_key(const std::vector<KeyEntry>& keys, std::string_view path);
/// The unit of the key in this spelling; empty if the key is unknown.
std::optional<std::string> key_unit(const std::vector<KeyEntry>& keys, std::string_view path);

/// Meaning, unit, range and default of one key, in a few lines.
std::string help_text(const KeyEntry& entry);

}  // namespace text
