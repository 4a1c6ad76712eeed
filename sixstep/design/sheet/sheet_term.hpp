// SPDX-License-Identifier: Apache-2.0
// A number of a sheet with what rounding leaves open of it.
#pragma once
#include <optional>

#include "sixstep/design/sheet/sheet_constants.hpp"

namespace sixstep::design {

/// A value in any unit, and the relative doubt of its print: 0.01 is one percent either way. Products add doubts, powers multiply them.
struct Term {
  double value = 0.0;
  double doubt = 0.0;
};

inline Term operator*(Term a, Term b) { return {a.value * b.value, a.doubt + b.doubt}; }
inline Term operator/(Term a, Term b) { return {a.value / b.value, a.doubt + b.doubt}; }
inline Term operator*(Term a, double exact) { return {a.value * exact, a.doubt}; }
/// Of two that are not negative. A sum of nothing has no doubt.
inline Term operator+(Term a, Term b) {
  const double value = a.value + b.value;
  return {value, value > 0.0 ? (a.value * a.doubt + b.value * b.doubt) / value : 0.0};
}
/// Of a value and a smaller one.
inline Term operator-(Term a, Term b) {
  const double value = a.value - b.value;
  return {value, (a.value * a.doubt + b.value * b.doubt) / value};
}

/// A voltage that a sheet's values belong to is exact by definition, whatever its digits.
inline Term exact(double value) { return {value, 0.0}; }

/// A line of the sheet in `unit`; nothing where it is not there, or not above 0.
inline std::optional<Term> term(const std::optional<base::Quantity>& q, double unit = 1.0) {
  if (!q || !(q->value > 0.0)) return {};
  return Term{q->value * unit, relative_doubt(*q)};
}

}  // namespace sixstep::design
