// SPDX-License-Identifier: Apache-2.0
// A number of a sheet with its rounding error.
#pragma once
#include <optional>

#include "sixstep/design/sheet/sheet_constants.hpp"

namespace sixstep::design {

/// A value in any unit, and the relative rounding error of its printed form: 0.01 is +-1 %. In a product the
/// relative errors add; in a power the exponent multiplies the error.
struct Term {
  double value = 0.0;
  double doubt = 0.0;
};

inline Term operator*(Term a, Term b) { return {a.value * b.value, a.doubt + b.doubt}; }
inline Term operator/(Term a, Term b) { return {a.value / b.value, a.doubt + b.doubt}; }
inline Term operator*(Term a, double exact) { return {a.value * exact, a.doubt}; }
/// Sum of two terms that are not negative. A sum of zero has no error.
inline Term operator+(Term a, Term b) {
  const double value = a.value + b.value;
  return {value, value > 0.0 ? (a.value * a.doubt + b.value * b.doubt) / value : 0.0};
}
/// Difference of a value and a smaller value.
inline Term operator-(Term a, Term b) {
  const double value = a.value - b.value;
  return {value, (a.value * a.doubt + b.value * b.doubt) / value};
}

/// A value without error, such as the voltage at which a sheet's values hold, which is exact by definition.
inline Term exact(double value) { return {value, 0.0}; }

/// A line of the sheet, multiplied by `unit`; empty if the line is missing or not above 0.
inline std::optional<Term> term(const std::optional<base::Quantity>& q, double unit = 1.0) {
  if (!q || !(q->value > 0.0)) return {};
  return Term{q->value * unit, relative_doubt(*q)};
}

}  // namespace sixstep::design
