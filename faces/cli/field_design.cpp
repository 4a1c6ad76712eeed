// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/field_design.hpp"

#include "faces/cli/keep.hpp"
#include "faces/cli/terminal.hpp"
#include "files/atomic_file.hpp"
#include "sixstep/analysis/verify/field_study.hpp"
#include "text/results/field_design_text.hpp"

namespace cli {
namespace {

/// Of a field-oriented drive the scenario says all, and its own rules have made the gains.
base::Problems six_step_options(const DesignArguments& a) {
  base::Problems found;
  const auto refuse = [&](bool given, const char* option, const char* cure) {
    if (given)
      found.push_back(
          {option, "", "is of six-step's design, and the scenario's drive is field-oriented", cure});
  };
  const char* const key = "say it in the scenario, in control, pwm, supply, sensors or load";
  refuse(!a.motor.empty(), "MOTOR", "leave it out: the scenario names its motor");
  refuse(a.mode.has_value(), "--mode", key);
  refuse(a.method != "pole-placement", "--method", "see control.field.bandwidth_Hz");
  refuse(a.bandwidth_rad_s.has_value(), "--bandwidth", "see control.field.bandwidth_Hz");
  refuse(a.chopping.has_value(), "--chopping", key);
  refuse(a.rotor || a.edges, a.rotor ? "--rotor" : "--edges", key);
  refuse(a.currents.has_value(), "--currents", key);
  refuse(a.settle_s.has_value(), "--settle", key);
  refuse(a.current_settle_s.has_value(), "--current-settle", key);
  refuse(a.damping.has_value(), "--damping", key);
  refuse(a.period_s.has_value(), "--period", key);
  refuse(a.delay_periods.has_value(), "--delay", key);
  refuse(a.voltage_V.has_value(), "--voltage", key);
  refuse(a.torque_limit_Nm || a.force_limit_N, a.torque_limit_Nm ? "--torque-limit" : "--force-limit", key);
  refuse(a.load_inertia_kg_m2 || a.load_mass_kg, a.load_mass_kg ? "--load-mass" : "--load-inertia", key);
  refuse(a.lowest_speed_rad_s.has_value(), "--lowest-speed", "it is the reference's own lowest");
  refuse(a.step.has_value(), "--step", "nothing is simulated: sixstep run does that");
  const char* const not_written = "leave it out: --json has all numbers";
  refuse(!a.toml.empty(), "--toml", not_written);
  refuse(!a.html.empty(), "--html", not_written);
  refuse(!a.models.empty(), "--models", not_written);
  return found;
}

}  // namespace

Exit design_field(const DesignArguments& a, const study::Scenario& scenario) {
  base::Problems found = six_step_options(a);
  std::optional<files::AtomicFile> file;
  if (!a.json.empty() && a.json != "-") keep(file, files::AtomicFile::create({a.json, a.force}), found);
  if (!found.empty()) return refused(found);
  const base::Result<analysis::FieldStudy> s = analysis::study_field(scenario);
  if (!s) return refused(s.problems());
  const std::string json = a.json.empty() ? "" : text::field_design_json(*s);
  if (file) {
    file->write(json);
    if (found = file->commit(); !found.empty()) return refused(found);
  }
  if (a.json == "-") print(json);
  std::FILE* to = a.json == "-" ? stderr : stdout;  // standard output is the JSON's alone
  if (!a.quiet) print(text::field_design_text(*s, may_colour(to)), to);
  return s->usable() ? Exit::ok : Exit::failed;
}

}  // namespace cli
