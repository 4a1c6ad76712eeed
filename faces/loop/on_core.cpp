// SPDX-License-Identifier: Apache-2.0
#include "faces/loop/on_core.hpp"

#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <variant>

#include "faces/loop/chip.hpp"
#include "faces/loop/emulator.hpp"
#include "faces/loop/fresh_folder.hpp"
#include "faces/loop/image.hpp"
#include "sixstep/study/run/on_core.hpp"

namespace loop {

namespace {

/// A started core, in parallel with the host, or a started chip, in place of the drive.
using Running = std::variant<std::unique_ptr<Emulator>, std::unique_ptr<Chip>>;

template <class Of>
base::Result<Running> started(const Core& core, const std::string& image) {
  base::Result<std::unique_ptr<Of>> made = Of::start(core, image);
  if (!made) return made.problems();
  return Running(std::move(*made));
}

/// The file for the output of the serial line, in the folder of the run's image.
std::string serial_file(const FreshFolder& folder) { return folder.path() + "/serial.log"; }

base::Result<Running> started_chip(Core core, const std::string& image, const FreshFolder& folder) {
  core.emulator.push_back("--serial=" + serial_file(folder));
  return started<Chip>(core, image);
}

base::Result<Running> loaded(const Core& core, const study::Scenario& scenario, const FreshFolder& folder) {
  if (!core.elf.empty()) return started_chip(core, core.elf, folder);
  const base::Result<std::string> image = compiled_image(core, scenario, folder.path());
  if (!image) return image.problems();
  return core.by_registers ? started_chip(core, *image, folder) : started<Emulator>(core, *image);
}

/// The complete lines in the output of the serial line.
std::string sent_by(const FreshFolder& folder) {
  std::ifstream in(serial_file(folder), std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  text.resize(text.rfind('\n') + 1);
  return text;
}

study::OnCore ports(const Core& core, Running& running) {
  if (auto* const beside = std::get_if<std::unique_ptr<Emulator>>(&running))
    return {.beside = (*beside)->port()};
  return {.instead = std::get<std::unique_ptr<Chip>>(running)->port(), .setpoint_range = core.setpoint_range};
}

void note(const Core& core, double period_s, Running& running, const FreshFolder& folder,
          study::Outcome& outcome) {
  if (auto* const beside = std::get_if<std::unique_ptr<Emulator>>(&running)) {
    outcome.core = study::CoreRun{std::string(core.title), (*beside)->calls()};
  } else if (outcome.chip) {
    Chip& chip = *std::get<std::unique_ptr<Chip>>(running);
    outcome.chip->chip = core.title;
    outcome.chip->clock_Hz = chip.clock_Hz();
    outcome.chip->period_s = period_s;
    outcome.chip->times = chip.times();
    outcome.chip->sent = sent_by(folder);
  }
}

}  // namespace

base::Problems stands_against(const Core& core, const study::Scenario& scenario) {
  if (!core.elf.empty()) return study::not_on_an_avrs_board(scenario);
  return core.by_registers ? study::not_on_an_avr(scenario) : study::not_on_a_core(scenario);
}

base::Result<study::Outcome> run(const Core* core, const study::Scenario& scenario,
                                 const study::Listeners& listeners) {
  if (core == nullptr) return study::run(scenario, listeners);
  if (base::Problems problems = stands_against(*core, scenario); !problems.empty()) return problems;
  const base::Result<FreshFolder> folder = FreshFolder::make();
  if (!folder) return folder.problems();
  base::Result<Running> running = loaded(*core, scenario, *folder);
  if (!running) return running.problems();
  base::Result<study::Outcome> outcome = study::run(scenario, listeners, ports(*core, *running));
  if (outcome) note(*core, scenario.pwm.period_s, *running, *folder, *outcome);
  return outcome;
}

}  // namespace loop
