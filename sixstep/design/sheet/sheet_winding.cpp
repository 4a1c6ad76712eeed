// SPDX-License-Identifier: Apache-2.0
// Reads the pole pairs from a sheet's pole pairs, poles, or winding code.
#include <charconv>

#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/design/sheet/sheet_reader.hpp"
#include "sixstep/design/sheet/winding_description.hpp"

namespace sixstep::design {
namespace {

constexpr const char* too_many = "must be at most 500";
static_assert(most_pole_pairs == 500);

struct Winding {
  int teeth = 0;
  int poles = 0;
};

/// Teeth and poles of a code such as "12N14P", in upper or lower case, optionally with spaces between its two
/// numbers.
std::optional<Winding> parsed(std::string_view text) {
  const auto number = [&](char letter) -> std::optional<int> {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    int count = 0;
    const std::from_chars_result end = std::from_chars(text.data(), text.data() + text.size(), count);
    if (end.ec != std::errc{} || end.ptr == text.data() + text.size()) return {};
    if ((*end.ptr | 0x20) != (letter | 0x20)) return {};
    text.remove_prefix(static_cast<std::size_t>(end.ptr - text.data()) + 1);
    return count;
  };
  const std::optional<int> teeth = number('N'), poles = teeth ? number('P') : std::nullopt;
  if (!poles || !text.empty() || *teeth < 1 || *poles < 1) return {};
  return Winding{*teeth, *poles};
}

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

std::optional<int> of_winding(SheetReader& reader) {
  const std::string& code = reader.sheet.winding;
  const std::optional<Winding> winding = parsed(code);
  if (!winding) {
    reader.problem("winding", quoted(code), "is not a winding code",
                   "write teeth and magnet poles as \"12N14P\"");
    return {};
  }
  if (winding->poles % 2 != 0) {
    reader.problem("winding", quoted(code),
                   "names " + std::to_string(winding->poles) + " poles, an odd number",
                   "count the magnets again: north and south poles are paired");
    return {};
  }
  if (winding->teeth % 3 != 0) {
    reader.problem("winding", quoted(code),
                   "names " + std::to_string(winding->teeth) + " teeth, not a multiple of 3",
                   "write the teeth first, then the poles: 12N14P");
    return {};
  }
  return winding->poles / 2;
}

std::optional<int> of_poles(SheetReader& reader) {
  const int poles = *reader.sheet.poles;
  if (poles >= 2 && poles % 2 == 0) return poles / 2;
  reader.problem(
      "poles", std::to_string(poles), "must be an even number from 2 on",
      "magnet poles come in pairs of north and south; if the sheet counts pairs, write pole_pairs");
  return {};
}

/// Compares the given pole pairs with `other`, the number from another line.
void compare(SheetReader& reader, int pole_pairs, int other, const std::string& other_line) {
  if (pole_pairs == other) return;
  const std::string pairs = std::to_string(other);
  if (pole_pairs == 2 * other)
    reader.problem("pole_pairs", std::to_string(pole_pairs), "is the number of poles of " + other_line,
                   "write pole_pairs = " + pairs);
  else
    reader.problem("pole_pairs", std::to_string(pole_pairs),
                   "contradicts " + other_line + ", which has " + pairs + " pole pairs",
                   "correct the key that is wrong");
}

}  // namespace

std::optional<double> read_pole_pitch(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  if (s.kind == MotorKind::rotary) {
    if (s.pole_pitch_mm)
      reader.wrong("pole_pitch_mm", *s.pole_pitch_mm, "applies to linear motors only, and kind is \"rotary\"",
                   "write kind = \"linear\", or give pole_pairs instead");
    return {};
  }
  for (const auto& [key, given] : {std::pair{"pole_pairs", s.pole_pairs.has_value()},
                                   {"poles", s.poles.has_value()},
                                   {"winding", !s.winding.empty()}})
    if (given)
      reader.problem(key, "", "applies to rotary motors only, and kind is \"linear\"",
                     "give pole_pitch_mm instead");
  if (!s.pole_pitch_mm) {
    reader.missing("pole_pitch_mm", "give the distance from one pole of the magnets to the next");
    return {};
  }
  reader.use("pole_pitch_mm");
  return SheetReader::positive(*s.pole_pitch_mm, -3);
}

std::optional<int> read_pole_pairs(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  if (s.kind == MotorKind::linear) return {};
  if (s.pole_pairs && (*s.pole_pairs < 1 || *s.pole_pairs > most_pole_pairs)) {
    reader.problem("pole_pairs", std::to_string(*s.pole_pairs),
                   *s.pole_pairs < 1 ? "must be at least 1" : too_many,
                   "give the number of pole pairs (half the number of magnets' poles)");
    return {};
  }
  std::optional<int> by_winding, by_poles;
  if (!s.winding.empty()) by_winding = of_winding(reader);
  if (s.poles) by_poles = of_poles(reader);
  const std::string winding = "winding = " + quoted(s.winding);
  if (by_winding && by_poles && *by_winding != *by_poles)
    reader.problem("poles", std::to_string(*s.poles),
                   "contradicts " + winding + ", which has " + std::to_string(2 * *by_winding) + " poles",
                   "correct the key that is wrong");
  const std::optional<int> other = by_winding ? by_winding : by_poles;
  if (other && *other > most_pole_pairs) {
    reader.problem(
        by_winding ? "winding" : "poles", by_winding ? quoted(s.winding) : std::to_string(*s.poles),
        "has " + std::to_string(*other) + " pole pairs, which " + too_many, "count the magnets again");
    return {};
  }
  if (s.pole_pairs && other)
    compare(reader, *s.pole_pairs, *other, by_winding ? winding : "poles = " + std::to_string(*s.poles));
  if (s.pole_pairs)
    reader.use("pole_pairs");
  else if (other)
    reader.use(by_winding ? "winding" : "poles");
  return s.pole_pairs ? s.pole_pairs : other;
}

}  // namespace sixstep::design
