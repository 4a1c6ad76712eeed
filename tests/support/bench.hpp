// SPDX-License-Identifier: Apache-2.0
// The reference motor on the bench that holds its speed.
#pragma once
#include "sixstep/study/bench.hpp"
#include "tests/support/maxon.hpp"
#include "tests/support/scenarios.hpp"

namespace sixstep::testing {

inline study::Bench maxon_bench() {
  study::Bench b;
  b.motor = *design::motor_model(maxon_sheet());
  b.voltage_V = 24.0;
  return b;
}

/// The same motor with another shape of the back-EMF, K_t unchanged.
inline study::Bench shaped(design::BackEmfShape shape, double flat_deg) {
  design::Sheet sheet = maxon_sheet();
  sheet.back_emf = shape;
  sheet.flat_deg = flat_deg;
  study::Bench b = maxon_bench();
  b.motor = *design::motor_model(sheet);
  return b;
}

inline const char* name_of(control::Chopping c) {
  return c == control::Chopping::soft ? "soft" : c == control::Chopping::hard ? "hard" : "complementary";
}

}  // namespace sixstep::testing
