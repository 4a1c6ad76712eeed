// SPDX-License-Identifier: Apache-2.0
// Reads the members of a described struct one by one, and distinguishes an absent optional member from a
// present one.
#include <type_traits>

#include "text/toml/table_reader.hpp"

namespace text {

template <class T>
void TableReader::read(std::string_view key, std::optional<T>& member, const base::About& about) {
  if (!any_spelling_in_file(key, about)) return absent(key, about);
  T present{};
  refused_ = false;
  if constexpr (std::is_same_v<T, double>)
    read(key, present, about);  // read() itself finds the spellings
  else
    read(spelling_in_file(key, about)->key, present, about);
  if constexpr (std::is_arithmetic_v<T>)
    if (refused_)
      present = static_cast<T>(within(about));  // the mistake has been reported; later checks treat the value
                                                // as given
  member = std::move(present);
}

void TableReader::read(std::string_view key, std::optional<base::Quantity>& member,
                       const base::About& about) {
  if (!any_spelling_in_file(key, about)) return absent(key, about);
  std::optional<base::Quantity> found = member ? member : base::Quantity{};
  read(key, *found, about);
  // An unreadable value does not reach later checks: they read an empty value, or the value that would have
  // been replaced.
  if (!complaints_.about(shown(at(found->key.empty() ? key : std::string_view(found->key))))) member = found;
}

void TableReader::visit_value(std::string_view key, const base::ValueMember& member,
                              const base::About& about) {
  std::visit([&](auto* of) { read(key, *of, about); }, member);
}

void TableReader::visit_quantity(std::string_view key, const base::QuantityMember& member,
                                 const base::About& about) {
  std::visit([&](auto* of) { read(key, *of, about); }, member);
}

std::string_view TableReader::of_other_motion(const base::WordMember& words,
                                              const base::WordMember::Word& word) const {
  if (!complaints_.linear_motor()) return word.turning;
  for (std::size_t n = 0; n < words.size(); ++n)
    if (const base::WordMember::Word other = words.at(n); other.turning == word.word) return other.word;
  return {};
}

void TableReader::visit_word(std::string_view key, base::WordMember& member, const base::About& about) {
  const toml::node* node = find(key, about);
  lost_word_ = lost_word_ || (!node && about.required);
  if (!node) return;
  // TOML reads a word of digits without quotes, as after --set, as a number.
  const toml::value<std::int64_t>* digits = node->as_integer();
  const std::optional<std::string> said = digits ? std::to_string(digits->get()) : node->value<std::string>();
  std::vector<std::string> words;
  for (std::size_t n = 0; n < member.size(); ++n) {
    const base::WordMember::Word word = member.at(n);
    const std::string_view instead = of_other_motion(member, word);
    if (said == word.word) {
      member.choose(n);
      if (!instead.empty()) complaints_.other_motion(at(key), "\"" + std::string(instead) + "\"");
      return;
    }
    if (instead.empty()) words.emplace_back(word.word);
  }
  lost_word_ = true;
  no_such_word(*node, key, words);
}

void TableReader::visit_table(std::string_view key, base::TableMember& member, const base::About& about) {
  if (member.is_optional()) {
    if (!given(key)) return absent(key, about);
    member.emplace();
  }
  const toml::table* inner = find_table(key, about);
  if (!inner) return;
  TableReader reader(*inner, at(key), complaints_, partial_ || about.partial, about.cure);
  member.walk(reader);
  reader.refuse_unknown_keys();
}

void TableReader::visit_list(std::string_view key, base::ListMember& member, const base::About& about) {
  const toml::array* items = find_tables(key, about);
  if (!items) return;
  member.resize(0);
  for (std::size_t n = 0; n < items->size(); ++n) {
    TableReader reader(*items->get(n)->as_table(), at(key) + "[" + std::to_string(n) + "]", complaints_,
                       partial_, about.cure);
    member.resize(n + 1);
    member.walk(n, reader);
    reader.refuse_unknown_keys();
  }
}

}  // namespace text
