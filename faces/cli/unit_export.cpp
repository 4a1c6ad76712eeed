// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/unit_export.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <filesystem>
#include <optional>

#include "faces/cli/open_or_report.hpp"
#include "faces/cli/settings.hpp"
#include "faces/cli/terminal.hpp"
#include "faces/cli/unit_sources.hpp"
#include "faces/loop/installed.hpp"
#include "files/atomic_file.hpp"
#include "files/text_file.hpp"
#include "files/zip_file.hpp"
#include "text/export/fmi_description.hpp"

namespace cli {
namespace {

namespace fs = std::filesystem;

struct UnitArguments {
  std::string file;  ///< the scenario
  std::string out, fmi = "2", kind = "drive", inputs, data_dir, command;
  std::vector<std::string> sets;
  bool force = false;
};

/// A file of the unit's folder sources/, with the path by which the other files include it.
struct UnitSource {
  std::string path, text;
};

std::vector<UnitSource> unit_sources_of(int fmi) {
  namespace embedded = unit_sources;
  std::vector<UnitSource> own = {
      {"faces/fmu/drive.c", std::string(embedded::drive_c())},
      {"faces/fmu/drive_files.c", std::string(embedded::drive_files_c())},
      {"faces/fmu/drive_step.c", std::string(embedded::drive_step_c())},
      {"faces/fmu/plant.c", std::string(embedded::plant_c())},
      {"faces/fmu/plant.h", std::string(embedded::plant_h())},
      {"faces/fmu/drive.h", std::string(embedded::drive_h())},
      {"faces/c/sixstep.h", std::string(embedded::sixstep_h())},
      {"sixstep/control/own/own_controller.h", std::string(embedded::own_controller_h())}};
  const auto add = [&own](const char* name, std::string_view text) {
    own.push_back({std::string("faces/fmu/") + name, std::string(text)});
  };
  if (fmi == 2) {
    add("fmi2.c", embedded::fmi2_c());
    add("fmi2_types.h", embedded::fmi2_types_h());
  } else {
    add("fmi3.c", embedded::fmi3_c());
    add("fmi3_none.c", embedded::fmi3_none_c());
    add("fmi3_step.c", embedded::fmi3_step_c());
    add("fmi3_instance.h", embedded::fmi3_instance_h());
    add("fmi3_types.h", embedded::fmi3_types_h());
  }
  return own;
}

/// The shared object of a user's controller is packed into the unit. The unit's scenario names it without a
/// folder.
base::Result<std::optional<files::ZipEntry>> own_controller_of(const UnitArguments& a,
                                                               study::Scenario& scenario) {
  std::string& name = scenario.control.own.controller;
  if (scenario.control.drive != study::FirmwareKind::own || name.empty())
    return std::optional<files::ZipEntry>();
  const fs::path path = fs::path(a.file).parent_path() / name;
  base::Result<std::string> code = files::read_regular_text(path.string());
  if (!code)
    return base::Problem{"control.own.controller", path.string(), "cannot be put into the unit",
                         "keep the controller's file beside the scenario"};
  name = path.filename().string();
  return std::optional<files::ZipEntry>(
      {.name = "resources/" + name, .content = std::move(*code), .executable = true});
}

base::Result<std::string> unit_binary_of(int fmi) {
  const std::string path = loop::unit_binary(fmi);
  if (path.empty())
    return base::Problem{
        "export fmu", "",
        fmt::format("needs sixstep-fmi{0}.so, the library for units of FMI {0}, which is not installed", fmi),
        fmt::format(
            "install the package sixstep, or build the target sixstep_fmi{} with the CMake option SIXSTEP_C=ON",
            fmi)};
  return files::read_text(path);
}

struct UnitParts {
  text::UnitTexts texts;
  std::string binary;
  std::optional<files::ZipEntry> controller;
};

/// modelDescription.xml is the first entry and uncompressed: by these first bytes, the program recognises a
/// unit that it has written.
std::string archive_of(const UnitParts& parts, int fmi) {
  const std::string folder = fmi == 2 ? "binaries/linux64/" : "binaries/x86_64-linux/";
  std::vector<files::ZipEntry> entries = {
      {.name = "modelDescription.xml", .content = parts.texts.description, .packed = false},
      {.name = folder + parts.texts.identifier + ".so", .content = parts.binary, .executable = true},
      {.name = "resources/scenario.toml", .content = parts.texts.scenario},
      {.name = "resources/motor.toml", .content = parts.texts.motor},
      {.name = "resources/variables.txt", .content = parts.texts.variables}};
  if (parts.controller) entries.push_back(*parts.controller);
  for (const UnitSource& source : unit_sources_of(fmi))
    entries.push_back({.name = "sources/" + source.path, .content = source.text});
  if (fmi == 3) entries.push_back({.name = "sources/buildDescription.xml", .content = parts.texts.build});
  return files::zipped(entries);
}

/// Reads which part sets the gates of the unit.
base::Result<text::FmiChip> unit_chip_of(const UnitArguments& a) {
  if (a.kind != "drive" && a.kind != "plant")
    return base::Problem{
        "--kind", a.kind, "must be drive or plant",
        "use drive for a unit with the controller, or plant for a unit without the controller"};
  if (a.kind == "drive") {
    if (a.inputs.empty()) return text::FmiChip::of_scenario;
    return base::Problem{"--inputs", a.inputs, "has no effect on a unit of the kind drive",
                         "add --kind plant, or leave this option out"};
  }
  if (a.inputs.empty() || a.inputs == "gates") return text::FmiChip::gates;
  if (a.inputs == "pair") return text::FmiChip::pair;
  if (a.inputs == "legs") return text::FmiChip::legs;
  return base::Problem{"--inputs", a.inputs, "must be gates, pair or legs",
                       "use gates (six switches), pair (driven pair and duty) or legs (three legs)"};
}

base::Result<UnitParts> unit_parts_of(const UnitArguments& a, int fmi) {
  const base::Result<text::FmiChip> chip = unit_chip_of(a);
  if (!chip) return chip.problems();
  base::Problems problems;
  const files::ReadOptions options = read_options(a.data_dir, a.sets, problems);
  if (!problems.empty()) return problems;
  base::Result<study::Scenario> scenario = files::read_scenario(a.file, options);
  if (!scenario) return scenario.problems();
  base::Result<std::optional<files::ZipEntry>> controller = own_controller_of(a, *scenario);
  if (!controller) return controller.problems();
  std::vector<std::string> compiled;
  for (const UnitSource& source : unit_sources_of(fmi))
    if (source.path.ends_with(".c")) compiled.push_back(source.path);
  base::Result<text::UnitTexts> texts =
      text::unit_texts(*scenario, fs::path(a.file).stem().string(),
                       fmi == 2 ? text::FmiVersion::fmi2 : text::FmiVersion::fmi3, *chip, compiled);
  if (!texts) return texts.problems();
  base::Result<std::string> binary = unit_binary_of(fmi);
  if (!binary) return binary.problems();
  return UnitParts{std::move(*texts), std::move(*binary), std::move(*controller)};
}

Exit export_unit(const UnitArguments& a) {
  if (a.fmi != "2" && a.fmi != "3")
    return refused({{"--fmi", a.fmi, "must be 2 or 3", "use the version of FMI that your program imports"}});
  const int fmi = a.fmi[0] - '0';
  const base::Result<UnitParts> parts = unit_parts_of(a, fmi);
  base::Problems problems = parts ? base::Problems() : parts.problems();
  std::optional<files::AtomicFile> file;
  open_or_report(file, files::AtomicFile::create({a.out, a.force}), problems);
  if (!problems.empty()) return refused(problems);
  file->write(archive_of(*parts, fmi));
  if (problems = file->commit(); !problems.empty()) return refused(problems);
  return Exit::ok;
}

}  // namespace

Verb declare_unit_export(CLI::App& exports) {
  CLI::App& unit = *exports.add_subcommand(
      "fmu",
      "write the drive, or only its plant, as a functional mock-up unit for co-simulation, for programs that import FMI");
  const auto a = std::make_shared<UnitArguments>();
  unit.add_option("SCENARIO", a->file, "scenario file")->required();
  unit.add_option("--out", a->out, "file to write, such as drive.fmu")->required();
  take_force(unit, a->force);
  unit.add_option("--fmi", a->fmi, "version of FMI: 2 or 3")->capture_default_str();
  unit.add_option(
          "--kind", a->kind,
          "contents of the unit: drive (with the controller) or plant (only motor, bridge and sensors)")
      ->capture_default_str();
  unit.add_option("--inputs", a->inputs, "inputs of a plant's bridge: gates, pair or legs. Default: gates");
  take_sets(unit, a->sets);
  take_data(unit, a->data_dir);
  return {&unit, calling(export_unit, a)};
}

}  // namespace cli
