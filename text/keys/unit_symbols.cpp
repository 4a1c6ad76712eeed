// SPDX-License-Identifier: Apache-2.0
// Parses a unit: its symbols, prefixes and powers.
#include <algorithm>
#include <cctype>
#include <utility>

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

// The only table of units. A unit written as one word, such as Nm or gcm2, has its own entry.
constexpr Dimension plain{}, mass{1}, length{0, 1}, time{0, 0, 1}, current{0, 0, 0, 1},
    voltage{0, 0, 0, 0, 1}, kelvin{0, 0, 0, 0, 0, 1}, angle{0, 0, 0, 0, 0, 0, 1},
    celsius{0, 0, 0, 0, 0, 0, 0, 1}, speed{0, 0, -1, 0, 0, 0, 1},
    electrical_speed{0, 0, -1, 0, 0, 0, 0, 0, 1}, electrical_angle{0, 0, 0, 0, 0, 0, 0, 0, 1},
    force{1, 1, -2}, torque{1, 2, -2}, inertia{1, 2}, weighed{1, 1},
    energy{1, 2, -2, 0, 0, 0, 1},  // torque times angle
    resistance{0, 0, 0, -1, 1}, inductance{0, 0, 1, -1, 1}, capacity{0, 0, 1, 1, -1}, charge{0, 0, 1, 1},
    volt_second{0, 0, 1, 0, 1},
    linkage{0, 0, 1, 0, 1, 0, 0, 0, -1},  // flux linkage of a phase with the magnets: volts per electrical
                                          // rad/s
    density{0, -2, 1, 0, 1}, per_volt{0, 0, -1, 0, -1, 0, 1};

constexpr double inch = 0.0254, foot = 0.3048, pound = 0.45359237, ounce = pound / 16;
constexpr double lbf = pound * standard_gravity, ozf = ounce * standard_gravity;

constexpr Symbol symbols[] = {
    {"1", plain},
    {"10", plain, 1},
    {"%", plain, -2},
    {"percent", plain, -2},
    {"s", time, 0, 1, "munp"},
    {"sec", time, 0, 1, "mun"},
    {"min", time, 0, 60},
    {"h", time, 0, 3600},
    {"Hz", electrical_speed, 0, 2 * pi, "mkMG"},
    {"erpm", electrical_speed, 0, pi / 30, "k"},
    {"erad", electrical_angle},
    {"m", length, 0, 1, "muck"},
    {"in", length, 0, inch},
    {"inch", length, 0, inch},
    {"ft", length, 0, foot},
    {"g", mass, -3, 1, "mk"},
    {"Kg", mass},
    {"lb", mass, 0, pound},
    {"lbs", mass, 0, pound},
    {"oz", mass, 0, ounce},
    {"N", force, 0, 1, "muck"},
    {"lbf", force, 0, lbf},
    {"ozf", force, 0, ozf},
    {"gf", force, -3, standard_gravity, "k"},
    {"kp", force, 0, standard_gravity},
    {"W", {1, 2, -3, 0, 0, 0, 1}, 0, 1, "muk"},
    {"J", energy, 0, 1, "muk"},
    {"V", voltage, 0, 1, "mukM"},
    {"VDC", voltage},
    {"Vdc", voltage},
    {"Volt", voltage},
    {"Volts", voltage},
    {"volt", voltage},
    {"volts", voltage},
    {"A", current, 0, 1, "munk"},
    {"Amp", current},
    {"Amps", current},
    {"amp", current},
    {"amps", current},
    {"ohm", resistance, 0, 1, "mukM"},
    {"Ohm", resistance, 0, 1, "mukM"},
    {"ohms", resistance, 0, 1, "m"},
    {"Ohms", resistance, 0, 1, "m"},
    {"H", inductance, 0, 1, "mun"},
    {"F", capacity, 0, 1, "munp"},
    {"Ah", charge, 0, 3600, "mu"},
    {"C", charge, 0, 1, "munp"},
    {"Wb", linkage, 0, 1, "mu"},
    {"Vs", volt_second, 0, 1, "mu"},
    {"T", density, 0, 1, "m"},
    {"K", kelvin},
    {"degC", celsius},
    {"rad", angle, 0, 1, "m"},
    {"deg", angle, 0, pi / 180},
    {"rev", angle, 0, 2 * pi},
    {"turn", angle, 0, 2 * pi},
    {"turns", angle, 0, 2 * pi},
    {"rpm", speed, 0, pi / 30, "k"},
    {"rps", speed, 0, 2 * pi},
    {"KV", per_volt, 0, pi / 30},
    {"Nm", torque, 0, 1, "muck"},
    {"Ncm", torque, -2, 1, "m"},
    {"Nmm", torque, -3, 1, "m"},
    {"Nms", {1, 2, -1}, 0, 1, "mu"},
    {"gfcm", torque, -5, standard_gravity, "k"},
    {"kgfm", torque, 0, standard_gravity},
    {"ozin", weighed, 0, ounce* inch},
    {"inoz", weighed, 0, ounce* inch},
    {"lbin", weighed, 0, pound* inch},
    {"inlb", weighed, 0, pound* inch},
    {"lbft", weighed, 0, pound* foot},
    {"ftlb", weighed, 0, pound* foot},
    {"gcm", weighed, -5, 1, "k"},
    {"gm2", inertia, -3, 1, "k"},
    {"gcm2", inertia, -7, 1, "k"},
    {"gmm2", inertia, -9, 1, "k"},
    {"Kgcm2", inertia, -4},
    {"Kgm2", inertia},
    {"ozin2", inertia, 0, ounce* inch* inch},
    {"lbin2", inertia, 0, pound* inch* inch},
    {"lbft2", inertia, 0, pound* foot* foot},
};

