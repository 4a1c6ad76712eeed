// SPDX-License-Identifier: Apache-2.0
// Lists the variables of a scenario as a functional mock-up unit (FMI): its inputs, and every signal that
// applies.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

enum class FmiKind { real, integer, boolean, text, clock };
enum class FmiRole { time, input, output, parameter };
enum class FmiVersion { fmi2, fmi3 };
/// The source of the gates: the scenario's controller, or inputs of the unit. The numbers equal those of
/// sixstep_chip.
enum class FmiChip { of_scenario = 0, pair = 1, legs = 2, gates = 3 };

struct FmiVariable {
  std::string name;
  unsigned reference = 0;  ///< for a signal, its index in study::all_columns(), as in faces/fmu/drive.h
  FmiKind kind = FmiKind::real;
  FmiRole role = FmiRole::output;
  bool continuous = true;
  std::string unit{}, description{};
  double start = 0.0;   ///< start value of an input
  std::string key{};    ///< input: the key of [[at]] that it sets
  double factor = 1.0;  ///< output: factor from the rotary motor's unit to `unit`
  int count = 1;        ///< FMI 3: number of elements of an array; their references follow `reference`
};

/// The variables in this order: time, signals, inputs, digest. A quantity is an input if [[at]] may change it
/// in this scenario. For a unit without the scenario's controller the list also contains the inputs of the
/// bridge and the quantities that a controller measures. In FMI 3 phases are arrays. Problems: the scenario
/// cannot be opened.
base::Result<std::vector<FmiVariable>> fmi_variables(const study::Scenario& scenario, FmiChip chip,
                                                     FmiVersion version);

/// The scenario with a dummy controller, because the importer controls the unit.
study::Scenario with_stand_in(study::Scenario scenario, FmiChip chip);
/// Whether the plant determines a signal, not the scenario's controller.
bool is_of_plant(study::ColumnId id, FmiChip chip);
/// Inputs for the bridge, measurements and counts of a unit without controller. References:
/// faces/fmu/plant.h.
void add_plant(const study::Scenario& scenario, FmiChip chip, FmiVersion version,
               std::vector<FmiVariable>& all);

/// A unit in FMI: its exponents of the SI's base units, and a display unit.
struct FmiUnit {
  std::string_view name;
  int kg = 0, m = 0, s = 0, A = 0, K = 0, rad = 0;
  double factor = 1.0, offset = 0.0;  ///< conversion to the base unit
  std::string_view display = "";      ///< display unit; empty: none
  double display_factor = 1.0;
};

/// The unit of this name; null if it is not in the table.
const FmiUnit* fmi_unit(std::string_view name);

}  // namespace text
