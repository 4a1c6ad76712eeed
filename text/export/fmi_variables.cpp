// SPDX-License-Identifier: Apache-2.0
#include "text/export/fmi_variables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/linear.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"
#include "sixstep/study/session/session.hpp"

namespace text {
namespace {

using study::ColumnId;

constexpr unsigned first_input = 1000, first_use = 1020, first_clock = 1030, digest_reference = 2000;
constexpr std::string_view acts =
    "A change acts at the first control tick at or after the communication point at which it was made";

constexpr FmiUnit fmi_units[] = {
    {.name = "1"},
    {.name = "s", .s = 1},
    {.name = "A", .A = 1},
    {.name = "V", .kg = 1, .m = 2, .s = -3, .A = -1},
    {.name = "rad", .rad = 1, .display = "deg", .display_factor = 180 / sixstep::base::pi},
    {.name = "deg", .rad = 1, .factor = sixstep::base::pi / 180},
    {.name = "rad/s", .s = -1, .rad = 1, .display = "rpm", .display_factor = 30 / sixstep::base::pi},
    {.name = "N m", .kg = 1, .m = 2, .s = -2},
    {.name = "m", .m = 1},
    {.name = "mm", .m = 1, .factor = 1e-3},
    {.name = "m/s", .m = 1, .s = -1},
    {.name = "N", .kg = 1, .m = 1, .s = -2},
    {.name = "degC", .K = 1, .offset = 273.15},
};

bool is_code(ColumnId id) {
  return (id >= ColumnId::gate_T1 && id <= ColumnId::sector) ||
         (id >= ColumnId::encoder_A && id <= ColumnId::absolute_code);
}

/// Whether a signal is constant between two events: gates, and everything that the controller sets at its
/// samples.
bool is_held_signal(ColumnId id) {
  using enum ColumnId;
  return is_code(id) || id == duty || id == i_ref || id == speed_ref || id == position_ref ||
         (id >= i_d && id <= v_q);
}

std::string described_with_frame(const study::Column& column) {
  return column.frame.empty() ? column.meaning : fmt::format("{} ({})", column.meaning, column.frame);
}

/// Currents and terminal voltages of the three phases as one variable.
FmiVariable fmi_phases(ColumnId first, const std::vector<study::Column>& signals) {
  const auto c = static_cast<unsigned>(first);
  const bool currents = first == ColumnId::i_a;
  return {.name = currents ? "phase_currents_A" : "terminal_voltages_V",
          .reference = c,
          .unit = signals[c].unit,
          .description = currents ? "currents of phases a, b, c into the motor"
                                  : "voltages of terminals a, b, c (pole, against the negative rail)",
          .factor = signals[c].per_turning,
          .count = 3};
}

void add_outputs(const study::Scenario& s, FmiChip chip, FmiVersion version, std::vector<FmiVariable>& all) {
  const std::vector<study::Column>& signals = study::all_columns(s.sheet.kind);
  for (std::size_t c = 1; c < signals.size(); ++c) {
    const auto id = static_cast<ColumnId>(c);
    if (!study::applies(id, s) || !is_of_plant(id, chip)) continue;
    if (chip != FmiChip::of_scenario && version == FmiVersion::fmi3 && id <= ColumnId::u_c) {
      if (id == ColumnId::i_a || id == ColumnId::u_a) all.push_back(fmi_phases(id, signals));
      continue;
    }
    all.push_back({.name = signals[c].name,
                   .reference = static_cast<unsigned>(c),
                   .kind = is_code(id) ? FmiKind::integer : FmiKind::real,
                   .continuous = !is_held_signal(id),
                   .unit = signals[c].unit,
                   .description = described_with_frame(signals[c]),
                   .factor = signals[c].per_turning});
  }
}

/// Whether the session accepts the change `set` at its beginning.
template <class Set>
bool takes(const study::Session& open, const Set& set) {
  study::Session tried = open;
  study::At at;
  set(at);
  return static_cast<bool>(tried.change(std::move(at)));
}

double load_at_start(const study::Load& load) {
  const bool listed = !load.times_s.empty() && !load.torques_Nm.empty() && load.times_s[0] <= 0.0;
  return listed ? load.torques_Nm[0] : load.torque_Nm;
}

FmiVariable fmi_input(const char* name, const char* key, std::string unit, double start,
                      const std::string& description) {
  return {.name = name,
          .role = FmiRole::input,
          .continuous = false,
          .unit = std::move(unit),
          .description = fmt::format("{}. {}", description, acts),
          .start = start,
          .key = key};
}

void add_inputs(const study::Scenario& s, FmiChip chip, const study::Session& open,
                std::vector<FmiVariable>& all) {
  const bool linear = s.sheet.kind == design::MotorKind::linear;
  std::vector<FmiVariable> inputs;
  const double reference = study::reference_waveform(s).front().value, load = load_at_start(s.load);
  const std::string_view of_mode = study::reference_unit(s.control.mode);
  const base::LinearUnit unit = linear ? base::in_linear(of_mode) : base::LinearUnit{of_mode, of_mode};
  if (chip != FmiChip::gates && s.control.mode != sixstep::control::Mode::off &&
      takes(open, [&](study::At& at) { at.reference = study::Reference{.value = reference}; }))
    inputs.push_back(
        fmi_input("reference", "reference.value", std::string(unit.linear), reference * unit.factor,
                  "reference of the controller, in the unit of control.mode; until the first change of this "
                  "input, the scenario's own reference applies"));
  if (takes(open, [&](study::At& at) { at.load.torque_Nm = load; }))
    inputs.push_back(
        linear ? fmi_input("load_force", "load.force_N", "N", load, "load force, against the motion")
               : fmi_input("load_torque", "load.torque_Nm", "N m", load, "load torque at the shaft"));
  if (takes(open, [&](study::At& at) { at.supply.voltage_V = s.supply.voltage_V; }))
    inputs.push_back(fmi_input("supply_voltage", "supply.voltage_V", "V", s.supply.voltage_V,
                               "open-circuit voltage of the source"));
  for (FmiVariable& variable : inputs) {
    variable.reference = first_input + static_cast<unsigned>(&variable - inputs.data());
    all.push_back(std::move(variable));
  }
}

/// Clocks of FMI 3, and whether each is used.
void add_clocks(std::vector<FmiVariable>& all) {
  const auto add = [&all](const char* name, unsigned reference, FmiKind kind, FmiRole role,
                          const char* description) {
    all.push_back({.name = name,
                   .reference = reference,
                   .kind = kind,
                   .role = role,
                   .continuous = false,
                   .description = description});
  };
  add("use_tick_clock", first_use, FmiKind::boolean, FmiRole::parameter,
      "true: tick_clock ticks at each control tick; false: tick_clock never ticks");
  add("use_hall_clock", first_use + 1, FmiKind::boolean, FmiRole::parameter,
      "true: hall_clock ticks at each change of the Hall code; false: hall_clock never ticks");
  add("tick_clock", first_clock, FmiKind::clock, FmiRole::output, "ticks at each control tick");
  add("hall_clock", first_clock + 1, FmiKind::clock, FmiRole::output,
      "ticks at each change of the Hall code");
}

}  // namespace

const FmiUnit* fmi_unit(std::string_view name) {
  const auto* const found = std::ranges::find(fmi_units, name, &FmiUnit::name);
  return found == std::end(fmi_units) ? nullptr : found;
}

base::Result<std::vector<FmiVariable>> fmi_variables(const study::Scenario& given, FmiChip chip,
                                                     FmiVersion version) {
  const study::Scenario scenario = with_stand_in(given, chip);
  const base::Result<study::Session> open = study::Session::open(scenario);
  if (!open) return open.problems();
  std::vector<FmiVariable> all = {
      {.name = "time",
       .role = FmiRole::time,
       .unit = "s",
       .description = "time of the importer; the run begins at the importer's start time"}};
  add_outputs(scenario, chip, version, all);
  add_inputs(scenario, chip, *open, all);
  add_plant(scenario, chip, version, all);
  if (version == FmiVersion::fmi3) add_clocks(all);
  all.push_back(
      {.name = "digest",
       .reference = digest_reference,
       .kind = FmiKind::text,
       .continuous = false,
       .description =
           "digest of all events of the run as 16 hexadecimal digits, set when the run is terminated; equal "
           "runs have equal digests, also with sixstep run"});
  return all;
}

}  // namespace text
