// SPDX-License-Identifier: Apache-2.0
// Current control of a field-oriented drive (control/field/) in a scenario. field_description.hpp describes
// each key.
#pragma once
#include <optional>

#include "sixstep/control/field/field_current.hpp"

namespace sixstep::study {

/// Source of the magnet's angle.
enum class FieldAngle : std::uint8_t { sensors, injection, observer, injection_observer };
/// The current controller: field_current.hpp or finite_set.hpp of control/field/.
enum class FieldLaw : std::uint8_t { pi, finite_set };

struct Field {
  std::optional<double> bandwidth_Hz;
  control::VoltageLimit voltage_limit = control::VoltageLimit::circle;
  bool decoupling = true;
  bool torque_per_ampere = true;
  std::optional<double> weakening_A;
  std::optional<double> advance_periods;
  FieldAngle angle = FieldAngle::sensors;
  std::optional<double> angle_bandwidth_Hz, injection_V, observer_from_rad_s, start_current_A;
  bool harmonic_current = false;
  FieldLaw law = FieldLaw::pi;
  double switching_weight_A = 0.0;
  std::optional<double> peak_A;
  bool delay_compensation = true;
  bool operator==(const Field&) const = default;
};

}  // namespace sixstep::study
