// SPDX-License-Identifier: Apache-2.0
// Writes modelDescription.xml of a scenario as a functional mock-up unit for co-simulation, and the texts of
// the unit's resources.
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
  std::string identifier;   ///< name of the binary and of its C functions: "drive"
  std::string description;  ///< text of modelDescription.xml
  std::string variables;    ///< text of resources/variables.txt, which faces/fmu/drive_files.c reads
  std::string scenario;     ///< text of resources/scenario.toml, which names motor.toml
  std::string motor;        ///< text of resources/motor.toml
  std::string build;        ///< FMI 3: text of sources/buildDescription.xml
};

/// Makes the texts. `name`: name of the model, such as the scenario's file without its suffix. `sources`:
/// files of sources/ to compile. Requirements and comparisons are left out, because a unit has no verdict.
/// Problems: the scenario cannot be run.
base::Result<UnitTexts> unit_texts(const study::Scenario& scenario, std::string_view name, FmiVersion version,
                                   FmiChip chip, const std::vector<std::string>& sources);

/// Converts a name to an identifier of C that begins with a letter.
std::string c_identifier(std::string_view name);

/// The data that the writers of both versions use.
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
/// The XML element UnitDefinitions with these units, which is the same in both versions.
std::string fmi_unit_lines(const std::vector<std::string>& units);

}  // namespace text
