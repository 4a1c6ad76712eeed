// SPDX-License-Identifier: Apache-2.0
// Chooses the current that a report shows: the controlled one; or, if no column holds it, the largest phase
// current.
#pragma once
#include <optional>
#include <vector>

#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// The current across the magnet's axis of a field-oriented drive, else that of the driven pair. The kind of
/// drive decides, not the columns, because a trace of every event has the columns of all drives.
struct HeldCurrent {
  const char *title, *column, *reference, *label, *reference_label;
  /// The shown current is the largest |i| of the phases, and the reference's magnitude, without a column.
  /// Column i_m is then not used: it belongs to the pair of the rotor's sector, and the drive may drive
  /// another pair.
  bool of_phases = false;
};
HeldCurrent held_by(const sixstep::study::Scenario& scenario);

/// One value per row; empty if the trace does not have the column.
std::optional<std::vector<double>> held_values(const sixstep::study::Trace& trace, const HeldCurrent& held);
std::optional<std::vector<double>> asked_values(const sixstep::study::Trace& trace, const HeldCurrent& held);

}  // namespace report
