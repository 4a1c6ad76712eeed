// SPDX-License-Identifier: Apache-2.0
#include "io/key_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace io {
namespace {

// Every piece a unit suffix may be made of, right or wrong ones: what follows the last other piece is the
// unit.
constexpr std::array unit_pieces = {
    "V",    "mV",   "kV",   "A",     "mA",   "uA",  "s",   "ms",      "us",  "ns", "min", "h",
    "ohm",  "mohm", "kohm", "H",     "mH",   "uH",  "F",   "uF",      "nF",  "mF", "Hz",  "kHz",
    "MHz",  "rad",  "deg",  "rpm",   "krpm", "rps", "Nm",  "mNm",     "Ncm", "kg", "g",   "m2",
    "cm2",  "gcm2", "kgm2", "kgcm2", "W",    "kW",  "J",   "percent", "per", "N",  "m",   "K",
    "degC", "T",    "mm",   "cm",    "Wb",   "mWb", "uWb", "Arms",    "Vrms"};

bool is_unit_piece(std::string_view piece) {
  return std::find(unit_pieces.begin(), unit_pieces.end(), piece) != unit_pieces.end();
}

struct Unit {
  std::string_view suffix;
  std::string_view shown;
  std::string_view of;  ///< the SI unit that it is a multiple of
  double times;
};
constexpr double rad_s_per_rpm = 0.10471975511965977;  // 2 pi/60
constexpr std::array units = {
    Unit{"V", "V", "V", 1},
    Unit{"mV", "mV", "V", 1e-3},
    Unit{"kV", "kV", "V", 1e3},
    Unit{"A", "A", "A", 1},
    Unit{"mA", "mA", "A", 1e-3},
    Unit{"uA", "uA", "A", 1e-6},
    Unit{"s", "s", "s", 1},
    Unit{"ms", "ms", "s", 1e-3},
    Unit{"us", "us", "s", 1e-6},
    Unit{"ns", "ns", "s", 1e-9},
    Unit{"min", "min", "s", 60},
    Unit{"ohm", "ohm", "ohm", 1},
    Unit{"mohm", "mohm", "ohm", 1e-3},
    Unit{"kohm", "kohm", "ohm", 1e3},
    Unit{"H", "H", "H", 1},
    Unit{"mH", "mH", "H", 1e-3},
    Unit{"uH", "uH", "H", 1e-6},
    Unit{"F", "F", "F", 1},
    Unit{"mF", "mF", "F", 1e-3},
    Unit{"uF", "uF", "F", 1e-6},
    Unit{"nF", "nF", "F", 1e-9},
    Unit{"Hz", "Hz", "Hz", 1},
    Unit{"kHz", "kHz", "Hz", 1e3},
    Unit{"MHz", "MHz", "Hz", 1e6},
    Unit{"rad_s", "rad/s", "rad/s", 1},
    Unit{"rpm", "rpm", "rad/s", rad_s_per_rpm},
    Unit{"krpm", "krpm", "rad/s", 1e3 * rad_s_per_rpm},
    Unit{"rps", "rps", "rad/s", 60 * rad_s_per_rpm},
    Unit{"rad", "rad", "rad", 1},
    Unit{"deg", "deg", "rad", rad_s_per_rpm / 6},
    Unit{"Nm", "N m", "N m", 1},
    Unit{"mNm", "mN m", "N m", 1e-3},
    Unit{"Ncm", "N cm", "N m", 1e-2},
    Unit{"kg_m2", "kg m2", "kg m2", 1},
    Unit{"kgm2", "kg m2", "kg m2", 1},
    Unit{"gcm2", "g cm2", "kg m2", 1e-7},
    Unit{"kgcm2", "kg cm2", "kg m2", 1e-4},
};

const Unit* unit_of(std::string_view suffix) {
  if (suffix.starts_with('_')) suffix.remove_prefix(1);
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const Unit& unit) { return unit.suffix == suffix; });
  return found == units.end() ? nullptr : &*found;
}

/// ": 1 mV = 0.001 V", where both are units of the same thing.
std::string conversion(std::string_view from_suffix, std::string_view to_suffix) {
  const Unit *from = unit_of(from_suffix), *to = unit_of(to_suffix);
  if (!from || !to || from->of != to->of || from->shown == to->shown) return "";
  return fmt::format(": 1 {} = {:.6g} {}", from->shown, from->times / to->times, to->shown);
}

std::string_view unit_suffix(std::string_view key) { return key.substr(without_unit(key).size()); }

std::string join(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

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
  const std::string near = nearest(without_unit(word), bare);
  return near.empty() ? near : *meant(near);
}

std::string_view without_unit(std::string_view key) {
  while (true) {
    const std::size_t cut = key.rfind('_');
    if (cut == std::string_view::npos || cut == 0 || !is_unit_piece(key.substr(cut + 1))) return key;
    key = key.substr(0, cut);
  }
}

base::Problem unknown_key(std::string_view key, std::span<const std::string> known) {
  const std::string* same = nullptr;  // but for the unit; of several the most alike
  for (const std::string& candidate : known)
    if (without_unit(candidate) == without_unit(key) && !unit_suffix(candidate).empty() &&
        (same == nullptr || edit_distance(candidate, key) < edit_distance(*same, key)))
      same = &candidate;
  if (same != nullptr)
    return {.limit = unit_suffix(key).empty() ? "lacks its unit" : "carries the wrong unit",
            .cure = fmt::format("write {} and give the value in that unit{}", *same,
                                conversion(unit_suffix(key), unit_suffix(*same)))};
  const std::string near = nearest(key, known);
  if (!near.empty()) return {.limit = "is not a key here", .cure = fmt::format("did you mean {}?", near)};
  return {.limit = "is not a key here", .cure = "known are " + join(known)};
}

std::string limit_of(const base::Range& range) {
  const bool low = range.low - range.low == 0.0, high = range.high - range.high == 0.0;
  if (!low && !high) return "must be a finite number";
  if (low && high && range.low_included && range.high_included)
    return fmt::format("must lie in {} to {}", range.low, range.high);
  if (low && high && !range.low_included && !range.high_included)
    return fmt::format("must lie strictly between {} and {}", range.low, range.high);
  std::string text = "must be";
  if (low) text += fmt::format(" {} {}", range.low_included ? "at least" : "above", range.low);
  if (high)
    text += fmt::format("{} {} {}", low ? " and" : "", range.high_included ? "at most" : "below", range.high);
  return text;
}

std::string shortest(double x) { return fmt::format("{}", x); }

}  // namespace io
