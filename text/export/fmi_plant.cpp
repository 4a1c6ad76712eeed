// SPDX-License-Identifier: Apache-2.0
// Variables of a unit without controller: the importer sets gates, a pair or legs, and reads what a
// controller measures.
#include <fmt/format.h>

#include <utility>

#include "sixstep/base/angle.hpp"
#include "sixstep/control/own/own_controller.h"
#include "sixstep/study/scenario/choices.hpp"
#include "text/export/fmi_variables.hpp"

namespace text {
namespace {

using study::ColumnId;

/// First references of the groups of variables, as in faces/fmu/plant.h.
constexpr unsigned first_gate = 1100, first_of_pair = 1110, first_of_legs = 1120, first_measured = 1200,
                   first_count = 1300;

const char* stand_in_design(const sixstep_given*, const sixstep_real*, void*) { return nullptr; }
void stand_in_step(const void*, void*, const sixstep_measured*, sixstep_real, sixstep_answer*) {}

constexpr sixstep_controller stand_in(std::uint32_t answers) {
  return {.interface = SIXSTEP_OWN_INTERFACE,
          .answers = answers,
          .name = "importer",
          .sentence = "is the program that imports the unit",
          .config_bytes = 0,
          .state_bytes = 0,
          .parameters = 0,
          .parameter = nullptr,
          .design = stand_in_design,
          .start = nullptr,
          .step = stand_in_step,
          .hall = nullptr};
}

/// Adds variables one by one, with consecutive references.
class PlantVariables {
 public:
  PlantVariables(FmiVersion version, std::vector<FmiVariable>& all) : version_(version), all_(all) {}

  void at(unsigned reference) { next_ = reference; }
  void input(FmiKind kind, const char* name, const char* unit, std::string description, double start = 0.0) {
    add({.name = name,
         .kind = kind,
         .role = FmiRole::input,
         .unit = unit,
         .description = std::move(description),
         .start = start});
  }
  void output(FmiKind kind, const char* name, std::string unit, std::string description) {
    add({.name = name, .kind = kind, .unit = std::move(unit), .description = std::move(description)});
  }
  /// Adds a quantity of the three phases. FMI 3: one array. FMI 2: three scalars, with the phase's letter
  /// instead of {} in the name `one`.
  void three(FmiRole role, FmiKind kind, const char* array, fmt::format_string<std::string_view&> one,
             const char* unit, const std::string& description) {
    const FmiVariable like{.name = {}, .kind = kind, .role = role, .unit = unit};
    if (version_ == FmiVersion::fmi3) return add(like, array, description + ", of a, b, c", 3);
    for (std::string_view phase : {"a", "b", "c"})
      add(like, fmt::format(one, phase), fmt::format("{}, of {}", description, phase), 1);
  }
  void add(FmiVariable like, std::string name, std::string description, int count) {
    like.name = std::move(name);
    like.description = std::move(description);
    like.count = count;
    add(std::move(like));
  }

 private:
  void add(FmiVariable variable) {
    variable.reference = next_;
    variable.continuous = false;
    next_ += static_cast<unsigned>(variable.count);
    all_.push_back(std::move(variable));
  }

