// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/commission_command.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string_view>

#include "faces/cli/choose.hpp"
#include "faces/cli/result_files.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "files/own_file.hpp"
#include "files/scenario_on_disk.hpp"
#include "report/commission_page.hpp"
#include "sixstep/analysis/commission/commission_study.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"
#include "text/results/commission_text.hpp"

namespace cli {
namespace {

struct CommissionArguments {
  std::string motor, data_dir;
  std::optional<double> voltage_V, current_A;
  double offset_deg = 0.0;
  int seed = 0;
  std::string phases = "abc", wires = "123", inverted = "none";
  std::string write, html;
  bool json = false, quiet = false, force = false;
  std::string command;  ///< the command that writes the files again
};

base::Problems write(const analysis::CommissionStudy& s, const CommissionArguments& a, ResultFiles& out) {
  base::Problems found;
  if (out.has("--write"))
    out.put("--write", files::with_own_mark(a.command, text::commission_toml(s)), found);
  if (out.has("--html")) out.put("--html", report::render_commission({s, a.command, SIXSTEP_VERSION}), found);
  return found;
}

/// In problems, replaces the library's members by options and by keys of the motor file.
base::Problems told(base::Problems problems, const CommissionArguments& a) {
  for (base::Problem& p : problems) {
    if (p.where == "voltage_V")
      p.where = "--voltage";
    else if (p.where == "current_A") {
      constexpr std::string_view member = "current_A";
      p.where = "--current";
      if (const std::size_t at = p.cure.find(member); at != std::string::npos)
        p.cure.replace(at, member.size(), p.where);
    } else if (p.where == "hall_offset_deg")
      p.where = "--offset";
    else
      p.where = a.motor + ": " + p.where;
  }
  return problems;
}

base::Result<sixstep::rig::Wiring> wiring_of(const CommissionArguments& a) {
  sixstep::rig::Wiring out;
  study::HallLines inverted = study::HallLines::none;
  base::Problems found;
  choose("--phases", a.phases, study::phase_order_choices, out.phases, found);
  choose("--wires", a.wires, study::hall_order_choices, out.probes, found);
  choose("--inverted", a.inverted, study::hall_inverted_choices, inverted, found);
  if (!found.empty()) return found;
  out.inverted = static_cast<std::uint8_t>(inverted);
  return out;
}

Exit commission_command(const CommissionArguments& a) {
  const base::Result<sixstep::rig::Wiring> wires = wiring_of(a);
  if (!wires) return refused(wires.problems());
  const base::Result<design::Sheet> sheet = files::read_sheet(a.motor, a.data_dir);
  if (!sheet) return refused(sheet.problems());
  const analysis::CommissionOrder order{.subject = {.motor = a.motor,
                                                    .sheet = *sheet,
                                                    .voltage_V = a.voltage_V,
                                                    .current_A = a.current_A,
                                                    .wires = *wires,
                                                    .hall_offset_deg = a.offset_deg,
                                                    .seed = a.seed},
                                        .keep_going = [] { return !interrupted(); }};
  if (const auto bench = analysis::commission_bench(order.subject); !bench)
    return refused(told(bench.problems(), a));
  catch_interrupts();
  ResultFiles outputs;
  if (const base::Problems found = outputs.open({{"--write", a.write}, {"--html", a.html}}, a.force);
      !found.empty())
    return refused(found);
  const base::Result<analysis::CommissionStudy> s = analysis::study_commission(order);
  if (interrupted()) return told_interrupted("motor commission " + a.motor);
  if (!s) return refused(told(s.problems(), a));
  if (const base::Problems unwritten = write(*s, a, outputs); !unwritten.empty()) return refused(unwritten);
  if (a.json)
    print(text::commission_json(*s));
  else if (!a.quiet)
    print(text::commission_text(*s));
  return s->holds() ? Exit::ok : Exit::failed;
}

}  // namespace

Verb declare_commission(CLI::App& motor) {
  CLI::App& verb = *motor.add_subcommand(
      "commission", "simulate a drive that measures its motor, and compare the results with the motor file");
  const auto a = std::make_shared<CommissionArguments>();
  verb.add_option("MOTOR", a->motor, "name or path of a motor file")->required();
  verb.add_option("--voltage", a->voltage_V, "bus voltage, V. Default: the sheet's nominal voltage");
  verb.add_option(
      "--current", a->current_A,
      "test current, A; the motor must withstand this current for some seconds. Largest value: 0.41 U/R_s (U: bus "
      "voltage, R_s: phase resistance), less for a salient rotor. Default: twice the nominal current, or a fifth of "
      "U/(2 R_s) if the sheet names no nominal current; at most half of the largest value");
  verb.add_option("--phases", a->phases,
                  "phases of the motor at legs a, b, c: abc, bca, cab, acb, cba or bac")
      ->capture_default_str();
  verb.add_option("--wires", a->wires, "Hall probes at pins H1, H2, H3: 123, 231, 312, 132, 321 or 213")
      ->capture_default_str();
  verb.add_option("--inverted", a->inverted,
                  "pins that read their probe inverted: none, 1, 2, 3, 12, 13, 23 or 123")
      ->capture_default_str();
  verb.add_option("--offset", a->offset_deg, "angle by which all Hall edges come late, electrical degrees")
      ->capture_default_str();
  verb.add_option("--seed", a->seed, "seed of the converters' noise")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str();
  verb.add_flag("--json", a->json, "print the results as JSON");
  verb.add_option("--write", a->write, "write the results as lines for a motor's file");
  verb.add_option("--html", a->html,
                  "write an HTML page with the test currents, the rotor angle over time and all figures");
  take_force(verb, a->force);
  take_data(verb, a->data_dir);
  verb.add_flag("--quiet", a->quiet, "print errors only; files are still written");
  return {&verb, calling(commission_command, a)};
}

}  // namespace cli
