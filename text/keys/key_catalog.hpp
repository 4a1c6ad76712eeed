// SPDX-License-Identifier: Apache-2.0
// All keys of a file as data, for help texts, tables and forms.
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
  bool optional = false;        ///< may be left out, and then nothing stands in its place
  std::string default_value{};  ///< as TOML; empty where there is none
  std::vector<std::pair<std::string, std::string>> choices{};  ///< words and meanings
  struct LinearChoice {
    std::string turning, word, meaning;
  };
  std::vector<LinearChoice> linear_choices{};  ///< words of a linear motor for some of these
  std::string meaning{};                       ///< in the words of a linear motor; empty: about.meaning
};

// Made once: a plan reads a file for each of its points.
const std::vector<KeyEntry>& scenario_keys();
const std::vector<KeyEntry>& sheet_keys();
const std::vector<KeyEntry>& plan_keys();

/// The entry of a key or of one of its other spellings; null where there is none.
const KeyEntry* find_key(const std::vector<KeyEntry>& keys, std::string_view path);
/// Its unit, as it is spelled; nothing where there is no such key.
std::optional<std::string> key_unit(const std::vector<KeyEntry>& keys, std::string_view path);

/// What a user wants to know of one key, in a few lines.
std::string help_text(const KeyEntry& entry);

}  // namespace text
