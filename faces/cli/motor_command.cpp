// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/motor_command.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "faces/cli/bench_commands.hpp"
#include "faces/cli/commission_command.hpp"
#include "faces/cli/fit_command.hpp"
#include "faces/cli/new_file.hpp"
#include "faces/cli/terminal.hpp"
#include "faces/cli/wiring_command.hpp"
#include "files/scenario_on_disk.hpp"
#include "files/text_file.hpp"
#include "text/escape/escape.hpp"
#include "text/motor/foreign_motor.hpp"
#include "text/motor/motor_library.hpp"
#include "text/motor/motor_template.hpp"
#include "text/motor/motor_text.hpp"

namespace cli {
namespace {

struct MotorArguments {
  std::string name;      ///< a path or a built-in name
  std::string data_dir;  ///< folder that contains motors/
  std::string style = "maxon";
  std::string from;                  ///< another program's parameter file
  std::vector<std::string> answers;  ///< answers to its questions
  bool json = false;
};

struct Checked {
  design::Sheet sheet;
  design::SheetCheck check;
};

/// The sheet with its check. Empty if the sheet cannot be read or checked; the problems are then printed.
std::optional<Checked> checked(const MotorArguments& a) {
  base::Result<design::Sheet> sheet = files::read_sheet(a.name, a.data_dir);
  if (!sheet) {
    complain(sheet.problems());
    return {};
  }
  base::Result<design::SheetCheck> check = design::check_sheet(*sheet);
  if (!check) {
    complain(check.problems());
    return {};
  }
  return Checked{std::move(*sheet), std::move(*check)};
}

/// Prints one line for each built-in motor.
Exit list_motors(const MotorArguments& a) {
  std::size_t width = 0;
  std::vector<text::NamedSheet> motors;
  for (const std::string& name : text::built_in_motors()) {
    const base::Result<design::Sheet> sheet = files::read_sheet(name);
    if (!sheet) {
      complain(sheet.problems());
      return Exit::internal;
    }
    width = std::max(width, name.size());
    motors.push_back({name, *sheet});
  }
  if (a.json) {
    print(text::motor_list_json(motors));
    return Exit::ok;
  }
  std::string text = text::motor_line_heading(width);
  for (const text::NamedSheet& motor : motors) text += text::motor_line(motor.name, motor.sheet, width);
  print(text);
  return Exit::ok;
}

Exit show_motor(const MotorArguments& a) {
  const std::optional<Checked> motor = checked(a);
  if (!motor) return Exit::bad_input;
  if (a.json)
    print(text::motor_json(motor->sheet, motor->check));
  else
    print(text::sheet_table(motor->sheet) + "\n" + text::model_table(motor->sheet, motor->check));
  return Exit::ok;
}

Exit check_motor(const MotorArguments& a) {
  const std::optional<Checked> motor = checked(a);
  if (!motor) return Exit::bad_input;
  print(a.json ? text::motor_json(motor->sheet, motor->check)
               : text::check_report(motor->sheet, motor->check));
  return motor->check.consistent ? Exit::ok : Exit::failed;
}

/// Replaces the library's words for questions by the option.
base::Problems with_answer_option(base::Problems problems) {
  for (base::Problem& p : problems) {
    if (p.where == "answer") p.where = "--answer";
    if (p.cure.starts_with("answer ")) p.cure.insert(0, "--");
  }
  return problems;
}

/// The text of a new motor file.
base::Result<std::string> new_motor_text(const MotorArguments& a) {
  const std::string stem = std::filesystem::path(a.name.empty() ? a.from : a.name).stem().string();
  const std::string name = stem.empty() ? "my motor" : stem;
  if (a.from.empty()) {
    if (a.answers.empty()) return text::motor_template(a.style, name);
    return base::Problem{"--answer", a.answers.front(), "answers a question about the file of --from",
                         "name that file"};
  }
  const base::Result<std::string> read = files::read_regular_text(a.from);
  if (!read) return read.problems();
  base::Result<std::string> made = text::motor_of_foreign_file(a.from, *read, name, a.answers);
  if (!made) return with_answer_option(made.problems());
  return made;
}

Exit new_motor(const MotorArguments& a) {
  const base::Result<std::string> text = new_motor_text(a);
  if (!text) {
    complain(text.problems());
    return Exit::bad_input;
  }
  if (a.name.empty()) {
    print(*text);
    return Exit::ok;
  }
  const std::string path = toml_path(a.name);
  const base::Problems problems = write_new(path, *text);
  if (!problems.empty()) {
    complain(problems);
    return Exit::bad_input;
  }
  print("wrote " + text::visible(path) + "; replace each nan in this file, then: sixstep motor check " +
        text::shell_word(path) + "\n");
  return Exit::ok;
}

}  // namespace

Verb declare_motor(CLI::App& app) {
  CLI::App& motor = *app.add_subcommand("motor", "show, check and create motor files");
  motor.require_subcommand(1);
  const auto a = std::make_shared<MotorArguments>();
  CLI::App& list = *motor.add_subcommand("list", "list the built-in motors, one per line");
  CLI::App& show =
      *motor.add_subcommand("show", "show the sheet as printed, and the model that follows from the sheet");
  CLI::App& check = *motor.add_subcommand("check", "report values of the sheet that contradict each other");
  for (CLI::App* const verb : {&show, &check}) {
    verb->add_option("NAME", a->name, "name or path")->required();
    take_data(*verb, a->data_dir);
  }
  for (CLI::App* const verb : {&list, &show, &check})
    verb->add_flag("--json", a->json, "print the results as JSON");
  CLI::App& fresh = *motor.add_subcommand(
      "new", "write a motor file to be filled in, or import the motor from another program");
  fresh.add_option("NAME", a->name, "file to write, NAME.toml. Default: standard output");
  CLI::Option* const style =
      fresh
          .add_option("--style", a->style,
                      fmt::format("style of the sheet: {}", fmt::join(text::template_styles(), ", ")))
          ->capture_default_str();
  fresh
      .add_option(
          "--from", a->from,
          "read the values from a VESC motor configuration (XML), an ODrive or moteus configuration, a "
          "SimpleFOC sketch or MATLAB's struct of a motor")
      ->excludes(style);
  fresh
      .add_option(
          "--answer", a->answers,
          "answers to questions about the file of --from, as resistance=phase,kv=line-peak; the error message lists the possible answers")
      ->type_name("WORD=CHOICE")
      ->delimiter(',');
  const Verb wiring = declare_wiring(motor), commission = declare_commission(motor),
             identify = declare_identify(motor), emf = declare_emf(motor), fit = declare_fit(motor);
  return {&motor,
          [a, &list, &show, &check, wiring, commission, identify, emf, fit](const std::string& command) {
            for (const Verb& verb : {wiring, commission, identify, emf, fit})
              if (*verb.app) return verb.call(command);
            if (list) return list_motors(*a);
            if (show) return show_motor(*a);
            return check ? check_motor(*a) : new_motor(*a);
          }};
}

}  // namespace cli
