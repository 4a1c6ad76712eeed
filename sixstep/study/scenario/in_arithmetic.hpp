// SPDX-License-Identifier: Apache-2.0
// Maps control.arithmetic to the controller's number type; this is the only switch over the arithmetics.
#pragma once
#include <utility>

#include "sixstep/control/fixed.hpp"
#include "sixstep/study/scenario/control.hpp"

namespace sixstep::study {

/// Calls `visit` with the number type as its template argument. `visit` must return the same type for every
/// number type. Example: `in_arithmetic(a, [&]<class Scalar>() { ... })`.
template <class Visit>
auto in_arithmetic(Arithmetic arithmetic, Visit&& visit) {
  switch (arithmetic) {
    case Arithmetic::float64:
      break;
    case Arithmetic::float32:
      return visit.template operator()<float>();
    case Arithmetic::q15:
      return visit.template operator()<control::Q15>();
    case Arithmetic::q14:
      return visit.template operator()<control::Q14>();
    case Arithmetic::q31:
      return visit.template operator()<control::Q31>();
    case Arithmetic::q30:
      return visit.template operator()<control::Q30>();
  }
  return visit.template operator()<double>();
}

}  // namespace sixstep::study
