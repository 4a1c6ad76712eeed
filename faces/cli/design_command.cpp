// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/design_command.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <filesystem>

#include "faces/cli/choose.hpp"
#include "faces/cli/design_arguments.hpp"
#include "faces/cli/design_use.hpp"
#include "faces/cli/duplicate_outputs.hpp"
#include "faces/cli/field_design.hpp"
#include "faces/cli/new_file.hpp"
#include "faces/cli/optimise_command.hpp"
#include "faces/cli/side_by_side.hpp"
#include "faces/cli/spec_words.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/store_option.hpp"
#include "faces/cli/terminal.hpp"
#include "faces/cli/with_unit.hpp"
#include "files/atomic_file.hpp"
#include "files/own_file.hpp"
#include "files/scenario_on_disk.hpp"
#include "files/trace/model_export.hpp"
#include "report/design_page.hpp"
#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/analysis/verify/carried_over.hpp"
#include "sixstep/analysis/verify/design_study.hpp"
#include "sixstep/analysis/verify/scenario_spec.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"
#include "text/keys/key_advice.hpp"
#include "text/results/design_json.hpp"
#include "text/results/design_text.hpp"
#include "text/scenario/scenario_text.hpp"

namespace cli {
namespace {

namespace fs = std::filesystem;

/// The requested rotor sensor, with the values of the scenario's keys. The sensor is sampled once per PWM
/// period of this design.
design::RotorSensing rotor_of(const DesignArguments& a, const study::Scenario* scenario,
                              const design::DesignSpec& w, base::Problems& found) {
  design::RotorSensing rotor = w.rotor;
  if (a.rotor || (scenario && !w.rotor.hall)) {
    study::Scenario board = scenario ? *scenario : study::Scenario{};
    board.pwm.period_s = w.period_s;
    if (a.rotor) {
      choose("--rotor", *a.rotor, study::rotor_sensing_choices, board.sensors.rotor, found);
      board.sensors = analysis::with_rotor(board.sensors, board.sensors.rotor, w.period_s);
      board.control.drive = study::FirmwareKind::lean;
    }
    rotor = analysis::rotor_sensing_of(board);
  }
  rotor.edges = a.edges.value_or(rotor.edges);
  rotor.capture_Hz = a.capture_Hz.value_or(rotor.capture_Hz);
  if (rotor.shaft.kind == design::ShaftSensorKind::encoder)
    rotor.shaft.capture_Hz =
        a.capture_Hz.value_or(scenario ? rotor.shaft.capture_Hz : design::usual_encoder_capture_Hz);
  return rotor;
}

/// The specification of the design. Options override the scenario's values and the board's defaults.
design::DesignSpec spec_of(const DesignArguments& a, const study::Scenario* scenario, base::Problems& found) {
  // Modes that have a design; off and duty have none.
  constexpr base::Choice<sixstep::control::Mode> modes[] = {study::mode_choices[2], study::mode_choices[3],
                                                            study::mode_choices[4]};
  std::optional<sixstep::control::Mode> mode;
  if (a.mode) choose("--mode", *a.mode, modes, mode.emplace(), found);
  design::DesignSpec w = scenario ? analysis::spec_of(*scenario, mode) : design::on_a_board();
  w.mode = mode.value_or(w.mode);
  choose("--method", a.method, method_choices, w.method, found);
  if (a.chopping) choose("--chopping", *a.chopping, study::chopping_choices, w.chopping, found);
  const auto take = [](std::optional<double>& into, const std::optional<double>& option) {
    if (option) into = option;
  };
  take(w.settle_s, a.settle_s);
  take(w.current_settle_s, a.current_settle_s);
  take(w.voltage_V, a.voltage_V);
  take(w.torque_limit_Nm, a.force_limit_N ? a.force_limit_N : a.torque_limit_Nm);
  take(w.lowest_speed_rad_s, a.lowest_speed_rad_s);
  w.damping = a.damping.value_or(w.damping);
  if (a.damping) w.current_damping.reset();
  w.bandwidth_rad_s = a.bandwidth_rad_s;
  w.period_s = a.period_s.value_or(w.period_s);
  w.rotor = rotor_of(a, scenario, w, found);
  w.load_inertia_kg_m2 = a.load_mass_kg.value_or(a.load_inertia_kg_m2.value_or(w.load_inertia_kg_m2));
  w.delay_periods = a.delay_periods.value_or(w.delay_periods);
  const base::Problems angle =
      base::out_of_range("--angle", a.angle_deg, {}, "deg", "give the rotor's electrical angle in degrees");
  found.insert(found.end(), angle.begin(), angle.end());
  return w;
}

/// The requested files, opened before anything runs.
struct DesignFiles {
  std::optional<files::AtomicFile> json, toml, models, html;

