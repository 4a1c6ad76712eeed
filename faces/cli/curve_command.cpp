// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/curve_command.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "batch/curve.hpp"
#include "faces/cli/duplicate_outputs.hpp"
#include "faces/cli/open_or_report.hpp"
#include "faces/cli/side_by_side.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "files/scenario_on_disk.hpp"
#include "files/trace/csv_writer.hpp"
#include "report/curve_page.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"
#include "text/keys/key_advice.hpp"
#include "text/results/curve_columns.hpp"
#include "text/results/curve_json.hpp"
#include "text/results/curve_table.hpp"

namespace cli {
namespace {

struct CurveArguments {
  std::string motor, data_dir;
  std::optional<double> voltage_V;  ///< empty: the sheet's nominal voltage
  std::optional<double> duty, pwm_period_s, on_resistance_ohm, diode_drop_V, ambient_degC, winding_degC,
      housing_degC;
  std::optional<int> points;
  std::string chopping;
  std::string csv, json, html;
  bool quiet = false, force = false;
  unsigned jobs = 0;
  std::string command;  ///< the command that writes the page again
};

/// The output files. They are opened before the computation, so that an unwritable path fails at once.
struct CurveFiles {
  std::optional<files::CsvWriter> csv;
  std::optional<files::AtomicFile> json, html;
};

CurveFiles outputs(const CurveArguments& a, const analysis::CurveRequest& request, base::Problems& problems) {
  CurveFiles out;
  if (!a.csv.empty()) {
    std::vector<study::Column> columns;
    for (const text::CurveColumn& c : text::curve_columns(design::motion_of(request.sheet)))
      columns.push_back(c.column);
    const std::string origin[] = {"sixstep " SIXSTEP_VERSION,
                                  "motor: " + text::visible(a.motor) + "; " + text::curve_conditions(request),
                                  "command: " + a.command};
    open_or_report(out.csv, files::CsvWriter::create({a.csv, a.force}, columns, origin), problems);
  }
  if (!a.json.empty() && a.json != "-")
    open_or_report(out.json, files::AtomicFile::create({a.json, a.force}), problems);
  if (!a.html.empty()) open_or_report(out.html, files::AtomicFile::create({a.html, a.force}), problems);
  return out;
}

void write(const CurveArguments& a, const analysis::CurveRequest& request, const analysis::Curve& curve,
           CurveFiles& out, base::Problems& problems) {
  const auto commit = [&](auto& file) { append(problems, file.commit()); };
  if (out.csv) {
    std::vector<double> numbers;
    for (const text::CurveRow& row : text::curve_rows(request, curve)) {
      numbers.clear();
      for (const text::CurveColumn& c : text::curve_columns()) numbers.push_back(c.value(row));
      out.csv->row(numbers);
    }
    commit(*out.csv);
  }
  if (out.json) {
    out.json->write(text::curve_json(request, curve));
    commit(*out.json);
  }
  if (out.html) {
    out.html->write(report::render_curve({request, curve, a.command, SIXSTEP_VERSION}));
    commit(*out.html);
  }
  if (a.json == "-")
    print(text::curve_json(request, curve));
  else if (!a.quiet)
    print(text::curve_table(request, curve));
}

void read_chopping(const std::string& word, analysis::Bench& bench, base::Problems& problems) {
  if (word.empty()) return;
  std::vector<std::string> known;
  for (const auto& choice : study::chopping_choices) {
    if (choice.word == word) bench.chopping = choice.value;
    if (choice.word == word) return;
    known.emplace_back(choice.word);
  }
  const std::string near = text::nearest(word, known);
  problems.push_back({"chopping", word, fmt::format("must be one of {}", fmt::join(known, ", ")),
                      near.empty() ? "soft is the default" : fmt::format("did you mean {}?", near)});
}

/// Refuses a chopping mode at full duty, because no switch is chopped.
void refuse_chopping_without_use(const CurveArguments& a, double duty, base::Problems& problems) {
  if (std::fabs(duty) != 1.0) return;
  for (const auto& [option, given] :
       {std::pair{"--chopping", !a.chopping.empty()}, std::pair{"--pwm-period", a.pwm_period_s.has_value()}})
    if (given)
      problems.push_back({option, "", "has no effect at full duty, which needs no chopping",
                          "give a --duty below 1, or leave this option out"});
}

/// The option for a member: "--pwm-period" for pwm_period_s. The name of an option has no unit.
std::string option_of(std::string member) {
  member.erase(std::min(member.rfind('_'), member.size()));
  std::replace(member.begin(), member.end(), '_', '-');
  return "--" + member;
}

base::Result<analysis::CurveRequest> request_of(const CurveArguments& a) {
  const base::Result<design::Sheet> sheet = files::read_sheet(a.motor, a.data_dir);
  if (!sheet) return sheet.problems();
  base::Result<design::MotorModel> motor = design::motor_model(*sheet);
  if (!motor) {
    base::Problems problems = motor.problems();
    for (base::Problem& p : problems) p.where = fmt::format("{}: {}", a.motor, p.where);
    return problems;
  }
  if (!a.voltage_V && !(motor->nominal_voltage_V > 0))
    return base::Problem{"--voltage", "", "is missing, and the sheet prints no nominal voltage",
                         "give the bus voltage in volts"};
  analysis::CurveRequest r{.sheet = *sheet, .bench = {}};
  r.motor_degC.winding_degC = a.winding_degC.value_or(r.motor_degC.winding_degC);
  r.motor_degC.housing_degC = a.housing_degC.value_or(r.motor_degC.housing_degC);
  analysis::Bench& b = r.bench;
  b.motor = design::warmed(*motor, *sheet, r.motor_degC);
  b.voltage_V = a.voltage_V.value_or(motor->nominal_voltage_V);
  b.duty = a.duty.value_or(b.duty);
  b.pwm_period_s = a.pwm_period_s.value_or(b.pwm_period_s);
  b.devices.R_on_ohm = a.on_resistance_ohm.value_or(0.0);
  b.devices.V_f_V = a.diode_drop_V.value_or(0.0);
  r.ambient_degC = a.ambient_degC.value_or(r.ambient_degC);
  r.points = a.points.value_or(r.points);
  base::Problems problems = analysis::check(r);
  read_chopping(a.chopping, b, problems);
  for (base::Problem& p : problems) p.where = option_of(p.where);
  if (problems.empty()) refuse_chopping_without_use(a, b.duty, problems);
  if (!problems.empty()) return problems;
  return r;
}

Exit curve_command(const CurveArguments& a) {
  const base::Result<analysis::CurveRequest> request = request_of(a);
  if (!request) {
    complain(request.problems());
    return Exit::bad_input;
  }
  base::Problems problems = duplicate_outputs({{"--csv", a.csv}, {"--json", a.json}, {"--html", a.html}});
  if (!problems.empty()) return refused(problems);
  catch_interrupts();
  CurveFiles out = outputs(a, *request, problems);
  if (!problems.empty()) return refused(problems);
  const base::Result<analysis::Curve> curve = batch::torque_speed_curve(
      *request, side_by_side(a.jobs, a.quiet, "points"), [] { return !interrupted(); });
  if (!curve) {
    if (interrupted()) return told_interrupted("curve " + a.motor);
    complain(curve.problems());
    return Exit::bad_input;
  }
  write(a, *request, *curve, out, problems);
  complain(problems);
  return problems.empty() ? Exit::ok : Exit::bad_input;
}

void declare_options(CLI::App& curve, CurveArguments& a) {
  curve.add_option("MOTOR", a.motor, "name or path of a motor file")->required();
  curve.add_option("--voltage", a.voltage_V, "bus voltage, V. Default: the sheet's nominal voltage");
  curve.add_option("--duty", a.duty, "duty in (0, 1]. Default: 1, full voltage");
  curve.add_option("--chopping", a.chopping, "chopping for a duty below 1: soft, hard or complementary");
  curve.add_option("--pwm-period", a.pwm_period_s, "PWM period in s, for a duty below 1. Default: 30e-6");
  curve.add_option("--on-resistance", a.on_resistance_ohm, "on-resistance of a switch, ohm. Default: 0");
  curve.add_option("--diode-drop", a.diode_drop_V, "forward voltage of a diode, V. Default: 0");
  curve.add_option("--points", a.points, "number of speeds from standstill to no load. Default: 41");
  curve.add_option("--ambient", a.ambient_degC, "temperature of the air around the motor, degC. Default: 25");
  curve.add_option("--winding", a.winding_degC,
                   "winding temperature at which the curve is computed, degC. Default: 25");
  curve.add_option("--housing", a.housing_degC,
                   "temperature of housing and magnets at which the curve is computed, degC. Default: 25");
  curve.add_option("--csv", a.csv, "write all points with all columns");
  curve.add_option("--json", a.json,
                   "write all results as JSON; - writes to standard output instead of the table");
  curve.add_option("--html", a.html, "write a page with charts");
  take_force(curve, a.force);
  take_data(curve, a.data_dir);
  take_jobs(curve, a.jobs, "points");
  curve.add_flag("--quiet", a.quiet, "print errors only; files are still written");
}

}  // namespace

Verb declare_curve(CLI::App& app) {
  CLI::App& curve = *app.add_subcommand(
      "curve", "compute the torque-speed curve of a motor; of a linear motor, force over speed");
  const auto a = std::make_shared<CurveArguments>();
  declare_options(curve, *a);
  return {&curve, calling(curve_command, a)};
}

}  // namespace cli
