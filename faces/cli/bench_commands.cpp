// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/bench_commands.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <utility>

#include "faces/cli/result_files.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "files/own_file.hpp"
#include "files/scenario_on_disk.hpp"
#include "files/text_file.hpp"
#include "report/emf_page.hpp"
#include "report/identify_page.hpp"
#include "sixstep/analysis/identification/built_machines.hpp"
#include "sixstep/base/plausible.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"
#include "sixstep/design/sheet/winding_description.hpp"
#include "text/escape/escape.hpp"
#include "text/recording/bench_recordings.hpp"
#include "text/results/identify_text.hpp"

namespace cli {
namespace {

/// Arguments of `motor identify` and of `motor emf`.
struct BenchArguments {
  std::string path;
  text::BenchColumns columns;
  std::string between;
  std::optional<double> interval_s;
  std::optional<int> pole_pairs;
  bool json = false, quiet = false, force = false;
  std::string write, html;
  std::string command;  ///< the command that writes the files again
};

struct EmfArguments : BenchArguments {
  std::string motor, data_dir, shape;
  std::optional<double> speed_rpm, tolerance_percent;
};

/// Adds a Problem if `x`, the value of an option, is out of its range.
void hold(base::Problems& problems, const char* option, const std::optional<double>& x, base::Range range,
          const char* cure) {
  if (x && !range.holds(*x)) problems.push_back({option, base::written(*x), base::limit_of(range), cure});
}

base::Problems check(BenchArguments& a) {
  base::Problems problems;
  hold(problems, "--interval", a.interval_s, base::allowed(base::above(0.0), "s"),
       "give the time from one row to the next in seconds");
  if (a.pole_pairs)
    hold(problems, "--pole-pairs", *a.pole_pairs, base::between(1, design::most_pole_pairs),
         "give half the number of magnet poles");
  if (a.between == "lines") a.columns.between = analysis::EmfBetween::lines;
  if (a.between == "star") a.columns.between = analysis::EmfBetween::star;
  if (!a.between.empty() && !a.columns.between)
    problems.push_back({"--between", text::visible(a.between), "must be lines or star",
                        "give lines for two terminals, or star for a terminal and one common point"});
  a.columns.interval_s = a.interval_s;
  return problems;
}

/// In problems, replaces the names of the library's members and of the recording's columns by options. Any
/// other problem gets the recording's path.
base::Problems of_recording(base::Problems problems, const std::string& path) {
  constexpr std::pair<std::string_view, std::string_view> options[] = {
      {"between", "--between"}, {"pole_pairs", "--pole-pairs"}, {"speed", "--speed"}};
  for (base::Problem& p : problems) {
    const auto* const option = std::find_if(std::begin(options), std::end(options),
                                            [&](const auto& o) { return o.first == p.where; });
    if (option != std::end(options))
      p.where = option->second;
    else if (!p.where.starts_with(path + ":"))
      p.where = path + ": " + p.where;
  }
  return problems;
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// Prints the reader's notes on standard error, because standard output may be JSON.
void tell(const BenchArguments& a, const text::Notes& notes) {
  if (a.quiet) return;
  for (const std::string& note : notes)
    print(fmt::format("{}: {}\n", text::visible(file_name(a.path)), text::visible(note)), stderr);
}

base::Result<text::Recording> recording_of(const BenchArguments& a) {
  const base::Result<std::string> text = files::read_text(a.path);
  if (!text) return text.problems();
  return text::read_recording(a.path, *text);
}

Exit identify_command(const BenchArguments& arguments) {
  BenchArguments a = arguments;
  if (const base::Problems wrong = check(a); !wrong.empty()) return refused(wrong);
  const base::Result<text::Recording> recording = recording_of(a);
  if (!recording) return refused(recording.problems());
  text::Notes notes = recording->notes;
  const base::Result<analysis::HallLog> log = text::hall_log_of(*recording, a.columns, notes);
  if (!log) return refused(of_recording(log.problems(), a.path));
  catch_interrupts();
  ResultFiles out;
  base::Problems problems = out.open({{"--write", a.write}, {"--html", a.html}}, a.force);
  if (!problems.empty()) return refused(problems);
  const base::Result<analysis::HallIdentity> found =
      analysis::identify(*log, a.pole_pairs.value_or(1), [] { return !interrupted(); });
  if (interrupted()) return told_interrupted("motor identify " + text::visible(a.path));
  if (!found) return refused(of_recording(found.problems(), a.path));
  tell(a, notes);
  const std::string name = file_name(a.path);
  if (out.has("--write"))
    out.put("--write", files::with_own_mark(a.command, text::identify_toml(name, *found)), problems);
  if (out.has("--html"))
    out.put("--html", report::render_identify({name, *found, a.command, SIXSTEP_VERSION}), problems);
  if (a.json)
    print(text::identify_json(name, *found));
  else if (!a.quiet)
    print(text::identify_text(name, *found));
  complain(problems);
  return problems.empty() ? Exit::ok : Exit::bad_input;
}

/// Reads the sheet, if there is one. An option --pole-pairs must be equal to the sheet's value.
base::Result<std::optional<design::Sheet>> sheet_of(EmfArguments& a) {
  if (a.motor.empty()) return std::optional<design::Sheet>();
  const base::Result<design::Sheet> sheet = files::read_sheet(a.motor, a.data_dir);
  if (!sheet) return sheet.problems();
  const std::optional<int> of_sheet = design::sheet_constants(*sheet).pole_pairs;
  if (a.pole_pairs && of_sheet && *a.pole_pairs != *of_sheet)
    return base::Problem{
        "--pole-pairs", std::to_string(*a.pole_pairs),
        fmt::format("contradicts the {} pole pairs of {}", *of_sheet, text::visible(sheet->name)),
        "leave out --pole-pairs or --motor: the option whose value is less certain"};
  if (of_sheet) a.pole_pairs = of_sheet;
  return std::optional(*sheet);
}

/// The path of the back-EMF shape's table, relative to the motor file.
std::string shape_beside(const EmfArguments& a) {
  if (a.shape.empty() || a.write.empty()) return file_name(a.shape);
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::absolute(a.write, error).parent_path();
  const std::filesystem::path relative = std::filesystem::relative(a.shape, folder, error);
  return relative.empty() ? a.shape : relative.generic_string();
}

void write_emf(const EmfArguments& a, const text::MeasuredEmf& measured, const analysis::EmfRecord& record,
               ResultFiles& out, base::Problems& problems) {
  if (out.has("--shape"))
    out.put("--shape", files::csv_head(a.command) + text::emf_shape_csv(measured), problems);
  if (out.has("--write"))
    out.put("--write", files::with_own_mark(a.command, text::emf_motor_lines(measured, shape_beside(a))),
            problems);
  if (out.has("--html"))
    out.put("--html", report::render_emf({measured, record, a.command, SIXSTEP_VERSION}), problems);
  if (a.json)
    print(text::emf_json(measured));
  else if (!a.quiet)
    print(text::emf_text(measured));
}

Exit emf_command(const EmfArguments& arguments) {
  EmfArguments a = arguments;
  base::Problems problems = check(a);
  hold(problems, "--speed", a.speed_rpm, analysis::built_shaft_rpm,
       "give the speed of the shaft in rpm, not the electrical speed");
  hold(problems, "--tolerance", a.tolerance_percent, base::strictly_between(0, 100),
       "give a tolerance in percent; 5 is usual, because magnets differ by a few percent");
  if (!problems.empty()) return refused(problems);
  const base::Result<std::optional<design::Sheet>> sheet = sheet_of(a);
  if (!sheet) return refused(sheet.problems());
  const base::Result<text::Recording> recording = recording_of(a);
  if (!recording) return refused(recording.problems());
  text::Notes notes = recording->notes;
  const base::Result<analysis::EmfRecord> record = text::emf_record_of(*recording, a.columns, notes);
  if (!record) return refused(of_recording(record.problems(), a.path));
  catch_interrupts();
  ResultFiles out;
  problems = out.open({{"--write", a.write}, {"--html", a.html}, {"--shape", a.shape}}, a.force);
  if (!problems.empty()) return refused(problems);
  const std::optional<double> speed_rad_s =
      a.speed_rpm ? std::optional(*a.speed_rpm * std::numbers::pi / 30.0) : std::nullopt;
  const base::Result<analysis::EmfResult> found = analysis::measure_emf({*record, a.pole_pairs, speed_rad_s});
  if (interrupted()) return told_interrupted("motor emf " + text::visible(a.path));
  if (!found) return refused(of_recording(found.problems(), a.path));
  tell(a, notes);
  text::MeasuredEmf measured{file_name(a.path), *found};
  measured.tolerance = a.tolerance_percent ? *a.tolerance_percent / 100.0 : analysis::usual_emf_tolerance;
  if (*sheet) {
    measured.sheet = (*sheet)->name;
    measured.checks = analysis::check_frames(*found, **sheet, measured.tolerance);
  }
  write_emf(a, measured, *record, out, problems);
  complain(problems);
  if (!problems.empty()) return Exit::bad_input;
  const bool holds =
      std::all_of(measured.checks.begin(), measured.checks.end(), [](const auto& c) { return c.holds(); });
  return holds ? Exit::ok : Exit::failed;
}

void declare_common(CLI::App& verb, BenchArguments& a, const char* voltages) {
  verb.add_option("--voltages", a.columns.voltages, voltages)->delimiter(',');
  verb.add_option(
      "--between", a.between,
      "points between which the voltages were measured: lines (two terminals) or star (a terminal and a common point)");
  verb.add_option("--interval", a.interval_s,
                  "time from one row to the next in s, if the file has no column of time");
  verb.add_flag("--json", a.json, "print the results as JSON");
  verb.add_option("--html", a.html, "write a page with charts");
  take_force(verb, a.force);
  verb.add_flag("--quiet", a.quiet, "print errors only; files are still written");
}

}  // namespace

Verb declare_identify(CLI::App& motor) {
  CLI::App& identify = *motor.add_subcommand(
      "identify", "find wires, spacing, positions and jitter of Hall probes from a log of a turning motor");
  const auto a = std::make_shared<BenchArguments>();
  identify
      .add_option(
          "LOG", a->path,
          "CSV file with time, Hall lines (hall1, hall2, hall3, or hall for their code) and, if recorded, voltages (u_ab, u_bc, also u_ca; or u_a, u_b, u_c)")
      ->required();
  identify
      .add_option(
          "--hall", a->columns.hall,
          "headings of the three Hall lines, as CH1,CH2,CH3, or the heading of one column of Hall codes")
      ->delimiter(',');
  declare_common(identify, *a, "headings of the voltages, as CH4,CH5,CH6");
  identify.add_option(
      "--pole-pairs", a->pole_pairs,
      "locate each edge of a shaft turn separately. Default: the six edges of an electrical turn");
  identify.add_option("--write", a->write,
                      "write the keys for a scenario, and the commutation table for a user's firmware");
  return {&identify, calling(identify_command, a)};
}

Verb declare_emf(CLI::App& motor) {
  CLI::App& emf = *motor.add_subcommand(
      "emf", "compute constants, harmonics and shape of the back-EMF from a recording of open terminals");
  const auto a = std::make_shared<EmfArguments>();
  emf.add_option("SCOPE", a->path, "CSV file with a column of time and one to three columns of voltages")
      ->required();
  declare_common(emf, *a, "headings of the voltages, as CH1,CH2");
  emf.add_option("--pole-pairs", a->pole_pairs, "electrical turns per turn of the shaft");
  emf.add_option("--speed", a->speed_rpm, "speed of the shaft, rpm; speed and frequency give the pole pairs");
  emf.add_option("--motor", a->motor,
                 "motor whose sheet is compared with the recording; the sheet also gives the pole pairs");
  emf.add_option("--tolerance", a->tolerance_percent,
                 "largest deviation from the sheet's constants that counts as equal, percent. Default: 5");
  take_data(emf, a->data_dir);
  emf.add_option("--write", a->write, "write the keys for a motor file");
  emf.add_option("--shape", a->shape, "write the shape as a table that back_emf_file reads");
  return {&emf, [a](const std::string& command) {
            a->command = command;
            return emf_command(*a);
          }};
}

}  // namespace cli
