// SPDX-License-Identifier: Apache-2.0
// Arranges the flat list of keys in the tables of a file.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "text/keys/key_catalog.hpp"
#include "text/rooms.hpp"

namespace text {

/// The entries directly inside a table, in reading order; path "" is the file itself.
std::vector<const KeyEntry*> keys_in(const std::vector<KeyEntry>& keys, std::string_view table);

/// The last word of the path: "period_s" of "pwm.period_s".
std::string_view name_of(const KeyEntry& entry);

/// The meaning of a key, in the words of the entry's kind of motor.
inline std::string_view meaning_of(const KeyEntry& entry) {
  return entry.meaning.empty() ? entry.about.meaning : std::string_view(entry.meaning);
}

inline bool is_table(const KeyEntry& entry) {
  return entry.type == KeyType::table || entry.type == KeyType::list;
}

/// The frames that a key allows; empty if its value has only one meaning.
std::vector<std::string> frames_of(std::string_view frame);

/// The entry with the unit and frame of another spelling.
KeyEntry spelled(const KeyEntry& entry, const base::Spelling& spelling);

/// The keys of a linear motor's file, with its words, units and meanings.
std::vector<KeyEntry> in_linear_words(std::vector<KeyEntry> keys);

}  // namespace text
