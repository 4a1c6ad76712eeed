// SPDX-License-Identifier: Apache-2.0
#include "text/keys/key_tree.hpp"

#include "sixstep/base/linear.hpp"

#include <algorithm>

namespace text {

std::string_view name_of(const KeyEntry& entry) {
  const std::string_view path = entry.path;
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

std::vector<const KeyEntry*> keys_in(const std::vector<KeyEntry>& keys, std::string_view table) {
  std::vector<const KeyEntry*> inside;
  for (const KeyEntry& key : keys) {
    const std::size_t dot = key.path.rfind('.');
    const std::string_view parent =
        dot == std::string::npos ? std::string_view() : std::string_view(key.path).substr(0, dot);
    if (parent == table) inside.push_back(&key);
  }
  return inside;
}

std::vector<std::string> frames_of(std::string_view frame) {
  std::vector<std::string> frames;
  while (!frame.empty()) {
    const std::size_t cut = std::min(frame.find('|'), frame.size());
    frames.emplace_back(frame.substr(0, cut));
    frame.remove_prefix(std::min(cut + 1, frame.size()));
  }
  return frames;
}

KeyEntry spelled(const KeyEntry& entry, const base::Spelling& spelling) {
  KeyEntry other = entry;
  const std::size_t dot = entry.path.rfind('.');
  other.path = (dot == std::string::npos ? "" : entry.path.substr(0, dot + 1)) + std::string(spelling.key);
  if (!spelling.unit.empty()) other.about.unit = spelling.unit;
  if (!spelling.frame.empty()) other.about.frame = spelling.frame;
  if (!spelling.meaning.empty()) other.about.meaning = spelling.meaning;
  for (double* end : {&other.about.range.low, &other.about.range.high})
    if (spelling.linear && *end - *end == 0.0) *end = base::as_spelled(*end, spelling);
  other.about.also = {};
  return other;
}

std::vector<KeyEntry> in_linear_words(std::vector<KeyEntry> keys) {
  for (KeyEntry& key : keys) {
    if (const base::Spelling* linear = base::linear_spelling(key.about)) key = spelled(key, *linear);
    key.meaning = base::linear_words(std::string(key.about.meaning));
    for (auto& [word, meaning] : key.choices) {
      for (const KeyEntry::LinearChoice& own : key.linear_choices)
        if (own.turning == word) word = own.word;
      meaning = base::linear_words(meaning);
    }
  }
  return keys;
}

}  // namespace text
