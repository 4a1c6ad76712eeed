// SPDX-License-Identifier: Apache-2.0
// sixstep on the command line: reads arguments, calls one command, tells the shell how it went.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include <algorithm>
#include <cctype>
#include <exception>
#include <string>
#include <vector>

#include "faces/cli/curve_command.hpp"
#include "faces/cli/design_command.hpp"
#include "faces/cli/export_command.hpp"
#include "faces/cli/help_command.hpp"
#include "faces/cli/motor_command.hpp"
#include "faces/cli/run_command.hpp"
#include "faces/cli/terminal.hpp"
#include "io/key_advice.hpp"

namespace cli {
namespace {

/// The command line as a shell would take it again. The program is called by its name: its path says nothing.
std::string retyped(int count, const char* const* words) {
  std::string text = "sixstep";
  for (int n = 1; n < count; ++n) {
    const std::string word = words[n];
    const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
      return std::isalnum(c) != 0 ||
             std::string_view("-_./=+,:@%").find(static_cast<char>(c)) != std::string_view::npos;
    });
    text += ' ';
    if (plain) {
      text += word;
      continue;
    }
    text += '\'';
    for (const char c : word) c == '\'' ? text += "'\\''" : text += c;
    text += '\'';
  }
  return text;
}

void declare_run(CLI::App& run, RunArguments& a) {
  run.add_option("FILE", a.files, "scenario files")->required();
  run.add_option("--out", a.out, "folder for NAME.csv, NAME.json, NAME.html of each scenario and index.html");
  run.add_option("--csv", a.paths.csv, "write the recorded trace");
  run.add_option("--json", a.paths.json, "write verdicts and figures; - for standard output");
  run.add_option("--html", a.paths.html, "write the report; of several files, one that compares them");
  run.add_option("--set", a.sets, "key=value, stronger than the file: --set supply.voltage_V=12")
      ->allow_extra_args(false);
  run.add_option("--data", a.data_dir, "folder that holds motors/");
  run.add_flag("--quiet", a.quiet, "no table, only errors and the exit code");
  run.add_option("--jobs", a.jobs, "runs side by side; without it one per core")->check(CLI::Range(1, 1024));
  CLI::Option* runs =
      run.add_option("--runs", a.runs, "that many drives of the series that [[spread]] describes");
  runs->check(CLI::Range(1, 1'000'000'000));
  run.add_option("--seed", a.seed, "another series of drives; without it 1");
  run.add_option("--drive", a.drive, "drive N of the series alone, with all its outputs")->excludes(runs);
}

void declare_design(CLI::App& design, DesignArguments& a) {
  design.add_option("MOTOR", a.motor, "motor's name or file")->required();
  design.add_option("--mode", a.mode, "current, speed or position")->capture_default_str();
  design.add_option("--settle", a.settle_s, "settling time of the mode's PI loop in s; 1e-3, speed 10e-3");
  design.add_option("--damping", a.damping, "of the placed poles, above 0 to 1; 0.9");
  design.add_option(
      "--current-settle", a.current_settle_s,
      "speed, position: settling time of the current loop in s; 1e-3, or a tenth of the speed loop's");
  design.add_option("--method", a.method, "pole-placement, cancellation or symmetrical-optimum")
      ->capture_default_str();
  design.add_option("--bandwidth", a.bandwidth_rad_s,
                    "cancellation, symmetrical-optimum: of the loop, in rad/s");
  design.add_option("--period", a.period_s, "control and PWM period in s; 30e-6");
  design.add_option("--voltage", a.voltage_V, "of the bus in V; the sheet's nominal voltage");
  design.add_option("--torque-limit", a.torque_limit_Nm, "speed, position: in N m; the stall torque");
  design.add_option("--load-inertia", a.load_inertia_kg_m2, "on the shaft, beside the rotor's, in kg m2; 0");
  design.add_option("--delay", a.delay_periods, "periods until a command counts, 0 or 1")
      ->capture_default_str();
  design.add_option("--chopping", a.chopping, "soft, hard or complementary")->capture_default_str();
  design.add_option("--step", a.step, "what is simulated: a step in A, rad/s or deg as the mode asks");
  design.add_option("--json", a.json, "write everything as numbers; - for standard output");
  design.add_option("--toml", a.toml, "write the scenario that was simulated, for sixstep run");
  design.add_option("--header", a.header, "write the gains as constants for firmware, in C++20");
  design.add_option("--html", a.html, "write the design as a page");
  design.add_option("--models", a.models, "write the motor's two state spaces, as .json or .mat");
  design.add_option("--angle", a.angle_deg, "of the rotor for --models, in electrical degrees")
      ->capture_default_str();
  design.add_flag("--quick", a.quick, "leave out the tolerances");
  design.add_flag("--quiet", a.quiet, "no text, only errors and the exit code");
  design.add_option("--jobs", a.jobs, "runs side by side; without it one per core")
      ->check(CLI::Range(1, 1024));
  design.add_option("--data", a.data_dir, "folder that holds motors/");
}

void declare_curve(CLI::App& curve, CurveArguments& a) {
  curve.add_option("MOTOR", a.motor, "name or path of a motor file")->required();
  curve.add_option("--voltage", a.voltage_V, "bus voltage, V; without it the sheet's nominal voltage");
  curve.add_option("--duty", a.duty, "in (0, 1]; without it 1, full voltage");
  curve.add_option("--chopping", a.chopping, "soft, hard or complementary, where the duty is below 1");
  curve.add_option("--pwm-period", a.pwm_period_s, "s; without it 30e-6");
  curve.add_option("--on-resistance", a.on_resistance_ohm, "of a switch, ohm; without it 0");
  curve.add_option("--diode-drop", a.diode_drop_V, "V; without it 0");
  curve.add_option("--points", a.points, "from standstill to no load; without it 41");
  curve.add_option("--ambient", a.ambient_degC, "air around the motor, degC; without it 25");
  curve.add_option("--csv", a.csv, "write all points with all columns");
  curve.add_option("--json", a.json, "write everything; - for standard output instead of the table");
  curve.add_option("--html", a.html, "write a page with charts");
  curve.add_option("--data", a.data_dir, "folder that holds motors/");
  curve.add_option("--jobs", a.jobs, "points side by side; without it one per core")
      ->check(CLI::Range(1, 1024));
  curve.add_flag("--quiet", a.quiet, "no table, only files and errors");
}

void declare_export(CLI::App& header, ExportArguments& a) {
  header.add_option("SCENARIO", a.file, "scenario file")->required();
  header.add_option("--out", a.out, "the file to write; without it standard output");
  header.add_option("--arithmetic", a.arithmetic,
                    "double, float, q15, q14, q31 or q30; without it control.arithmetic");
  header
      .add_option(
          "--range", a.ranges,
          "fixed point: the most that is measured or asked for, as --range current_A=20; also speed_rad_s, "
          "position_deg, bus_V, setpoint; without it what the scenario's motor and bus can reach")
      ->allow_extra_args(false);
  header.add_option("--set", a.sets, "key=value, stronger than the file")->allow_extra_args(false);
  header.add_option("--namespace", a.name_space, "C++ namespace of what the header declares")
      ->capture_default_str();
  header.add_flag("--single-header", a.single_header, "include sixstep_control.hpp, not sixstep/control/");
  header.add_option("--data", a.data_dir, "folder that holds motors/");
}

struct MotorVerbs {
  CLI::App &list, &show, &check, &fresh;

  Exit run(const MotorArguments& a) const {
    if (list) return list_motors();
    if (show) return show_motor(a);
    return check ? check_motor(a) : new_motor(a);
  }
};

MotorVerbs declare_motor(CLI::App& motor, MotorArguments& a) {
  motor.require_subcommand(1);
  const MotorVerbs verbs = {*motor.add_subcommand("list", "the built-in motors, one a line"),
                            *motor.add_subcommand("show", "the sheet as printed and the model that it makes"),
                            *motor.add_subcommand("check", "hold the sheet against itself"),
                            *motor.add_subcommand("new", "an empty motor file, to be filled in")};
  for (CLI::App* const verb : {&verbs.show, &verbs.check}) {
    verb->add_option("NAME", a.name, "name or path")->required();
    verb->add_option("--data", a.data_dir, "folder that holds motors/");
    verb->add_flag("--json", a.json, "for programs");
  }
  verbs.fresh.add_option("NAME", a.name, "the file to write, NAME.toml; without it standard output");
  verbs.fresh.add_option("--style", a.style, "whose sheet it is: maxon, drone, servo or firmware")
      ->capture_default_str();
  return verbs;
}

Exit unknown_command(const CLI::App& app, const std::string& word) {
  const std::vector<const CLI::App*> known = app.get_subcommands([](const CLI::App*) { return true; });
  const auto near = std::find_if(known.begin(), known.end(), [&](const CLI::App* command) {
    return io::edit_distance(word, command->get_name()) <= 2;
  });
  complain({{.where = word,
             .limit = "is no command of sixstep",
             .cure = near == known.end() ? "sixstep --help lists them"
                                         : "did you mean " + (*near)->get_name() + "?"}});
  return Exit::bad_input;
}

Exit run_program(int count, const char* const* words) {
  CLI::App app{"Brushless DC motor from data sheet to verified firmware", "sixstep"};
  app.set_version_flag("--version", std::string("sixstep ") + SIXSTEP_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 all requirements hold, 1 a requirement failed, 2 bad input, 3 a fault stopped a run, "
      "4 internal error\n");

  RunArguments run_arguments;
  CLI::App& run = *app.add_subcommand("run", "run scenarios and judge them");
  declare_run(run, run_arguments);

  DesignArguments design_arguments;
  CLI::App& design =
      *app.add_subcommand("design", "gains from a motor's sheet, simulated and put through tolerances");
  declare_design(design, design_arguments);

  CurveArguments curve_arguments;
  CLI::App& curve = *app.add_subcommand("curve", "torque-speed curve of a motor");
  declare_curve(curve, curve_arguments);

  ExportArguments export_arguments;
  CLI::App& exports = *app.add_subcommand("export", "a scenario's drive for use elsewhere");
  exports.require_subcommand(1);
  declare_export(*exports.add_subcommand("header", "gains and scalings as constants for firmware, in C++20"),
                 export_arguments);

  std::string key;
  CLI::App& help = *app.add_subcommand("help", "explain a key, a table, or all of them");
  help.add_option("KEY", key, "as supply.voltage_V, pwm or resistance_ohm");

  MotorArguments motor_arguments;
  const MotorVerbs motor =
      declare_motor(*app.add_subcommand("motor", "look into motor files"), motor_arguments);

  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    const std::string first = count > 1 ? words[1] : "-";
    if (app.get_subcommands().empty() && first[0] != '-') return unknown_command(app, first);
    return app.exit(error) == 0 ? Exit::ok : Exit::bad_input;
  }
  run_arguments.command = retyped(count, words);
  export_arguments.command = design_arguments.command = curve_arguments.command = run_arguments.command;
  if (run) return run_command(run_arguments);
  if (design) return design_command(design_arguments);
  if (curve) return curve_command(curve_arguments);
  if (exports) return export_header(export_arguments);
  if (help) return help_command(key);
  return motor.run(motor_arguments);
}

}  // namespace
}  // namespace cli

int main(int count, char** words) {
  try {
    return static_cast<int>(cli::run_program(count, words));
  } catch (const std::exception& error) {
    cli::print(std::string("internal error: ") + error.what() + "\n", stderr);
  } catch (...) {
    cli::print("internal error\n", stderr);
  }
  return static_cast<int>(cli::Exit::internal);
}
