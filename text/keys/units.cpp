// SPDX-License-Identifier: Apache-2.0
#include "text/keys/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sixstep/base/angle.hpp"
#include "text/keys/decimal_number.hpp"
#include "text/keys/key_advice.hpp"

namespace text {
namespace {

using sixstep::base::pi;

struct Symbol {
  std::string_view name;
  Dimension dimension;
  int ten = 0;
  double factor = 1.0;
  std::string_view prefixes = "";
};

// The one table of units. What is written together, Nm or gcm2, is a symbol of its own.
constexpr Dimension plain{}, mass{1}, length{0, 1}, time{0, 0, 1}, rate{0, 0, -1}, current{0, 0, 0, 1},
    angle{0, 0, 0, 0, 0, 1}, speed{0, 0, -1, 0, 0, 1}, torque{1, 2, -2}, inertia{1, 2}, flux{1, 2, -2, -1};
constexpr Symbol symbols[] = {
    {"1", plain},
    {"%", plain, -2},
    {"percent", plain, -2},
    {"s", time, 0, 1, "munp"},
    {"sec", time, 0, 1, "mun"},
    {"min", time, 0, 60},
    {"h", time, 0, 3600},
    {"Hz", rate, 0, 1, "mkMG"},
    {"m", length, 0, 1, "muck"},
    {"g", mass, -3, 1, "mk"},
    {"N", {1, 1, -2}, 0, 1, "muk"},
    {"W", {1, 2, -3}, 0, 1, "muk"},
    {"J", torque, 0, 1, "muk"},
    {"V", {1, 2, -3, -1}, 0, 1, "mukM"},
    {"A", current, 0, 1, "munk"},
    {"ohm", {1, 2, -3, -2}, 0, 1, "mukM"},
    {"Ohm", {1, 2, -3, -2}, 0, 1, "mukM"},
    {"H", {1, 2, -2, -2}, 0, 1, "mun"},
    {"F", {-1, -2, 4, 2}, 0, 1, "munp"},
    {"Wb", flux, 0, 1, "mu"},
    {"Vs", flux, 0, 1, "mu"},
    {"T", {1, 0, -2, -1}, 0, 1, "m"},
    {"K", {0, 0, 0, 0, 1}},
    {"degC", {0, 0, 0, 0, 0, 0, 1}},
    {"rad", angle, 0, 1, "m"},
    {"deg", angle, 0, pi / 180},
    {"rev", angle, 0, 2 * pi},
    {"rpm", speed, 0, pi / 30, "k"},
    {"Nm", torque, 0, 1, "muk"},
    {"Ncm", torque, -2, 1, "m"},
    {"Nms", {1, 2, -1}, 0, 1, "mu"},
    {"gm2", inertia, -3, 1, "k"},
    {"gcm2", inertia, -7, 1, "k"},
    {"gmm2", inertia, -9, 1, "k"},
};

constexpr std::string_view usual[] = {
    "s",     "ms",    "us",  "min",    "V",     "mV",      "kV",   "A",    "mA",    "ohm",    "mohm",
    "H",     "mH",    "uH",  "F",      "mF",    "uF",      "Hz",   "kHz",  "MHz",   "rad/s",  "rpm",
    "deg/s", "rad",   "deg", "Nm",     "mNm",   "Ncm",     "kgm2", "gcm2", "kgcm2", "Nms",    "mNm/rpm",
    "Nm/A",  "mNm/A", "Vs",  "V/krpm", "rpm/V", "rpm/mNm", "K/W",  "degC", "Wb",    "mWb",    "T",
    "mT",    "mm",    "cm",  "A/V",    "%",     "As/rad",  "A/s",  "A/ms", "rpm/s", "rad/s2", "deg/s2",
};

constexpr std::string_view prefix_letters = "pnumckMG";
constexpr int prefix_tens[] = {-12, -9, -6, -3, -2, 3, 6, 9};

struct Spelled {
  std::string_view as, means;
};
constexpr Spelled spellings[] = {
    {"µ", "u"},          {"μ", "u"},     {"Ω", "ohm"},         {"Ω", "ohm"},         {"°C", "degC"},
    {"°", "deg"},        {"²", "2"},     {"³", "3"},           {"·", "*"},           {"⁻¹", "-1"},
    {"^", ""},           {" per ", "/"}, {"1/min", "rev/min"}, {"min-1", "rev/min"}, {"r/min", "rev/min"},
    {"U/min", "rev/min"}};

/// Signs that few keyboards have, and the names that data sheets give to rpm.
std::string plain_spelling(std::string_view text) {
  std::string out(text);
  for (const Spelled& s : spellings)
    for (std::size_t at = out.find(s.as); at != std::string::npos; at = out.find(s.as, at + s.means.size())) {
      const bool within = at > 0 && s.as.ends_with("/min") && out[at - 1] >= 'a' && out[at - 1] <= 'z';
      if (!within) out.replace(at, s.as.size(), s.means);
    }
  return out;
}

std::optional<Unit> symbol_of(std::string_view name) {
  for (const Symbol& s : symbols) {
    if (s.name == name) return Unit{s.dimension, s.ten, s.factor};
    if (!name.ends_with(s.name) || name.size() != s.name.size() + 1) continue;
    const char letter = name.front();
    if (s.prefixes.find(letter) != std::string_view::npos)
      return Unit{s.dimension, s.ten + prefix_tens[prefix_letters.find(letter)], s.factor};
  }
  return {};
}

void multiply(Unit& product, const Unit& by, int power) {
  for (std::size_t k = 0; k < product.dimension.size(); ++k) product.dimension[k] += power * by.dimension[k];
  product.ten += power * by.ten;
  for (int n = 0; n < std::abs(power); ++n)
    product.factor = power > 0 ? product.factor * by.factor : product.factor / by.factor;
}

/// symbol [-] [digit], as m2 or s-1.
bool add_power(std::string_view token, int sign, Unit& product) {
  if (const std::optional<Unit> whole = symbol_of(token)) {
    multiply(product, *whole, sign);
    return true;
  }
  if (token.size() < 2 || token.back() < '1' || token.back() > '9') return false;
  int power = token.back() - '0';
  token.remove_suffix(1);
  if (token.back() == '-') {
    power = -power;
    token.remove_suffix(1);
  }
  const std::optional<Unit> base = symbol_of(token);
  if (base) multiply(product, *base, sign * power);
  return base.has_value();
}

/// factor {(space | * | /) factor}, a factor being a power or a product in brackets; '/' divides by the next
/// factor alone.
class Product {
 public:
  explicit Product(std::string_view text) : rest_(text) {}
  std::optional<Unit> whole() {
    Unit product;
    if (!factors(1, 0, product) || !rest_.empty()) return {};
    return product;
  }