constexpr std::string_view prefix_letters = "pnumckMG";
constexpr int prefix_tens[] = {-12, -9, -6, -3, -2, 3, 6, 9};

/// A symbol that ends in amperes or volts of one measure (rms, peak), as plain_spelling() writes it.
struct Measured {
  std::string_view ending;
  Base base;
};
constexpr Measured measures[] = {{"rms", Base::rms}, {"pk", Base::peak}};

std::optional<Unit> bare_symbol_of(std::string_view name) {
  for (const Symbol& s : symbols) {
    if (s.name == name) return Unit{s.dimension, s.ten, s.factor, s.name == "min" || s.name == "h"};
    if (!name.ends_with(s.name) || name.size() != s.name.size() + 1) continue;
    const char letter = name.front();
    if (s.prefixes.find(letter) != std::string_view::npos)
      return Unit{s.dimension, s.ten + prefix_tens[prefix_letters.find(letter)], s.factor};
  }
  return {};
}

std::optional<Unit> symbol_of(std::string_view name) {
  for (const Measured& m : measures) {
    if (!name.ends_with(m.ending)) continue;
    std::optional<Unit> unit = bare_symbol_of(name.substr(0, name.size() - m.ending.size()));
    if (!unit || (unit->dimension != current && unit->dimension != voltage)) continue;
    unit->power(m.base) = 1;
    return unit;
  }
  return bare_symbol_of(name);
}

void multiply(Unit& product, const Unit& by, int power) {
  for (std::size_t k = 0; k < product.dimension.size(); ++k) product.dimension[k] += power * by.dimension[k];
  product.ten += power * by.ten;
  product.by_the_clock = product.by_the_clock || by.by_the_clock;
  for (int n = 0; n < std::abs(power); ++n)
    product.factor = power > 0 ? product.factor * by.factor : product.factor / by.factor;
}

/// Multiplies by a symbol with an optional minus and digit, such as m2 or s-1.
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
  if (token == "1") return false;  // "12" is a number, not a 1 with a power
  const std::optional<Unit> base = symbol_of(token);
  if (base) multiply(product, *base, sign * power);
  return base.has_value();
}

/// Multiplies by powers joined by hyphens, which form one factor, such as oz-in-s2.
bool add_joined(std::string_view token, int sign, Unit& product) {
  while (true) {
    std::size_t cut = token.find('-');
    while (cut < token.size() &&
           (cut + 1 == token.size() || std::isdigit(static_cast<unsigned char>(token[cut + 1])) != 0))
      cut = token.find('-', cut + 1);
    if (!add_power(token.substr(0, cut), sign, product)) return false;
    if (cut >= token.size()) return true;
    token.remove_prefix(cut + 1);
  }
}

/// Reads a product: factor {(space | * | /) factor}. A factor is a list of powers joined by hyphens, or a
/// product in brackets. '/' divides only by the next factor.
class Product {
 public:
  explicit Product(std::string_view text) : rest_(text) {}
  std::optional<Unit> whole() {
    Unit product;
    if (!factors(1, 0, product) || !rest_.empty()) return {};
    // In a product, degC is a difference in kelvin; only degC alone is a temperature on the Celsius scale.
    if (product.dimension != celsius) product.power(Base::K) += std::exchange(product.power(Base::degC), 0);
    return product;
  }

 private:
  static constexpr int deepest = 4;
  bool factors(int outer, int depth, Unit& product) {
    int sign = outer;
    bool wants = true;  // true: a factor must follow
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
      rest_.remove_prefix(1);  // the bracket that ended the inner product
      return true;
    }
    const std::size_t end = std::min(rest_.find_first_of(" */()"), rest_.size());
    const std::string_view token = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return add_joined(token, sign, product);
  }
  std::string_view rest_;
};

}  // namespace

std::optional<Unit> unit_of(std::string_view text) {
  if (text.empty()) return Unit{};
  return Product(plain_spelling(text)).whole();
}

namespace {

struct Angle {
  int shaft = 0, electrical = 0;
  bool operator==(const Angle&) const = default;
};

Angle take_angle(Unit& unit) {
  return {std::exchange(unit.power(Base::rad), 0), std::exchange(unit.power(Base::electrical_rad), 0)};
}

/// Whether a unit may be written without its angle: V s for V/(rad/s), kg m2 for N m/(rad/s2).
bool left_out(const Angle& whole, const Dimension& rest) {
  constexpr Dimension drag{1, 2, -1};
  if (rest == volt_second || rest == drag) return whole == Angle{-1, 0};
  return rest == inertia && (whole == Angle{-1, 0} || whole == Angle{-2, 0});
}

}  // namespace

bool same_kind(const Unit& a, const Unit& b) {
  Unit from = a, to = b;
  const Angle in = take_angle(from), out = take_angle(to);
  if (from.dimension != to.dimension) return false;
  // Sheets write "mV min" for mV/min-1. One min-1 is 2 pi rad per minute, so that V s, which means V s/rad,
  // differs by 2 pi.
  const bool habit = left_out({-1, 0}, from.dimension);
  if (habit && ((in == Angle{} && from.by_the_clock) || (out == Angle{} && to.by_the_clock))) return false;
  if (in == out) return true;
  // a flux linkage: Wb is V s
  if (in == Angle{} && out == Angle{0, -1}) return from.dimension == volt_second;
  return (in == Angle{} && left_out(out, from.dimension)) || (out == Angle{} && left_out(in, from.dimension));
}

}  // namespace text
