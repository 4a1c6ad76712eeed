// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/design_use.hpp"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "sixstep/design/loops/spec_use.hpp"
#include "sixstep/design/sheet/sheet_check.hpp"

namespace cli {
namespace {

constexpr const char* in_scenario =
    "set the value in the scenario: in [control], [pwm], [supply], [sensors] or [load]";
constexpr const char* by_bandwidth = "set control.field.bandwidth_Hz in the scenario";
constexpr const char* not_written = "leave this option out: --json has all numbers";

struct Use {
  const char* option;
  bool (*given)(const DesignArguments&);
  std::string_view member;  ///< member of the spec that the option sets; empty: every design of gains uses
                            ///< the option
  const char* in_field;     ///< cure if a field-oriented drive does not use the option; nullptr: it does
  bool in_optimise;         ///< true: --optimise reads the option
};

using A = DesignArguments;

/// All options except --force, --quiet, --jobs, --data and the options of --optimise.
constexpr Use uses[] = {
    {"MOTOR", [](const A& a) { return !a.motor.empty(); }, "",
     "leave this option out: the scenario names its motor", false},
    {"--scenario", [](const A& a) { return !a.scenario.empty(); }, "", nullptr, false},
    {"--mode", [](const A& a) { return a.mode.has_value(); }, "mode", in_scenario, false},
    {"--method", [](const A& a) { return a.method != A{}.method; }, "method", by_bandwidth, false},
    {"--bandwidth", [](const A& a) { return a.bandwidth_rad_s.has_value(); }, "bandwidth_rad_s", by_bandwidth,
     false},
    {"--chopping", [](const A& a) { return a.chopping.has_value(); }, "chopping", in_scenario, false},
    {"--rotor", [](const A& a) { return a.rotor.has_value(); }, "rotor", in_scenario, false},
    {"--edges", [](const A& a) { return a.edges.has_value(); }, "edges", in_scenario, false},
    {"--capture", [](const A& a) { return a.capture_Hz.has_value(); }, "capture_Hz", in_scenario, false},
    {"--currents", [](const A& a) { return a.currents.has_value(); }, "", in_scenario, false},
    {"--settle", [](const A& a) { return a.settle_s.has_value(); }, "settle_s", in_scenario, false},
    {"--current-settle", [](const A& a) { return a.current_settle_s.has_value(); }, "current_settle_s",
     in_scenario, false},
    {"--damping", [](const A& a) { return a.damping.has_value(); }, "damping", in_scenario, false},
    {"--period", [](const A& a) { return a.period_s.has_value(); }, "period_s", in_scenario, false},
    {"--delay", [](const A& a) { return a.delay_periods.has_value(); }, "delay_periods", in_scenario, false},
    {"--voltage", [](const A& a) { return a.voltage_V.has_value(); }, "voltage_V", in_scenario, false},
    {"--torque-limit", [](const A& a) { return a.torque_limit_Nm.has_value(); }, "torque_limit_Nm",
     in_scenario, false},
    {"--force-limit", [](const A& a) { return a.force_limit_N.has_value(); }, "torque_limit_Nm", in_scenario,
     false},
    {"--load-inertia", [](const A& a) { return a.load_inertia_kg_m2.has_value(); }, "load_inertia_kg_m2",
     in_scenario, false},
    {"--load-mass", [](const A& a) { return a.load_mass_kg.has_value(); }, "load_inertia_kg_m2", in_scenario,
     false},
    {"--lowest-speed", [](const A& a) { return a.lowest_speed_rad_s.has_value(); }, "lowest_speed_rad_s",
     "leave this option out: the lowest speed of the reference is used", false},
    {"--step", [](const A& a) { return a.step.has_value(); }, "",
     "leave this option out: this design simulates nothing; use sixstep run", false},
    {"--quick", [](const A& a) { return a.quick; }, "",
     "leave this option out: this design is computed in closed form, without tolerances", false},
    {"--json", [](const A& a) { return !a.json.empty(); }, "", nullptr, true},
    {"--toml", [](const A& a) { return !a.toml.empty(); }, "", not_written, true},
    {"--html", [](const A& a) { return !a.html.empty(); }, "", not_written, false},
    {"--models", [](const A& a) { return !a.models.empty(); }, "", not_written, false},
};

}  // namespace

base::Problems unread_by(const design::DesignSpec& spec, const DesignArguments& a) {
  base::Problems found;
  for (const Use& use : uses)
    if (use.given(a))
      if (std::optional<base::Problem> idle = design::without_use(spec, use.member)) {
        idle->where = use.option;
        found.push_back(std::move(*idle));
      }
  return found;
}

base::Problems of_other_motion(const design::Sheet& sheet, const DesignArguments& a) {
  base::Problems found;
  const bool linear = sheet.kind == design::MotorKind::linear;
  const auto refuse = [&](const std::optional<double>& given, const char* option, const char* instead) {
    if (given)
      found.push_back({option, fmt::format("{}", *given),
                       linear ? "applies to rotary motors only, and this motor is linear"
                              : "applies to linear motors only, and this motor is rotary",
                       fmt::format("write {}", instead)});
  };
  refuse(linear ? a.torque_limit_Nm : a.force_limit_N, linear ? "--torque-limit" : "--force-limit",
         linear ? "--force-limit" : "--torque-limit");
  refuse(linear ? a.load_inertia_kg_m2 : a.load_mass_kg, linear ? "--load-inertia" : "--load-mass",
         linear ? "--load-mass" : "--load-inertia");
  return found;
}

base::Problems unread_by_field_design(const DesignArguments& a) {
  base::Problems found;
  for (const Use& use : uses)
    if (use.in_field != nullptr && use.given(a))
      found.push_back(
          {use.option, "",
           "applies to the design of six-step drives only, and the scenario's drive is field-oriented",
           use.in_field});
  return found;
}

base::Problems unread_by_optimise(const DesignArguments& a) {
  base::Problems found;
  for (const Use& use : uses)
    if (!use.in_optimise && use.given(a))
      found.push_back({use.option, "",
                       "applies to a single design, and --optimise reads this value from the plan",
                       "leave this option out, or set the value in the plan or its scenario"});
  return found;
}

void warn_of_sheet(const design::Sheet& sheet, const std::string& motor,
                   std::vector<design::Warning>& warnings) {
  const base::Result<design::SheetCheck> check = design::check_sheet(sheet);
  if (!check || check->consistent) return;
  warnings.push_back({.what = design::contradiction_words(*check),
                      .cure = fmt::format("see the contradiction with: sixstep motor check {}", motor),
                      .grave = false,
                      .of = design::Concern::other});
}

}  // namespace cli
