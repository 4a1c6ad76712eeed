// SPDX-License-Identifier: Apache-2.0
// Start and operation of a drive without a rotor sensor (control/sensorless/) in a scenario.
// sensorless_description.hpp describes each key.
#pragma once
#include <cstdint>

#include "sixstep/control/sensorless/observer.hpp"

namespace sixstep::study {

/// The signal that commutates the pairs.
enum class Commutates : std::uint8_t { back_emf, hall };

/// How the position of a rotor at rest is found.
enum class StartsBy : std::uint8_t { alignment, pulses };

struct Sensorless {
  double greatest_load = 0.5;
  double overload = 1.5;
  double lowest_part = 0.05;
  double advance_deg = 0.0;
  double blanking_s = 0.0;
  double mismatch = 0.0;
  control::Follow follows = control::Follow::crossings;
  bool catches_spin = true;
  StartsBy starts_by = StartsBy::alignment;
  Commutates commutates = Commutates::back_emf;  // [[at]] can change it during the run
  bool falls_back = true;
  bool operator==(const Sensorless&) const = default;
};

}  // namespace sixstep::study
