// SPDX-License-Identifier: Apache-2.0
#include "text/keys/key_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "text/keys/sheet_words.hpp"
#include "text/keys/units.hpp"

namespace text {
namespace {

// Pieces of unit suffixes, valid or not. The unit of a key begins after the last piece that is not among
// these.
constexpr std::array unit_pieces = {
    "V",     "mV",   "kV",   "A",    "mA",      "uA",  "s",   "ms", "us", "ns",   "min", "h",    "ohm",
    "mohm",  "kohm", "H",    "mH",   "uH",      "F",   "uF",  "nF", "mF", "Hz",   "kHz", "MHz",  "rad",
    "deg",   "rpm",  "krpm", "rps",  "Nm",      "mNm", "Ncm", "kg", "g",  "m2",   "cm2", "gcm2", "kgm2",
    "kgcm2", "W",    "kW",   "J",    "percent", "per", "N",   "m",  "K",  "degC", "T",   "mm",   "cm",
    "Wb",    "mWb",  "uWb",  "Arms", "Vrms",    "s2",  "s3",  "m3", "Ah", "mAh",  "C",   "nC"};

bool is_unit_piece(std::string_view piece) {
  return std::find(unit_pieces.begin(), unit_pieces.end(), piece) != unit_pieces.end();
}

/// Both readings of a suffix: "_rad_s" as rad/s and "_kg_m2" as kg m2, because a key does not distinguish
/// them.
std::array<std::string, 2> readings(std::string_view suffix) {
  std::array<std::string, 2> units;
  if (suffix.starts_with('_')) suffix.remove_prefix(1);
  for (const char c : suffix) {
    units[0] += c == '_' ? '/' : c;
    units[1] += c == '_' ? ' ' : c;
  }
  return units;
}

std::string join(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

std::string conversion_text(std::string_view from_suffix, std::string_view to_suffix) {
  if (from_suffix == to_suffix) return "";
  for (const std::string& from : readings(from_suffix))
    for (const std::string& to : readings(to_suffix))
      if (const base::Result<double> one = in_unit("1 " + from, to); !from.empty() && one)
        return fmt::format(": 1 {} = {:.6g} {}", from, *one, to);
  for (const std::string& from : readings(from_suffix))
    if (const std::string_view measure = measure_in(from); !measure.empty())
      return fmt::format(", with a frame that is {}", measure);
  return "";
}

std::string_view unit_suffix(std::string_view key) { return key.substr(without_unit(key).size()); }

std::string quoted_alternatives(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t n = 0; n < words.size(); ++n)
    text += (n == 0 ? "" : n + 1 == words.size() ? " or " : ", ") + fmt::format("\"{}\"", words[n]);
  return text;
}

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        next[j] = std::min(next[j], before[j - 2] + 1);
    }
    before = row;
    row = next;
  }
  return row[b.size()];
}

std::string nearest(std::string_view word, std::span<const std::string> known) {
  int best = static_cast<int>(std::max<std::size_t>(word.size() / 3, 1)) + 1;
  std::string found;
  for (const std::string& candidate : known) {
    // A word whose length differs too much is skipped without a comparison of letters, because a word may
    // have ten million letters.
    const std::size_t longer = std::max(word.size(), candidate.size());
    if (longer - std::min(word.size(), candidate.size()) >= static_cast<std::size_t>(best)) continue;
    const int distance = edit_distance(word, candidate);
    if (distance < best) {
      best = distance;
      found = candidate;
    }
  }
  return found;
}

std::string nearest_word(std::string_view word, std::span<const std::string> known) {
  const auto meant = [&](std::string_view bare) {
    return std::find_if(known.begin(), known.end(),
                        [&](const std::string& candidate) { return without_unit(candidate) == bare; });
  };
  if (const auto same = meant(without_unit(word)); same != known.end()) return *same;
  if (std::string near = nearest(word, known); !near.empty()) return near;
  std::vector<std::string> bare;
  for (const std::string& candidate : known) bare.emplace_back(without_unit(candidate));
  if (const std::string near = nearest(without_unit(word), bare); !near.empty()) return *meant(near);
  // Finds abbreviations: "maximum" for max, "eff" for efficiency.
  const auto begun = std::find_if(bare.begin(), bare.end(), [&](std::string_view candidate) {
    return std::min(word.size(), candidate.size()) >= 3 &&
           (word.starts_with(candidate) || candidate.starts_with(word));
  });
  return begun == bare.end() ? "" : *meant(*begun);
}

std::string_view without_unit(std::string_view key) {
  while (true) {
    const std::size_t cut = key.rfind('_');
    if (cut == std::string_view::npos || cut == 0 || !is_unit_piece(key.substr(cut + 1))) return key;
    key = key.substr(0, cut);
  }
}

base::Problem unknown_key(std::string_view key, std::span<const std::string> known, std::string_view advice) {
  const std::string* same = nullptr;  // a known key that is equal except for the unit; of several, the most
                                      // similar
  for (const std::string& candidate : known)
    if (without_unit(candidate) == without_unit(key) && !unit_suffix(candidate).empty() &&
        (same == nullptr || edit_distance(candidate, key) < edit_distance(*same, key)))
      same = &candidate;
  if (same != nullptr)
    return {.limit = unit_suffix(key).empty() ? "lacks its unit" : "is not a key here",
            .cure = fmt::format("write the key as {} and give the value in the key's unit{}", *same,
                                conversion_text(unit_suffix(key), unit_suffix(*same)))};
  if (std::optional<std::string> meant = by_meaning(key, known))
    return {.limit = "is not a key here", .cure = std::move(*meant)};
  const std::string near = nearest(key, known);
  if (!near.empty()) return {.limit = "is not a key here", .cure = fmt::format("did you mean {}?", near)};
  constexpr std::size_t most_listed = 30;  // a motor file has some seventy keys
  std::vector<std::string> each;           // a key and its alias for linear motors may have one name
  for (const std::string& candidate : known)
    if (std::find(each.begin(), each.end(), candidate) == each.end()) each.push_back(candidate);
  const std::string all =
      each.size() > most_listed ? "sixstep help lists all keys" : "known are " + join(each);
  return {.limit = "is not a key here", .cure = advice.empty() ? all : std::string(advice)};
}

std::string shortest(double x) { return fmt::format("{}", x); }

}  // namespace text
