// SPDX-License-Identifier: Apache-2.0
// What a unit is: its symbols, prefixes, powers and spellings.
#include <algorithm>

#include "sixstep/base/angle.hpp"
#include "text/keys/units.hpp"

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
    {"Ah", {0, 0, 1, 1}, 0, 3600, "mu"},
    {"C", {0, 0, 1, 1}, 0, 1, "munp"},
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

}  // namespace

std::string plain_spelling(std::string_view text) {
  std::string out(text);
  for (const Spelled& s : spellings)
    for (std::size_t at = out.find(s.as); at != std::string::npos; at = out.find(s.as, at + s.means.size())) {
      const bool within = at > 0 && s.as.ends_with("/min") && out[at - 1] >= 'a' && out[at - 1] <= 'z';
      if (!within) out.replace(at, s.as.size(), s.means);
    }
  return out;
}

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

}  // namespace text
