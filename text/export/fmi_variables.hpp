// SPDX-License-Identifier: Apache-2.0
// Lists the variables of a scenario as a functional mock-up unit (FMI): its inputs, and every signal that
// applies.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

enum class FmiKind { real, integer, text };
enum class FmiRole { time, input, output };

struct FmiVariable {
  std::string name;
  unsigned reference = 0;  ///< for a signal, its index in study::all_columns(), as in faces/fmu/drive.h
  FmiKind kind = FmiKind::real;
  FmiRole role = FmiRole::output;
  bool continuous = true;
  std::string unit{}, description{};
  double start = 0.0;   ///< start value of an input
  std::string key{};    ///< input: the key of [[at]] that it sets
  double factor = 1.0;  ///< output: factor from the rotary motor's unit to this unit
};

/// The variables: time, signals, inputs, digest. A quantity is an input if [[at]] may change it in this
/// scenario. Problems: those of opening the scenario.
base::Result<std::vector<FmiVariable>> fmi_variables(const study::Scenario& scenario);

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
