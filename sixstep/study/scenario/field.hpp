// SPDX-License-Identifier: Apache-2.0
// How a field-oriented drive (control/field/) holds its currents, as a scenario says it. What each key means stands in
// field_description.hpp.
#pragma once
#include <optional>

#include "sixstep/control/field/field_current.hpp"

namespace sixstep::study {

struct Field {
  std::optional<double> bandwidth_Hz;
  control::VoltageLimit voltage_limit = control::VoltageLimit::circle;
  bool decoupling = true;
  bool torque_per_ampere = true;
  std::optional<double> weakening_A;
  std::optional<double> advance_periods;
  bool operator==(const Field&) const = default;
};

}  // namespace sixstep::study
