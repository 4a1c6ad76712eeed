// SPDX-License-Identifier: Apache-2.0
// modelDescription.xml of a scenario as a functional mock-up unit for co-simulation, and the texts of its resources.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/study/scenario/scenario.hpp"
#include "text/export/fmi_variables.hpp"
#include "text/rooms.hpp"

namespace text {

struct UnitTexts {
  std::string identifier;   ///< of the binary and in C: "drive"
  std::string description;  ///< modelDescription.xml
  std::string variables;    ///< resources/variables.txt, for faces/fmu/drive_files.c
  std::string scenario;     ///< resources/scenario.toml; it names motor.toml
  std::string motor;        ///< resources/motor.toml
  std::string build;        ///< FMI 3: sources/buildDescription.xml
};

/// `name`: of the model, such as the scenario's file without its suffix. `sources`: files of sources/ to compile.
/// Requirements and comparisons are left out, as a unit has no verdict. Problems: the scenario cannot be run.
base::Result<UnitTexts> unit_texts(const study::Scenario& scenario, std::string_view name, FmiVersion version,
                                   FmiChip chip, const std::vector<std::string>& sources);

/// A name of C that begins with a letter.
std::string c_identifier(std::string_view name);

/// What the writers of both versions share.
struct UnitModel {
  const study::Scenario& scenario;
  std::string name, identifier, token;
  std::vector<FmiVariable> variables;
  std::vector<std::string> sources;

  /// The units of the variables, each once.
  std::vector<std::string> units() const;
};
std::string fmi2_description(const UnitModel& model);
std::string fmi3_description(const UnitModel& model);
/// sources/buildDescription.xml of FMI 3.
std::string fmi3_build(const UnitModel& model);
/// The content of BaseUnit and of DisplayUnit, which both versions share.
std::string fmi_unit_lines(const std::vector<std::string>& units);

}  // namespace text
