// SPDX-License-Identifier: Apache-2.0
// Which current a report looks at: what the drive holds, or the largest of the phases where none of the columns is that.
#pragma once
#include <optional>
#include <vector>

#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// Of a field-oriented drive that across the magnet, else of the driven pair. By the drive and not by the columns: a trace of every event
/// has those of all drives.
struct HeldCurrent {
  const char *title, *column, *reference, *label, *reference_label;
  /// The column i_m is of the pair that suits the rotor, and the drive may have another one on: the largest |i| of the phases, and the
  /// magnitude of the reference. No column then.
  bool of_phases = false;
};
HeldCurrent held_by(const sixstep::study::Scenario& scenario);

/// At each row; empty where the trace does not have it.
std::optional<std::vector<double>> held_values(const sixstep::study::Trace& trace, const HeldCurrent& held);
std::optional<std::vector<double>> asked_values(const sixstep::study::Trace& trace, const HeldCurrent& held);

}  // namespace report
