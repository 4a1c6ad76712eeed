// SPDX-License-Identifier: Apache-2.0
// Pole pairs, from whatever a sheet counts: pairs, poles, or the winding's code.
#include <charconv>

#include "sixstep/design/sheet_reader.hpp"

namespace sixstep::design {
namespace {

struct Winding {
  int teeth = 0;
  int poles = 0;
};

/// "12N14P", in either case, spaces allowed between the two halves.
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
    reader.problem("winding", quoted(code), "is no winding code",
                   "write teeth and magnet poles as \"12N14P\"");
    return {};
  }
  if (winding->poles % 2 != 0) {
    reader.problem("winding", quoted(code),
                   "names " + std::to_string(winding->poles) + " poles, an odd number",
                   "count the magnets again: north and south come in pairs");
    return {};
  }
  if (winding->teeth % 3 != 0) {
    reader.problem("winding", quoted(code),
                   "names " + std::to_string(winding->teeth) + " teeth, which three phases cannot share",
                   "the code is teeth first, then poles: 12N14P");
    return {};
  }
  return winding->poles / 2;
}

}  // namespace

std::optional<int> read_pole_pairs(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  std::optional<int> by_winding = s.winding.empty() ? std::nullopt : of_winding(reader), by_poles;
  if (s.poles) {
    if (*s.poles < 2 || *s.poles % 2 != 0)
      reader.problem(
          "poles", std::to_string(*s.poles), "must be an even number from 2 on",
          "magnet poles come in pairs of north and south; if the sheet counts pairs, write pole_pairs");
    else
      by_poles = *s.poles / 2;
  }
  if (s.pole_pairs && *s.pole_pairs < 1) {
    reader.problem("pole_pairs", std::to_string(*s.pole_pairs), "must be at least 1",
                   "give the number of pole pairs (half the number of magnets' poles)");
    return {};
  }
  const bool from_code = by_winding && (!by_poles || by_winding == by_poles);
  if (by_winding && by_poles && !from_code)
    reader.problem("poles", std::to_string(*s.poles),
                   "contradicts winding = " + quoted(s.winding) + ", which has " +
                       std::to_string(2 * *by_winding) + " poles",
                   "keep the one that is right");
  const std::optional<int> other = by_winding ? by_winding : by_poles;
  const std::string other_text =
      by_winding ? "winding = " + quoted(s.winding) : "poles = " + std::to_string(s.poles.value_or(0));
  if (s.pole_pairs && other && *s.pole_pairs != *other) {
    const std::string pairs = std::to_string(*other);
    if (*s.pole_pairs == 2 * *other)
      reader.problem("pole_pairs", std::to_string(*s.pole_pairs), "is the number of poles of " + other_text,
                     "write pole_pairs = " + pairs);
    else
      reader.problem("pole_pairs", std::to_string(*s.pole_pairs),
                     "contradicts " + other_text + ", which has " + pairs + " pole pairs",
                     "keep the one that is right");
  }
  if (s.pole_pairs)
    reader.use("pole_pairs");
  else if (by_winding)
    reader.use("winding");
  else if (by_poles)
    reader.use("poles");
  return s.pole_pairs ? s.pole_pairs : other;
}

}  // namespace sixstep::design
