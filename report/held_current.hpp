// SPDX-License-Identifier: Apache-2.0
// Chooses the current that a report shows: the controlled current. If no column contains it, the largest
// phase current is shown.
#pragma once
#include <optional>
#include <vector>

#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// The current of the report: for a field-oriented drive the current i_q, else the current of the driven
/// pair. The kind of drive decides, not the columns, because a trace of every event contains the columns of
/// all drives.
struct HeldCurrent {
  const char *title, *column, *reference, *label, *reference_label;
  /// true: no column contains the current. The report then shows the largest |i| of the three phases, and the
  /// magnitude of the reference. Column i_m belongs to the pair of the rotor's sector and is not used,
  /// because the drive may drive another pair.
  bool of_phases = false;
};
HeldCurrent held_by(const sixstep::study::Scenario& scenario);

/// One value per row; empty if the trace does not contain the column.
std::optional<std::vector<double>> held_values(const sixstep::study::Trace& trace, const HeldCurrent& held);
std::optional<std::vector<double>> asked_values(const sixstep::study::Trace& trace, const HeldCurrent& held);

}  // namespace report
