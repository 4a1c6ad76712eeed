// SPDX-License-Identifier: Apache-2.0
#include "text/recording/heading.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "text/keys/key_advice.hpp"
#include "text/keys/units.hpp"
#include "text/recording/cells.hpp"
#include "text/recording/known_names.hpp"

namespace text {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

constexpr std::pair<std::string_view, std::string_view> unit_words[] = {
    {"second", "s"},   {"sec", "s"},      {"v", "V"},          {"volt", "V"},     {"amp", "A"},
    {"ampere", "A"},   {"a", "A"},        {"mv", "mV"},        {"minute", "min"}, {"hertz", "Hz"},
    {"degree", "deg"}, {"radian", "rad"}, {"celsius", "degC"}, {"ohm", "ohm"},    {"percent", "%"},
    {"rpm", "rpm"},    {"hz", "Hz"},
};
constexpr std::pair<std::string_view, std::string_view> prefix_words[] = {
    {"pico", "p"}, {"nano", "n"}, {"micro", "u"}, {"milli", "m"}, {"kilo", "k"}, {"mega", "M"},
    {"p", "p"},    {"n", "n"},    {"u", "u"},     {"m", "m"},     {"k", "k"}};

/// The unit of a word such as "volt" or "volts".
std::string_view word_for(std::string_view small) {
  for (const auto& [word, unit] : unit_words)
    if (small == word || (word.size() > 2 && small.size() == word.size() + 1 && small.starts_with(word) &&
                          small.back() == 's'))
      return unit;
  return {};
}

/// Words for raw counts, scales of an instrument, and logarithms: they are no units of the measured quantity.
bool is_no_measure(std::string_view word) {
  constexpr std::string_view words[] = {"counts", "count",  "cnt",  "cnts",    "lsb",    "raw",  "adc",
                                        "ticks",  "digits", "div",  "dbv",     "dbmv",   "dbuv", "dbm",
                                        "db",     "pu",     "a.u.", "samples", "sample", "bits"};
  const std::string small = lower(word);
  return std::find(std::begin(words), std::end(words), small) != std::end(words);
}

bool is_number_of_a_place(std::string_view word) {
  return !word.empty() &&
         std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// A heading whose word is in a position in which only a unit is possible.
Heading with_word(std::string_view name, std::string_view word) {
  Heading out{std::string(bare_cell(name)), unit_in_words(word), {}, false};
  word = bare_cell(word);
  if (out.unit.empty() && !word.empty() && word != "-") out.odd_unit = std::string(word);
  return out;
}

/// A unit in brackets: "u_ab [V]", "(V)". But "V(a,b)" is a voltage in SPICE's notation, and "eRPM[0]" is the
/// first of several columns.
std::optional<Heading> in_brackets(std::string_view cell) {
  if (cell.empty() || (cell.back() != ']' && cell.back() != ')')) return {};
  const std::size_t open = cell.find_last_of(cell.back() == ']' ? '[' : '(');
  if (open == std::string_view::npos) return {};
  const std::string_view name = cell.substr(0, open), word = cell.substr(open + 1, cell.size() - open - 2);
  const bool apart = name.ends_with(' ');
  if (is_number_of_a_place(word) && !(apart && word == "1")) return Heading{std::string(cell), {}, {}, false};
  Heading out = with_word(name, word);
  if (!out.odd_unit.empty() && cell.back() == ')' && (name == "V" || name == "I"))
    return Heading{std::string(cell), name == "V" ? "V" : "A", {}, false};
  return out;
}

/// A unit after a word: "C1 in V", "in s" and "U / V".
std::optional<Heading> behind_a_word(std::string_view cell) {
  for (const std::string_view word : {" in ", " / "})
    if (const std::size_t at = cell.rfind(word); at != std::string_view::npos)
      return with_word(cell.substr(0, at), cell.substr(at + word.size()));
  if (lower(cell).starts_with("in ")) return with_word("", cell.substr(3));
  return {};
}

/// A heading that is only a unit: "microseconds", "ms". Single letters are names of phases, except s.
bool is_unit_alone(std::string_view cell) {
  if (cell.size() == 1) return cell == "s";
  const std::string unit = unit_in_words(cell);
  if (unit.empty()) return false;
  const Unit u = *unit_of(unit);
  return same_kind(u, *unit_of("s")) || same_kind(u, *unit_of("V"));
}

/// Words and letters that are no units if they follow a name: "current_in", "axis_10".
bool is_rather_a_word(std::string_view word) {
  constexpr std::string_view words[] = {"in", "inch", "ft",   "h",     "lb", "lbs", "oz",
                                        "kp", "KV",   "turn", "turns", "m",  "g"};
  return is_number_of_a_place(word) || std::find(std::begin(words), std::end(words), word) != std::end(words);
}

/// The unit in the pieces of a key, separated by underscores: "rad_s" and "N_m". Empty if the pieces are no
/// unit.
std::string unit_in_pieces(std::string_view pieces) {
  for (const char between : {'/', ' '}) {
    std::string unit(pieces);
    std::replace(unit.begin(), unit.end(), '_', between);
    if (unit = unit_in_words(unit); !unit.empty()) return unit;
  }
  return {};
}

/// A known name with a unit: "i_m_A" is i_m in A, not i in m/A; "i_m" has no unit.
std::optional<Heading> behind_a_known_name(std::string_view cell) {
  for (std::size_t at = cell.rfind('_'); at != std::string_view::npos && at > 0;
       at = cell.rfind('_', at - 1)) {
    if (!is_known_name(bare_name(cell.substr(0, at)))) continue;
    const std::string_view pieces = cell.substr(at + 1);
    if (std::string unit = unit_in_pieces(pieces); !unit.empty())
      return Heading{std::string(cell.substr(0, at)), std::move(unit), {}, pieces.size() == 1};
  }
  if (is_known_name(bare_name(cell))) return Heading{std::string(cell), {}, {}, false};
  return {};
}

/// A unit in pieces of a key that underscores separate: "speed_rad_s".
std::optional<Heading> behind_underscores(std::string_view cell) {
  const std::string_view name = without_unit(cell);
  if (name.empty() || name.size() == cell.size()) return {};
  const std::string_view pieces = cell.substr(name.size() + 1);
  std::string unit = unit_in_pieces(pieces);
  if (unit.empty()) return {};
  return Heading{std::string(name), std::move(unit), {}, pieces.size() == 1};
}

/// A unit as the last word: "CH1 mV", "CH1_mVolt", "u_ab, mV", "u_ab_counts", and "u_ab.v" as in Modelica.
std::optional<Heading> last_word(std::string_view cell) {
  const std::size_t cut = cell.find_last_of(" _.,");
  if (cut == std::string_view::npos || cut == 0 || cut + 1 == cell.size()) return {};
  const std::string_view word = cell.substr(cut + 1);
  std::string_view name = bare_cell(cell.substr(0, cut));
  if (name.ends_with(',')) name.remove_suffix(1);
  if (name.empty()) return {};
  if (is_no_measure(word)) return Heading{std::string(name), {}, std::string(word), false};
  // A lower-case letter is part of the name: "hall_v", "phase a".
  if (word.size() == 1 && cell[cut] != '.' && unit_of(word) == std::nullopt) return {};
  const std::string unit = unit_in_words(word);
  if (unit.empty() || is_rather_a_word(word)) return {};
  return Heading{std::string(name), unit, {}, word.size() == 1};
}

}  // namespace

std::string bare_name(std::string_view heading) {
  std::string out;
  for (const char c : heading)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string unit_in_words(std::string_view cell) {
  constexpr std::size_t longest_unit = 40;
  const std::size_t first = cell.find_first_not_of(" \t\"'()[]");
  if (first == std::string_view::npos || cell.size() > longest_unit) return {};
  const std::string_view bare = cell.substr(first, cell.find_last_not_of(" \t\"'()[]") - first + 1);
  if (const std::string_view unit = word_for(lower(bare)); bare.size() > 2 && !unit.empty())
    return std::string(unit);
  for (const std::string_view as_written : {bare, cell})
    if (std::string unit = plain_spelling(as_written); !unit.empty() && unit_of(unit)) return unit;
  const std::string small = lower(plain_spelling(bare));
  if (const std::string_view unit = word_for(small); !unit.empty()) return std::string(unit);
  if (small == "ms" || small == "us" || small == "ns")  // upper case is accepted in "uS", but not in "MS"
    return std::islower(static_cast<unsigned char>(bare[0])) != 0 || small != "ms" ? small : std::string();
  for (const auto& [word, letter] : prefix_words) {
    if (!small.starts_with(word) || small.size() < word.size() + 3) continue;
    std::string unit = std::string(letter) + std::string(word_for(small.substr(word.size())));
    if (unit.size() > letter.size() && unit_of(unit)) return unit;
  }
  return {};
}

Heading heading_of(std::string_view cell) {
  cell = bare_cell(cell);
  if (std::optional<Heading> found = in_brackets(cell)) return *found;
  if (std::optional<Heading> found = behind_a_word(cell)) return *found;
  if (is_unit_alone(cell)) {
    // V alone may also be the name of a column, but s alone is the time.
    const std::string unit = unit_in_words(cell);
    return {same_kind(*unit_of(unit), *unit_of("V")) ? std::string(cell) : std::string(), unit, {}, false};
  }
  std::optional<Heading> found;
  if (cell.find('_') != std::string_view::npos) found = behind_a_known_name(cell);
  if (!found) found = behind_underscores(cell);
  if (!found) found = last_word(cell);
  if (!found) return {std::string(cell), {}, {}, false};
  if (found->letter && found->unit != "V" && found->unit != "s") found->name = std::string(cell);
  return *found;
}

}  // namespace text
