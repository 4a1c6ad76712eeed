// SPDX-License-Identifier: Apache-2.0
#include "text/keys/template_line.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/keys/key_advice.hpp"
#include "text/keys/key_tree.hpp"

namespace text {
namespace {

constexpr std::size_t comment_column = 32, most_words = 6;

/// The range in words: "above 0", "in 0 to 1"; empty for an unlimited range.
std::string range_text(const KeyEntry& entry) {
  const bool numeric = entry.type == KeyType::number || entry.type == KeyType::whole_number ||
                       entry.type == KeyType::numbers || entry.type == KeyType::quantity;
  if (!numeric || limit_of(entry.about.range) == limit_of({})) return "";
  const std::string text = limit_of(entry.about.range);
  std::string_view rest = text;
  for (const std::string_view start : {"must be ", "must lie in ", "must lie "})
    if (rest.starts_with(start)) rest.remove_prefix(start.size());
  return std::string(rest);
}

std::string explanation(const KeyEntry& entry, std::string_view more) {
  std::string text(meaning_of(entry));
  if (!entry.about.unit.empty()) text.append(fmt::format(" [{}]", entry.about.unit));
  if (const std::string range = range_text(entry); !range.empty()) text.append(", ").append(range);
  if (!more.empty()) text.append("; ").append(more);
  return text;
}

/// The words with their meanings, one per line; for a long enumeration only the words.
std::string words_comment(const KeyEntry& entry) {
  if (entry.choices.size() < 2) return "";
  std::size_t width = 0;
  std::string names;
  for (const auto& [word, meaning] : entry.choices) {
    width = std::max(width, word.size());
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", word);
  }
  if (entry.choices.size() > most_words) return wrapped_comment("  " + names, 2);
  std::string text;
  for (const auto& [word, meaning] : entry.choices)
    text += wrapped_comment(fmt::format("  {:<{}}  {}", fmt::format("\"{}\"", word), width + 2, meaning),
                            width + 7);
  return text;
}

}  // namespace

std::string wrapped_comment(std::string_view text, std::size_t indent) {
  std::string out, line = "#";
  while (!text.empty()) {
    const std::size_t cut = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, cut);
    text.remove_prefix(std::min(cut + 1, text.size()));
    if (line.size() + 1 + word.size() > template_width) {
      out += line + "\n";
      line.assign(1, '#');
      line.append(indent, ' ');
    }
    line.append(1, ' ').append(word);
  }
  return out + line + "\n";
}

std::string template_line(const KeyEntry& entry, const TemplateLine& line) {
  const std::string text = fmt::format("{}{} = {}", line.open ? "" : "# ", line.key, line.value);
  if (!line.explained) return text + "\n";
  const std::string meaning = explanation(entry, line.more);
  std::string beside = fmt::format("{:<{}}  # {}\n", text, comment_column, meaning);
  if (entry.choices.size() < 2 && beside.size() <= template_width + 1) return beside;
  return wrapped_comment(meaning) + words_comment(entry) + text + "\n";
}

}  // namespace text
