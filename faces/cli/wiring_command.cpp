// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/wiring_command.hpp"

#include <CLI/App.hpp>

#include <optional>

#include "faces/cli/duplicate_outputs.hpp"
#include "faces/cli/new_file.hpp"
#include "faces/cli/open_or_report.hpp"
#include "faces/cli/side_by_side.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "files/atomic_file.hpp"
#include "files/own_file.hpp"
#include "files/scenario_on_disk.hpp"
#include "report/wiring_page.hpp"
#include "report/wiring_picture.hpp"
#include "sixstep/analysis/wiring/wiring_study.hpp"
#include "text/results/wiring_json.hpp"
#include "text/results/wiring_text.hpp"
#include "text/results/wiring_words.hpp"
#include "text/scenario/scenario_text.hpp"

namespace cli {
namespace {

struct WiringArguments {
  std::string motor, data_dir;
  std::optional<double> voltage_V, current_A;
  std::string svg, html, toml;
  bool json = false, quiet = false, force = false;
  unsigned jobs = 0;
  std::string command;  ///< the command that writes the page again
};

/// The output files. They are opened before the runs, so that an unwritable path fails at once.
struct WiringFiles {
  std::optional<files::AtomicFile> svg, html, toml;

  base::Problems open(const WiringArguments& a) {
    base::Problems found = duplicate_outputs({{"--svg", a.svg}, {"--html", a.html}, {"--toml", a.toml}});
    if (!found.empty()) return found;
    const auto one = [&](std::optional<files::AtomicFile>& into, const std::string& path) {
      if (!path.empty()) open_or_report(into, files::AtomicFile::create({path, a.force}), found);
    };
    one(svg, a.svg);
    one(html, a.html);
    one(toml, a.toml);
    return found;
  }
};

base::Problems put(std::optional<files::AtomicFile>& file, const std::string& text) {
  if (!file) return {};
  file->write(text);
  return file->commit();
}

/// The scenario with straight wires, as text. The user crosses wires in the file or with --set.
std::string scenario_of(const analysis::WiringStudy& s, const std::string& path) {
  study::Scenario scenario = analysis::straight_run(s);
  scenario.motor = motor_beside(scenario.motor, path);
  return text::scenario_text(scenario, text::wiring_scenario_lines());
}

base::Problems write(const analysis::WiringStudy& s, const WiringArguments& a, WiringFiles& out) {
  base::Problems found;
  const report::WiringPageInput page{
      .study = s, .scenario = scenario_of(s, ""), .command = a.command, .version = SIXSTEP_VERSION};
  if (out.svg) append(found, put(out.svg, report::wiring_picture(s, SIXSTEP_VERSION)));
  if (out.html) append(found, put(out.html, report::render_wiring(page)));
  if (out.toml) append(found, put(out.toml, files::with_own_mark(a.command, scenario_of(s, a.toml))));
  return found;
}

/// In problems, replaces the library's members by options and by keys of the motor file.
base::Problems told(base::Problems problems, const WiringArguments& a) {
  for (base::Problem& p : problems) {
    if (p.where == "voltage_V")
      p.where = "--voltage";
    else if (p.where == "current_A")
      p.where = "--current";
    else
      p.where = a.motor + ": " + p.where;
  }
  return problems;
}

Exit wiring_command(const WiringArguments& a) {
  const base::Result<design::Sheet> sheet = files::read_sheet(a.motor, a.data_dir);
  if (!sheet) return refused(sheet.problems());
  analysis::WiringOrder order{
      .subject = {.motor = a.motor, .sheet = *sheet, .voltage_V = a.voltage_V, .current_A = a.current_A},
      .for_each = side_by_side(a.jobs, a.quiet, "runs"),
      .keep_going = [] { return !interrupted(); }};
  if (const auto bench = analysis::wiring_bench(order.subject); !bench)
    return refused(told(bench.problems(), a));
  catch_interrupts();
  WiringFiles outputs;
  if (const base::Problems found = outputs.open(a); !found.empty()) return refused(found);
  const base::Result<analysis::WiringStudy> s = analysis::study_wiring(order);
  if (interrupted()) return told_interrupted("motor wiring " + a.motor);
  if (!s) return refused(told(s.problems(), a));
  if (const base::Problems unwritten = write(*s, a, outputs); !unwritten.empty()) return refused(unwritten);
  if (a.json)
    print(text::wiring_json(*s));
  else if (!a.quiet)
    print(text::wiring_text(*s));
  return s->agreeing() == s->cases.size() ? Exit::ok : Exit::failed;
}

}  // namespace

Verb declare_wiring(CLI::App& motor) {
  CLI::App& wiring = *motor.add_subcommand(
      "wiring", "simulate the motor in each of the 36 wirings, and show the wires to move");
  const auto a = std::make_shared<WiringArguments>();
  wiring.add_option("MOTOR", a->motor, "name or path of a motor file")->required();
  wiring.add_option("--voltage", a->voltage_V, "bus voltage, V. Default: the sheet's nominal voltage");
  wiring.add_option(
      "--current", a->current_A,
      "current of the stalled motor, A, which sets the duty. Default: the nominal current, or a tenth of the current at full duty");
  wiring.add_flag("--json", a->json, "print the results as JSON");
  wiring.add_option("--svg", a->svg, "write the picture");
  wiring.add_option("--html", a->html, "write a page with the picture and all figures");
  wiring.add_option("--toml", a->toml, "write the simulated run, with straight wires, for sixstep run");
  take_force(wiring, a->force);
  take_data(wiring, a->data_dir);
  take_jobs(wiring, a->jobs);
  wiring.add_flag("--quiet", a->quiet, "print errors only; files are still written");
  return {&wiring, calling(wiring_command, a)};
}

}  // namespace cli
