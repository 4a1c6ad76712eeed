// SPDX-License-Identifier: Apache-2.0
// Normalises spellings of units: every symbol and name that sheets use becomes the symbol in the table of
// units.
#include <cctype>

#include "text/keys/units.hpp"

namespace text {
namespace {

struct Spelled {
  std::string_view as, means;
};

/// Symbols that are replaced at any position. Longer symbols come first.
constexpr Spelled unit_signs[] = {
    {"µ", "u"},      {"μ", "u"},     {"Ω", "ohm"},    {"Ω", "ohm"},    {"°C", "degC"},  {"ºC", "degC"},
    {"℃", "degC"},   {"°F", "degF"}, {"°", "deg"},    {"⁻", "-"},      {"¹", "1"},      {"²", "2"},
    {"³", "3"},      {"⁴", "4"},     {"⁵", "5"},      {"⁶", "6"},      {"⁷", "7"},      {"·", "-"},
    {"⋅", "-"},      {"∙", "-"},     {"•", "-"},      {"×", "*"},      {"‐", "-"},      {"‑", "-"},
    {"–", "-"},      {"−", "-"},     {"⁄", "/"},      {"∕", "/"},      {"\u00a0", " "}, {"\u202f", " "},
    {"\u2009", " "}, {"**", "^"},    {"^(-1)", "-1"}, {"^(-2)", "-2"}, {"^(2)", "2"},   {"^", ""},
    {" per ", "/"},
};

/// Names that are replaced only as whole words. A name is no whole word if a letter precedes its first
/// letter, if a digit precedes its first digit, or if a letter, digit or power follows it.
constexpr Spelled unit_names[] = {
    {"1/min", "rpm"},    {"min-1", "rpm"},      {"Min-1", "rpm"},     {"rev/min", "rpm"},
    {"revs/min", "rpm"}, {"r/min", "rpm"},      {"U/min", "rpm"},     {"tr/min", "rpm"},
    {"rot/min", "rpm"},  {"turn/min", "rpm"},   {"turns/min", "rpm"}, {"RPM", "rpm"},
    {"Rpm", "rpm"},      {"Upm", "rpm"},        {"rev/s", "rps"},     {"revs/s", "rps"},
    {"r/s", "rps"},      {"U/s", "rps"},        {"tr/s", "rps"},      {"turn/s", "rps"},
    {"turns/s", "rps"},  {"RPS", "rps"},        {"1000*rpm", "krpm"}, {"1000 rpm", "krpm"},
    {"1000rpm", "krpm"}, {"1,000 rpm", "krpm"}, {"1000/min", "krpm"}, {"k rpm", "krpm"},
    {"Krpm", "krpm"},    {"kRPM", "krpm"},      {"KRPM", "krpm"},     {"ERPM", "erpm"},
    {"eRPM", "erpm"},    {"e-rpm", "erpm"},     {"x10", "10"},        {"V DC", "VDC"},
    {"V dc", "VDC"},
};

constexpr std::string_view measure_names[][2] = {
    {"rms", "rms"}, {"eff", "rms"}, {"peak", "pk"}, {"pk", "pk"}};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

void replace_all(std::string& text, const Spelled& s) {
  for (std::size_t at = text.find(s.as); at != std::string::npos; at = text.find(s.as, at + s.means.size()))
    text.replace(at, s.as.size(), s.means);
}

void replace_words(std::string& text, const Spelled& s) {
  for (std::size_t at = text.find(s.as); at != std::string::npos; at = text.find(s.as, at + 1)) {
    const std::size_t end = at + s.as.size();
    const bool begins =
        at == 0 || !(is_letter(s.as.front()) ? is_letter(text[at - 1]) : is_digit(text[at - 1]));
    const bool power = end + 1 < text.size() && text[end] == '-' && is_digit(text[end + 1]);
    const bool ends = end == text.size() || (!is_letter(text[end]) && !is_digit(text[end]) && !power);
    // In "x10-4" the power belongs to the ten.
    if (begins && (ends || (s.means == "10" && power))) text.replace(at, s.as.size(), s.means);
  }
}

/// Joins symbols to one factor at a hyphen or point between two letters, as in rpm/oz-in. Removes other
/// points, which end abbreviations, and spaces next to a division sign.
std::string with_plain_gaps(const std::string& text) {
  std::string out;
  for (std::size_t n = 0; n < text.size(); ++n) {
    char c = text[n];
    const bool joins = n + 1 < text.size() && (is_letter(text[n + 1]) || text[n + 1] == '(');
    if (c == '.') c = joins ? '-' : ' ';
    if (c == '-' && !out.empty() && (out.back() == ' ' || out.back() == '-'))
      out.pop_back();  // as in "lb.-in" and "lb - in"
    if (c == ' ' && (out.empty() || std::string_view(" /*-").find(out.back()) != std::string_view::npos))
      continue;
    if ((c == '/' || c == '*') && !out.empty() && out.back() == ' ') out.pop_back();
    out += c;
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

bool same_letters(std::string_view text, std::string_view small) {
  for (std::size_t n = 0; n < small.size(); ++n)
    if (std::tolower(static_cast<unsigned char>(text[n])) != small[n]) return false;
  return true;
}

/// Joins a unit and its measure: "Arms" for "A rms", "A(RMS)" and "A_eff"; "Vpk" for "V peak".
void join_measures(std::string& text) {
  for (const auto& [name, means] : measure_names)
    for (std::size_t at = 1; at + name.size() <= text.size(); ++at) {
      std::size_t end = at + name.size(), from = at;
      if (!same_letters(std::string_view(text).substr(at, name.size()), name)) continue;
      const bool bracket = text[at - 1] == '(' && end < text.size() && text[end] == ')';
      if (bracket) ++end;
      if (bracket || text[at - 1] == ' ' || text[at - 1] == '_' || text[at - 1] == '-') --from;
      if (from > 0 && text[from - 1] == ' ') --from;  // a space as in "A (rms)"
      const bool ends = end == text.size() || (!is_letter(text[end]) && !is_digit(text[end]));
      if (!ends || from == 0 || (text[from - 1] != 'A' && text[from - 1] != 'V')) continue;
      text.replace(from, end - from, means);
    }
}

/// Adds the brackets that are meant: "V/rad/s" means V/(rad/s).
void bracket_speeds(std::string& text) {
  constexpr std::string_view speed = "/rad/s";
  for (std::size_t at = text.find(speed); at != std::string::npos; at = text.find(speed, at + 1)) {
    const std::size_t end = at + speed.size();
    if (at > 0 && (end == text.size() || text[end] == ' ' || text[end] == ')'))
      text.replace(at, speed.size(), "/(rad/s)");
  }
}

}  // namespace

std::string plain_spelling(std::string_view unit) {
  constexpr std::size_t longest = 64;  // no unit has more bytes, and replacing takes quadratic time
  std::string out(unit);
  if (out.size() > longest) return out;
  for (const Spelled& s : unit_signs) replace_all(out, s);
  out = with_plain_gaps(out);
  replace_words(out, {"sec", "s"});
  replace_words(out, {"minute", "min"});
  for (const Spelled& s : unit_names) replace_words(out, s);
  join_measures(out);
  bracket_speeds(out);
  return out;
}

}  // namespace text