 private:
  static constexpr int deepest = 4;
  bool factors(int outer, int depth, Unit& product) {
    int sign = outer;
    bool wants = true;  // a factor must come
    while (!rest_.empty() && rest_.front() != ')') {
      const char c = rest_.front();
      if (c == ' ' || c == '*' || c == '/') {
        rest_.remove_prefix(1);
        if (c != '/') continue;
        if (wants) return false;
        sign = -outer;
        wants = true;
        continue;
      }
      if (!factor(sign, depth, product)) return false;
      sign = outer;
      wants = false;
    }
    return !wants;
  }
  bool factor(int sign, int depth, Unit& product) {
    if (rest_.front() == '(') {
      rest_.remove_prefix(1);
      if (depth == deepest || !factors(sign, depth + 1, product) || rest_.empty()) return false;
      rest_.remove_prefix(1);  // the bracket that ended it
      return true;
    }
    const std::size_t end = std::min(rest_.find_first_of(" */()"), rest_.size());
    const std::string_view token = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return add_power(token, sign, product);
  }
  std::string_view rest_;
};

bool begins_a_number(std::string_view text) {
  const std::size_t at = text.find_first_not_of("+-");
  return at < 2 && (text[at] == '.' || (text[at] >= '0' && text[at] <= '9'));
}

/// The number times 10^ten, rounded once: the exponent moves, the digits stay.
std::optional<double> shifted(const std::string& number, int ten) {
  const std::size_t e = std::min(number.find_first_of("eE"), number.size());
  int exponent = 0;
  if (e < number.size()) {
    const char* digits = number.data() + e + (number[e + 1] == '+' ? 2 : 1);
    if (std::from_chars(digits, number.data() + number.size(), exponent).ec != std::errc()) return {};
  }
  const std::string text = fmt::format("{}e{}", number.substr(0, e), static_cast<long>(exponent) + ten);
  const DecimalNumber x = decimal_number(text);
  return x.kind == DecimalNumber::Kind::number ? std::optional(x.value) : std::nullopt;
}

std::string plain_number(std::string_view wanted) {
  return wanted.empty() ? "a plain number" : fmt::format("in {}", wanted);
}

/// Usual units of the same kind, the key's own first.
std::vector<std::string> fitting(std::string_view wanted) {
  const std::optional<Unit> unit = unit_of(wanted);
  std::vector<std::string> fit = {std::string(wanted)};
  for (const std::string_view candidate : usual)
    if (const auto u = unit_of(candidate);
        unit && u && u->dimension == unit->dimension && plain_spelling(wanted) != candidate)
      fit.emplace_back(candidate);
  return fit;
}

/// Of those that fit: "MS" was meant as ms, "rmp" as rpm.
std::string fitting_like(const std::string& unit, std::string_view wanted) {
  const auto small = [](std::string_view text) {
    std::string out(text);
    for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return out;
  };
  const std::vector<std::string> fit = fitting(wanted);
  for (const std::string& word : fit)
    if (small(word) == small(unit)) return word;
  return nearest(unit, fit);
}

base::Problem wrong_unit(const Written& w, std::string_view wanted) {
  if (w.unit.starts_with(','))
    return {.limit = "has a decimal comma", .cure = "write the decimal point as a point"};
  const bool known = unit_of(w.unit).has_value();
  if (wanted.empty())
    return {.limit = fmt::format("carries the {} {}, and this key is a plain number",
                                 known ? "unit" : "unknown unit", w.unit),
            .cure = "write the number alone, or in %"};
  const std::string fit = units_that_fit(wanted);
  if (known)
    return {.limit = fmt::format("carries the unit {}, which is not of the kind of {}", w.unit, wanted),
            .cure = "units that fit: " + fit};
  const std::string near = fitting_like(w.unit, wanted);
  return {.limit = fmt::format("carries an unknown unit, {}", w.unit),
          .cure = near.empty() ? "units that fit: " + fit
                               : fmt::format("did you mean {}? Units that fit: {}", near, fit)};
}

}  // namespace

std::optional<Unit> unit_of(std::string_view text) {
  if (text.empty()) return Unit{};
  return Product(plain_spelling(text)).whole();
}

bool same_kind(const Unit& a, const Unit& b) {
  constexpr std::size_t rad = 5;
  Dimension x = a.dimension;
  if (x[0] != 0) x[rad] = b.dimension[rad];
  return x == b.dimension;
}

std::optional<Written> split_number(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (text.empty() || !begins_a_number(text)) return {};
  if (text.front() == '+') text.remove_prefix(1);
  const std::size_t size = decimal_number(text).size;
  if (size == 0) return {};
  std::string_view rest = text.substr(size);
  const std::string number(text.substr(0, size));
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  return Written{number, std::string(rest)};
}

base::Result<double> in_unit(std::string_view written, std::string_view wanted) {
  const std::optional<Written> w = split_number(written);
  if (!w)
    return base::Problem{.limit = wanted.empty()
                                      ? "must be a number without quotes"
                                      : fmt::format("must be a number, {}, or one with its unit in "
                                                    "quotes",
                                                    plain_number(wanted))};
  if (w->unit.empty())
    return base::Problem{.limit = wanted.empty() ? "must be a number without quotes" : "lacks its unit",
                         .cure = wanted.empty() ? "write " + w->number
                                                : fmt::format("write {}, which is in {}, or \"{} {}\"",
                                                              w->number, wanted, w->number, wanted)};
  const std::optional<Unit> from = unit_of(w->unit), to = unit_of(wanted);
  if (!from || !to || !same_kind(*from, *to)) return wrong_unit(*w, wanted);
  const std::optional<double> x = shifted(w->number, from->ten - to->ten);
  if (!x) return base::Problem{.limit = "is beyond what a number holds", .cure = "look at its exponent"};
  return from->factor == to->factor ? *x : *x * from->factor / to->factor;
}

std::string units_that_fit(std::string_view wanted) {
  if (wanted.empty()) return {};
  const std::vector<std::string> fit = fitting(wanted);
  std::string text;
  for (std::size_t n = 0; n < fit.size(); ++n)
    text += (n == 0 ? "" : n + 1 == fit.size() ? " or " : ", ") + fit[n];
  return text;
}

}  // namespace text
