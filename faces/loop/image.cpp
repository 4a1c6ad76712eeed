// SPDX-License-Identifier: Apache-2.0
#include "faces/loop/image.hpp"

#include <filesystem>
#include <fstream>

#include "faces/loop/child.hpp"
#include "faces/loop/descriptor.hpp"
#include "faces/loop/installed.hpp"
#include "text/export/config_header.hpp"

namespace loop {

namespace {

namespace fs = std::filesystem;

/// The folder with the library's headers, from which the program for a core is compiled.
base::Result<fs::path> sources() {
  const fs::path root = sources_folder();
  std::error_code none;
  if (fs::exists(root / "sixstep/control/drive.hpp", none)) return root;
  return base::Problem{root.string(), "", "does not contain the sources of a core's program",
                       "set SIXSTEP_SOURCES to the folder with sixstep/ and faces/ in it"};
}

base::Problems write_header(const study::Scenario& scenario, const fs::path& file) {
  const base::Result<std::string> header = text::config_header({.scenario = scenario,
                                                                .arithmetic = {},
                                                                .range = {},
                                                                .name_space = "exported",
                                                                .single_header = false,
                                                                .command = "run on an emulated core",
                                                                .clearance = nullptr,
                                                                .despite = "run on an emulated core"});
  if (!header) return header.problems();
  std::ofstream out(file);
  out << *header;
  out.close();
  if (!out) return {{file.string(), "", "cannot be written", "check whether the disk is full"}};
  return {};
}

using Words = std::vector<std::string>;

void add(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

/// The compiler's include paths.
Words include_paths(const fs::path& root, const fs::path& folder) {
  return {"-I" + (root / "faces/firmware/bare").string(), "-I" + root.string(), "-I" + folder.string()};
}

/// The macro that selects the drive in core/main.cpp.
const char* drive_of(const study::Scenario& scenario) {
  using study::FirmwareKind;
  switch (scenario.control.drive) {
    case FirmwareKind::product:
      return "-DSIXSTEP_PRODUCT_DRIVE";
    case FirmwareKind::sensorless:
      return "-DSIXSTEP_SENSORLESS_DRIVE";
    case FirmwareKind::field:
      return scenario.control.field.angle == study::FieldAngle::sensors ? "-DSIXSTEP_FIELD_DRIVE"
                                                                        : "-DSIXSTEP_SENSORLESS_FIELD_DRIVE";
    case FirmwareKind::lean:
    case FirmwareKind::own:
      break;
  }
  return "-DSIXSTEP_LEAN_DRIVE";
}

/// The command that builds the program for a called core: it compiles and links in one step.
Words called_core(const Core& core, const study::Scenario& scenario, const fs::path& root,
                  const fs::path& folder, const fs::path& image) {
  const fs::path bare = root / "faces/firmware/bare";
  Words words = core.compiler;
  add(words, {"-std=c++20", "-O2", "-ffp-contract=off", "-fno-exceptions", "-fno-rtti", "-fno-unwind-tables",
              "-fno-asynchronous-unwind-tables", "-ffreestanding", "-nostdinc++"});
  add(words, include_paths(root, folder));
  add(words, {drive_of(scenario)});
  add(words, {(root / "faces/loop/core/main.cpp").string(), (bare / "start.cpp").string(),
              (bare / "memory.cpp").string(), (bare / core.start_up).string(), "-nostdlib", "-T",
              (bare / core.linker_script).string(), "-o", image.string()});
  add(words, core.libraries);
  return words;
}

/// The commands that build the program for a whole chip. The program is compiled as in
/// tools/firmware_image.sh and linked with the start code of the C library.
std::vector<Words> whole_chip(const Core& core, const fs::path& root, const fs::path& folder,
                              const fs::path& image) {
  const fs::path example = root / "faces/firmware/example/avr";
  const std::string object = (folder / "main.o").string();
  Words compile = core.compiler;
  add(compile, {"@" + (example / "compile.flags").string()});
  add(compile, include_paths(root, folder));
  add(compile,
      // an uncleared drive is allowed, because no bridge is connected
      {"-DSIXSTEP_DESPITE", "-c", (example / "main.cpp").string(), "-o", object});
  Words link = core.linker;
  add(link, {object, "-o", image.string()});
  return {compile, link};
}

std::vector<Words> commands_for(const Core& core, const study::Scenario& scenario, const fs::path& root,
                                const fs::path& folder, const fs::path& image) {
  if (core.by_registers) return whole_chip(core, root, folder, image);
  return {called_core(core, scenario, root, folder, image)};
}

/// The first error in the compiler's output; without an error, the first line.
std::string complaint_in(const fs::path& log) {
  std::ifstream in(log);
  std::string line, first;
  while (std::getline(in, line)) {
    if (line.find("error") != std::string::npos) return line;
    if (first.empty()) first = line;
  }
  return first;
}

base::Problems carried_out(const Core& core, const Words& words, const fs::path& log,
                           const std::string& folder) {
  const Descriptor told(::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  base::Result<Child> compiler =
      Child::start({.words = words, .given = {{told.number(), 1}, {told.number(), 2}}, .temporary = folder});
  if (!compiler) return compiler.problems();
  const std::optional<int> status = compiler->ended_within(std::chrono::minutes(5));
  if (status == 0) return {};
  const std::string why = status ? complaint_in(log) : "took more than five minutes";
  return {{words.front(), "", "could not compile the drive for " + std::string(core.title) + ": " + why,
           "report this message, with the scenario file, in the issues of the repository"}};
}

/// Problems of all missing programs, reported together before the compilation.
base::Problems missing_programs(const Core& core) {
  base::Problems missing;
  for (const Words* words : {&core.compiler, &core.linker, &core.emulator})
    if (!words->empty() && on_path(words->front()).empty()) missing.push_back(not_here(words->front()));
  return missing;
}

}  // namespace

base::Result<std::string> compiled_image(const Core& core, const study::Scenario& scenario,
                                         const std::string& folder) {
  const base::Result<fs::path> root = sources();
  if (!root) return root.problems();
  if (base::Problems missing = missing_programs(core); !missing.empty()) return missing;
  const fs::path here = folder, image = here / "image.elf", log = here / "compiler.log";
  if (base::Problems problems = write_header(scenario, here / "drive_config.hpp"); !problems.empty())
    return problems;
  for (const Words& words : commands_for(core, scenario, *root, here, image))
    if (base::Problems problems = carried_out(core, words, log, folder); !problems.empty()) return problems;
  return image.string();
}

}  // namespace loop