  FmiVersion version_;
  std::vector<FmiVariable>& all_;
  unsigned next_ = 0;
};

void add_gates(FmiVersion version, PlantVariables& plant) {
  constexpr const char* which[] = {"a_upper", "a_lower", "b_upper", "b_lower", "c_upper", "c_lower"};
  constexpr std::string_view acts =
      "acts at the communication point at which it was set; the importer provides the dead time";
  const FmiVariable like{.name = {}, .kind = FmiKind::boolean, .role = FmiRole::input};
  plant.at(first_gate);
  if (version == FmiVersion::fmi3)
    return plant.add(like, "gates",
                     fmt::format("gates: upper a, lower a, upper b, lower b, upper c, lower c; {}", acts), 6);
  for (const char* gate : which)
    plant.add(like, fmt::format("gate_{}", gate), fmt::format("gate of one switch; {}", acts), 1);
}

constexpr const char* enabled_words =
    "false: all six gates off. Acts at the control tick at or after its communication point";

void add_pair(PlantVariables& plant) {
  using enum FmiKind;
  plant.at(first_of_pair);
  plant.input(boolean, "enabled", "", enabled_words);
  plant.input(integer, "source", "",
              "leg whose upper switch carries the current to the motor: 0 is a, 1 is b, 2 is c");
  plant.input(
      integer, "sink", "",
      "leg whose lower switch carries the current back: 0 is a, 1 is b, 2 is c; must differ from source",
      1.0);
  plant.input(integer, "chopping", "", "chopping of the driven pair: 0 soft, 1 hard, 2 complementary");
  plant.input(integer, "chopped", "",
              "switch of the driven pair that is chopped: 0 the upper switch, 1 the lower switch");
  plant.input(real, "duty", "1", "duty, 0 to 1");
  plant.input(real, "overlap", "1",
              "duty of the third leg: from 0 to 1 of its upper switch, from 0 to -1 of its lower switch");
}

void add_legs(PlantVariables& plant) {
  using enum FmiKind;
  plant.at(first_of_legs);
  plant.input(boolean, "enabled", "", enabled_words);
  plant.three(FmiRole::input, integer, "leg_states", "leg_{}_state", "",
              "state of the leg: 0 off, 1 lower switch on, 2 upper switch on, 3 chopped by its duty");
  plant.three(
      FmiRole::input, integer, "leg_switches", "leg_{}_switches", "",
      "switches that the leg's duty chops: 0 both (complementary), 1 upper, 2 lower, 3 both with the lower switch first");
  plant.three(FmiRole::input, real, "leg_duties", "leg_{}_duty", "1", "duty, 0 to 1");
}

void add_measured(const study::Scenario& s, PlantVariables& plant) {
  using enum FmiKind;
  plant.at(first_measured);
  plant.three(FmiRole::output, real, "measured_currents_A", "measured_i_{}_A", "A",
              "phase current as the controller measures it at the last control tick");
  plant.output(real, "measured_speed_rad_s", "rad/s",
               "speed that the controller measures at the last control tick");
  plant.output(real, "measured_position_deg", "deg",
               "position that the controller measures at the last control tick, counted over turns");
  plant.output(real, "measured_bus_V", "V",
               "bus voltage that the controller measures at the last control tick");
  plant.output(real, "measured_magnet_cos", "1",
               "cosine of the magnet's electrical angle from phase a, measured at the last control tick");
  plant.output(real, "measured_magnet_sin", "1",
               "sine of the magnet's electrical angle from phase a, measured at the last control tick");
  plant.output(integer, "measured_hall", "",
               "Hall code measured at the last control tick, H1 H2 H3 as bits 2, 1, 0");
  plant.output(real, "setpoint", std::string(study::reference_unit(s.control.mode)),
               "the scenario's reference at the last control tick, in the unit of control.mode");
}

/// Adds the converters' counts. With a sensor's bandwidth or delay there are none: sixstep_convert() refuses
/// these.
void add_counts(const study::Scenario& s, PlantVariables& plant) {
  using enum FmiKind;
  if (s.sensors.current_bandwidth_Hz || s.sensors.current_delay_s > 0 || s.sensors.bus_bandwidth_Hz) return;
  const std::string when = ", at each communication point";
  if (s.sensors.currents == sixstep::rig::CurrentMeasurement::phases) {
    plant.at(first_count);
    plant.three(FmiRole::output, integer, "current_counts", "current_counts_{}", "",
                "counts of the phase current's converter" + when);
  }
  if (!s.sensors.bus_range_V) return;
  plant.at(first_count + 3);
  plant.three(FmiRole::output, integer, "terminal_counts", "terminal_counts_{}", "",
              "counts of the converter at the terminal, behind a divider like the divider of the bus" + when);
  plant.output(integer, "bus_counts", "", "counts of the converter of the bus voltage" + when);
}

void add_encoder(const study::Scenario& s, PlantVariables& plant, std::vector<FmiVariable>& all) {
  if (s.sensors.rotor != study::RotorSensing::encoder || s.sensors.shaft != study::SensorShaft::motor ||
      s.sheet.kind == design::MotorKind::linear)
    return;
  plant.at(first_count + 7);
  plant.output(
      FmiKind::integer, "encoder_count", "",
      "edges of the encoder on the motor's shaft (four per line), counted over turns, without missed edges");
  all.back().factor = 4 * s.sensors.encoder.lines / (2 * sixstep::base::pi);
}

}  // namespace

study::Scenario with_stand_in(study::Scenario s, FmiChip chip) {
  static constexpr sixstep_controller pair = stand_in(SIXSTEP_ANSWERS_PAIR),
                                      legs = stand_in(SIXSTEP_ANSWERS_LEGS);
  if (chip != FmiChip::pair && chip != FmiChip::legs) return s;
  s.control.drive = study::FirmwareKind::own;
  s.control.own = {.controller = "importer", .number = {}, .loaded = chip == FmiChip::legs ? &legs : &pair};
  return s;
}

bool is_of_plant(ColumnId id, FmiChip chip) {
  using enum ColumnId;
  if (chip == FmiChip::of_scenario) return true;
  if (chip == FmiChip::gates && id >= encoder_A) return false;  // a part of the controller
  return !(id >= duty && id <= position_ref) && id < i_d;
}

void add_plant(const study::Scenario& s, FmiChip chip, FmiVersion version, std::vector<FmiVariable>& all) {
  PlantVariables plant(version, all);
  switch (chip) {
    case FmiChip::of_scenario:
      return;
    case FmiChip::gates:
      add_gates(version, plant);
      break;
    case FmiChip::pair:
      add_pair(plant);
      break;
    case FmiChip::legs:
      add_legs(plant);
      break;
  }
  if (chip != FmiChip::gates) add_measured(s, plant);
  add_counts(s, plant);
  add_encoder(s, plant, all);
}

}  // namespace text