  base::Problems open(const DesignArguments& a) {
    base::Problems found = duplicate_outputs(
        {{"--json", a.json}, {"--toml", a.toml}, {"--models", a.models}, {"--html", a.html}});
    if (!found.empty()) return found;
    const std::string kind = fs::path(a.models).extension().string();
    if (!a.models.empty() && kind != ".json" && kind != ".mat")
      return {{"--models", a.models, "must end in .json or .mat", "give the file one of these extensions"}};
    const auto one = [&](std::optional<files::AtomicFile>& into, const std::string& path) {
      if (path.empty() || path == "-") return;
      base::Result<files::AtomicFile> file = files::AtomicFile::create({path, a.force});
      if (file)
        into.emplace(std::move(*file));
      else
        append(found, file.problems());
    };
    one(json, a.json);
    one(toml, a.toml);
    one(models, a.models);
    one(html, a.html);
    return found;
  }
};

base::Problems put(std::optional<files::AtomicFile>& file, const std::string& text) {
  if (!file) return {};
  file->write(text);
  return file->commit();
}

/// The scenario with the designed loops and all other settings of the board. Warnings name the settings that
/// could not be copied.
analysis::CarriedOver designed_scenario(analysis::DesignStudy& s, const study::Scenario* board,
                                        bool writes_scenario) {
  study::Scenario scenario = s.scenario;
  analysis::require_swing(s, scenario);
  scenario.not_usable = analysis::found_against(s);
  if (!board) return {.scenario = std::move(scenario), .kept = {}, .lost = {}, .differs = {}};
  analysis::CarriedOver carried = analysis::carry_over(s, scenario, *board);
  const auto warn = [&s](std::string what, bool grave) {
    s.warnings.push_back({.what = std::move(what), .cure = "", .grave = grave, .of = design::Concern::board});
  };
  // The advice "usable with" was simulated with the board's parts, but without the limits of the board's
  // drive.
  if (!carried.kept.empty() || !carried.lost.empty())
    for (design::Warning& w : s.warnings)
      if (w.cure.starts_with("usable with")) w.cure += ", tested without the limits of the board's drive";
  // This warning does not change the verdict of a sensorless drive: the verdict is about the loops, and only
  // the drive's commutation is missing in the written file.
  if (!carried.lost.empty()) warn(carried.lost, board->control.drive != study::FirmwareKind::sensorless);
  if (!carried.differs.empty())
    warn("the designed file keeps " + carried.kept + " of the board's scenario, so that its run shows " +
             carried.differs,
         false);
  if (const std::string keys = analysis::left_out(*board, carried.scenario); !keys.empty())
    warn("the design does not use these keys of the board's scenario: " + keys, false);
  if (const std::string course = analysis::replaced(*board, carried.scenario);
      writes_scenario && !course.empty()) {
    const std::string what = " the design's test in place of the board's " + course;
    carried.scenario.notes = "Run with" + what;
    warn("the designed file has" + what +
             "; to export a header, write the gains into the board's scenario and export this scenario",
         false);
  }
  return carried;
}

std::string designed_text(const analysis::DesignStudy& s, const analysis::CarriedOver& carried,
                          const DesignArguments& a) {
  std::vector<std::string> lines = text::design_lines(s, !a.scenario.empty());
  if (!carried.kept.empty()) lines.push_back("It keeps " + carried.kept + " of the board's scenario.");
  study::Scenario scenario = carried.scenario;
  scenario.motor = motor_beside(scenario.motor, a.toml);
  return files::with_own_mark(a.command, text::scenario_text(scenario, lines));
}

base::Problems write(analysis::DesignStudy& s, const study::Scenario* board, const DesignArguments& a,
                     DesignFiles& out) {
  const analysis::CarriedOver carried = designed_scenario(s, board, out.toml || out.html);
  base::Problems found = put(out.json, text::design_json(s));
  const std::string text = out.toml || out.html ? designed_text(s, carried, a) : std::string();
  append(found, put(out.toml, text));
  if (out.html)
    append(found, put(out.html, report::render_design({.study = s,
                                                       .verdict = text::design_verdict(s),
                                                       .scenario = text,
                                                       .command = a.command,
                                                       .version = SIXSTEP_VERSION})));
  if (out.models) {
    const files::ModelPoint point{s.design.motor, a.angle_deg};
    const bool is_mat = fs::path(a.models).extension() == ".mat";
    append(found, put(out.models, is_mat ? files::models_mat(point) : files::models_json(point)));
  }
  return found;
}

/// The scenario that the option --scenario names.
std::optional<study::Scenario> board_of(const DesignArguments& a, base::Problems& found) {
  if (a.scenario.empty()) return std::nullopt;
  const base::Result<study::Scenario> scenario = files::read_scenario(a.scenario, {.data_dir = a.data_dir});
  if (!scenario) {
    found = scenario.problems();
    return std::nullopt;
  }
  return *scenario;
}

/// The motor of the arguments, else the scenario's motor, as the subject of the design.
base::Result<analysis::DesignSubject> subject_of(const DesignArguments& a,
                                                 const std::optional<study::Scenario>& board,
                                                 base::Problems& found) {
  analysis::DesignSubject subject{.motor = a.motor,
                                  .sheet = {},
                                  .board = board,
                                  .currents = {},
                                  .step = a.step,
                                  .dead_time_s = a.toml.empty() ? 0.0 : analysis::usual_dead_time_s};
  if (a.currents) {
    study::Sensors sensors;
    choose("--currents", *a.currents, study::current_sensing_choices, sensors.currents, found);
    subject.currents = sensors.currents;
  }
  if (a.motor.empty() && board) {
    subject.motor = board->motor;
    subject.sheet = board->sheet;
    return subject;
  }
  if (a.motor.empty()) {
    found.push_back({"MOTOR", "", "is missing", "name a motor or its file, or a scenario with --scenario"});
    return found;
  }
  const base::Result<design::Sheet> sheet = files::read_sheet(a.motor, a.data_dir);
  if (sheet)
    subject.sheet = *sheet;
  else
    append(found, sheet.problems());
  return subject;
}

Exit optimise(const DesignArguments& a) {
  if (const base::Problems found = unread_by_optimise(a); !found.empty()) return refused(found);
  return optimise_command({.plan = a.optimise,
                           .store = a.store,
                           .resume = a.resume,
                           .force = a.force,
                           .quiet = a.quiet,
                           .toml = a.toml,
                           .json = a.json,
                           .data_dir = a.data_dir,
                           .command = a.command,
                           .jobs = a.jobs});
}

Exit design_command(const DesignArguments& a) {
  if (!a.optimise.empty()) return optimise(a);
  base::Problems found;
  const std::optional<study::Scenario> board = board_of(a, found);
  if (board && found.empty()) found = analysis::passed_over(*board);
  if (!found.empty()) return refused(found);
  if (board && board->control.drive == study::FirmwareKind::field) return design_field(a, *board);
  const design::DesignSpec spec = spec_of(a, board ? &*board : nullptr, found);
  const base::Result<analysis::DesignSubject> subject = subject_of(a, board, found);
  if (subject) append(found, of_other_motion(subject->sheet, a));
  if (found.empty()) found = in_options(unread_by(spec, a));
  catch_interrupts();
  DesignFiles outputs;
  if (found.empty()) found = outputs.open(a);
  if (!found.empty()) return refused(found);
  base::Result<analysis::DesignStudy> s =
      analysis::study_design({.subject = *subject,
                              .spec = spec,
                              .tolerances = a.quick ? std::vector<analysis::Tolerance>()
                                                    : analysis::sheet_tolerances(subject->sheet, spec.mode),
                              .for_each = side_by_side(a.jobs, a.quiet, "motors"),
                              .keep_going = [] { return !interrupted(); }});
  if (interrupted()) return told_interrupted("design " + a.motor);
  if (!s) return refused(in_options(s.problems()));
  put_in_options(*s);
  warn_of_sheet(subject->sheet, subject->motor, s->warnings);
  if (const base::Problems unwritten = write(*s, board ? &*board : nullptr, a, outputs); !unwritten.empty())
    return refused(unwritten);
  if (a.json == "-") print(text::design_json(*s));
  std::FILE* to = a.json == "-" ? stderr : stdout;  // standard output then holds only the JSON
  if (!a.quiet) print(text::design_text(*s, may_colour(to)), to);
  return s->usable() ? Exit::ok : Exit::failed;
}

void declare_options(CLI::App& design, DesignArguments& a) {
  design.add_option("MOTOR", a.motor, "motor's name or file; with --scenario the scenario's motor");
  design.add_option("--scenario", a.scenario, "scenario whose motor, board and task the design uses");
  design.add_option("--mode", a.mode, "controlled quantity: current, speed or position. Default: current");
  design.add_option(
      "--settle", a.settle_s,
      "settling time of the mode's PI loop in s. Default for current: the shorter of 1e-3 and 8 L/R. Default for speed: 10e-3, or the shortest time that sensor and torque allow");
  design.add_option("--damping", a.damping, "damping of the placed poles, above 0 to 1. Default: 0.9");
  design.add_option(
      "--current-settle", a.current_settle_s,
      "speed, position: settling time of the current loop in s. Default: the shortest of 1e-3, 8 L/R and a tenth of the speed loop's settling time");
  design
      .add_option("--method", a.method,
                  "rule for the gains: pole-placement, cancellation or symmetrical-optimum")
      ->capture_default_str();
  design.add_option("--bandwidth", a.bandwidth_rad_s,
                    "cancellation, symmetrical-optimum: bandwidth of the mode's loop, in rad/s");
  design.add_option("--period", a.period_s, "control and PWM period in s. Default: 30e-6");
  design.add_option("--voltage", a.voltage_V, "bus voltage in V. Default: the sheet's nominal voltage");
  design.add_option(
      "--torque-limit", a.torque_limit_Nm,
      "speed, position: torque limit in N m. Default: the torque of 2.5 times the nominal current");
  design.add_option("--force-limit", a.force_limit_N,
                    "linear motor, instead of --torque-limit: force limit in N");
  design.add_option("--rotor", a.rotor,
                    "rotor position sensor: hall, encoder, absolute, resolver or ideal. Default: hall");
  design.add_option(
      "--edges", a.edges,
      "speed, position: number of Hall edges over which a speed is averaged, 1 to 6. Default: 6 or 1, adaptive");
  design.add_option(
      "--capture", a.capture_Hz,
      "speed, position: clock of the timer that captures the edges of Hall probes or an encoder, in Hz. Default: 1e6, for an encoder 16e6");
  design.add_option(
      "--lowest-speed", a.lowest_speed_rad_s,
      "speed, position: lowest speed that the loop must control, in rad/s or m/s. Default: a tenth of the speed that the bus allows");
  design.add_option("--currents", a.currents,
                    "current sensor: phases, dc-link, low-side or ideal. Default: phases");
  design.add_option("--load-inertia", a.load_inertia_kg_m2,
                    "speed, position: inertia on the shaft besides the rotor's, in kg m2. Default: 0");
  design.add_option("--load-mass", a.load_mass_kg,
                    "linear motor, instead of --load-inertia: mass on the slide, in kg. Default: 0");
  design.add_option("--delay", a.delay_periods,
                    "control periods until a command takes effect, 0 or 1. Default: 1");
  design.add_option("--chopping", a.chopping, "chopping: soft, hard or complementary. Default: soft");
  design.add_option("--step", a.step, "simulated step, in the mode's unit: A, rad/s (m/s) or deg (mm)");
  design.add_option("--json", a.json, "write all numbers as JSON; - writes to standard output");
  design.add_option(
      "--toml", a.toml,
      "write the simulated scenario, for sixstep run and export; without --scenario the dead time is 0.5 us");
  design.add_option("--html", a.html, "write the design as an HTML page");
  CLI::Option* models = design.add_option(
      "--models", a.models, "write the motor's two state-space models, to a .json or .mat file");
  design.add_option("--angle", a.angle_deg, "angle of the rotor for --models, in electrical degrees")
      ->capture_default_str()
      ->needs(models);
  CLI::Option* optimise = design.add_option(
      "--optimise", a.optimise,
      "plan with ranges and the figure to minimise; the design is the best point, and the output names the limits of this point");
  take_store(design, a.store, "store each run of --optimise in this SQLite file")->needs(optimise);
  design.add_flag("--resume", a.resume, "continue the runs of --store")->needs("--store");
  take_force(design, a.force);
  design.add_flag("--quick", a.quick, "do not simulate the motors within the tolerances");
  design.add_flag("--quiet", a.quiet, "print errors only");
  for (const auto& [option, unit] :
       {std::pair{"--settle", "s"}, std::pair{"--current-settle", "s"}, std::pair{"--period", "s"},
        std::pair{"--voltage", "V"}, std::pair{"--torque-limit", "Nm"}, std::pair{"--force-limit", "N"},
        std::pair{"--capture", "Hz"}, std::pair{"--lowest-speed", "rad/s"},
        std::pair{"--load-inertia", "kg m2"}, std::pair{"--load-mass", "kg"}})
    take_unit(design.get_option(option), unit);
  take_jobs(design, a.jobs);
  take_data(design, a.data_dir);
}

}  // namespace

Verb declare_design(CLI::App& app) {
  CLI::App& design = *app.add_subcommand(
      "design", "compute gains from a motor's sheet, and simulate motors within the sheet's tolerances");
  const auto a = std::make_shared<DesignArguments>();
  declare_options(design, *a);
  return {&design, calling(design_command, a)};
}

}  // namespace cli
