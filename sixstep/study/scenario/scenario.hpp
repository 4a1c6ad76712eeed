// SPDX-License-Identifier: Apache-2.0
// A scenario as typed data: everything that one run needs, with files already resolved to numbers. Only
// scenario_description.hpp describes each key, with unit, range and default.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/pwm_pattern.hpp"
#include "sixstep/design/sheet/sheet.hpp"
#include "sixstep/study/scenario/at.hpp"
#include "sixstep/study/scenario/believed.hpp"
#include "sixstep/study/scenario/control.hpp"
#include "sixstep/study/scenario/load.hpp"
#include "sixstep/study/scenario/measure.hpp"
#include "sixstep/study/scenario/protection.hpp"
#include "sixstep/study/scenario/recording.hpp"
#include "sixstep/study/scenario/sensors.hpp"

namespace sixstep::study {

/// Kind of the source, which determines its open-circuit voltage. For `steady` it is voltage_V; for the
/// others voltage_V is only the nominal bus voltage.
enum class SourceKind : std::uint8_t { steady, battery, single_phase, three_phase };

struct Supply {
  SourceKind source = SourceKind::steady;
  double voltage_V = 24.0;
  double resistance_ohm = 0.0;  // if capacitance_F > 0: between source and bus capacitor; else the bus is
                                // stiff
  double capacitance_F = 0.0;
  bool sinks = true;
  double inductance_H = 0.0;          // of the source, in series with resistance_ohm
  double brake_resistance_ohm = 0.0;  // across the bus from brake_on_V until brake_off_V; 0: no chopper
  double brake_on_V = 0.0, brake_off_V = 0.0;
  double sink_limit_A = 0.0;              // sinks = false: current that the source takes back nevertheless
  double capacitor_resistance_ohm = 0.0;  // of the bus capacitor
  std::vector<double> battery_charges,
      battery_voltages_V;  // open-circuit voltage over charge
  double battery_capacity_Ah = 0.0;
  double battery_charge = 1.0;  // charge at the start, relative to the full charge
  double battery_recovery_ohm = 0.0, battery_recovery_F = 0.0;
  double mains_rms_V = 0.0;  // single phase: of the line; three phases: line-to-line
  double mains_Hz = 50.0;
  double rectifier_drop_V = 0.0;  // of each of the two conducting diodes
};

enum class Device : std::uint8_t { mosfet, igbt };

struct Bridge {
  rig::WireOrder phases = rig::WireOrder::abc;  // the motor's phases at legs a, b, c
  Device device = Device::mosfet;
  double on_resistance_ohm = 0.0;
  double saturation_V = 0.0;  // used for IGBTs only
  double diode_drop_V = 0.0;
  double diode_resistance_ohm = 0.0;
  double dead_time_s = 0.0;
  bool dead_time_at_commutation = false;
  // Switching energies from an IGBT's sheet, at a voltage and a current; or a MOSFET's charges with a gate
  // current.
  double turn_on_J = 0.0, turn_off_J = 0.0, recovery_J = 0.0, energies_at_V = 0.0, energies_at_A = 0.0;
  double gate_current_A = 0.0, gate_source_charge_C = 0.0, gate_drain_charge_C = 0.0, recovery_charge_C = 0.0;
  double sink_degC = 25.0, junction_K_W = 0.0;  // junction_K_W: of each switch, from junction to heat sink
  double on_resistance_percent_K = 0.0;         // change of on_resistance_ohm, which applies at 25 degC
};

/// The simulated temperatures and their start values.
struct Heat {
  bool motor = false, devices = false;
  double ambient_degC = 25.0;
  std::optional<double> winding_degC, housing_degC;  // default: ambient_degC
  double step_s = 1e-3;
};

enum class Alignment : std::uint8_t { edge, centre };
enum class CommutationAt : std::uint8_t { hall_edge, sample };
enum class SampleAt : std::uint8_t { start, middle };

struct Pwm {
  double period_s = 30e-6;
  Alignment alignment = Alignment::edge;
  control::Chopping chopping = control::Chopping::soft;
  control::PwmPattern pattern = control::PwmPattern::upper;
  CommutationAt commutation = CommutationAt::hall_edge;
  SampleAt sample = SampleAt::start;
  int delay_periods = 0;
  double timer_Hz = 0.0;         // 0: edges are not quantised
  double minimum_pulse_s = 0.0;  // shorter pulses are omitted, and shorter off-times become on-time
};

struct Initial {
  double speed_rad_s = 0.0;
  double angle_rad = 0.0;       // mechanical angle
  std::optional<double> bus_V;  // default: supply.voltage_V
};

struct Record {
  std::optional<double> grid_s;  // default: pwm.period_s
  bool events = false;
  std::vector<std::string> columns;  // empty: all
};

struct Requirement {
  Measure measure;
  std::optional<double> min, max;
};

struct Comparison {
  Measure measure;
  double value = 0.0;
  std::string source;
  std::shared_ptr<Recording> recording = {};  // instead of value and source; only while a file is read
};

enum class Distribution : std::uint8_t { uniform, normal };

/// Variation of one number of motor, supply, bridge, load, start, beliefs, sensor places or Hall edges within a
/// series of drives.
struct Spread {
  std::string key;  // as written in the scenario: "motor_override.resistance_ohm", "supply.voltage_V"
  Distribution distribution = Distribution::uniform;
  std::optional<double>
      relative;  // half width (uniform) or standard deviation (normal), relative to the value
  std::optional<double> absolute;  // the same in the key's unit, instead of relative
  double cut_sigma = 3.0;          // normal: largest deviation of a drive, in standard deviations
  std::string source;
};

/// The values for which a controller is designed.
struct Nominal {
  design::Sheet sheet;
  Supply supply;
  Load load;
};

struct Scenario {
  std::string title;
  std::vector<std::string> extends;  // base files as written; their keys are merged (filled by text)
  std::string motor;                 // name or path as written
  double duration_s = 0.0;
  std::string notes;                         // shown in the report
  std::string not_usable;                    // reason why the scenario's design is not usable; empty if it is
  design::Sheet sheet;                       // the motor's sheet with overrides applied (filled by text)
  std::optional<design::Sheet> motor_sheet;  // without overrides (filled by text); not given: there is none
  Believed believed;                         // what the drive believes instead of sheet and sensors
  Supply supply;
  Bridge bridge;
  Heat heat;
  Pwm pwm;
  Control control;
  Sensors sensors;
  Protection protection;
  Reference reference;
  Load load;
  std::vector<At> at;
  Initial initial;
  Record record;
  std::vector<Requirement> require;
  std::vector<Comparison> compare;
  std::shared_ptr<const std::vector<LaidOver>> laid_over;  // comparisons with a file (moved by text)
  std::vector<Spread> spread;  // applies to a series of runs; a single run uses the values as
                               // written
  std::span<const LaidOver> recordings() const {
    return laid_over ? std::span<const LaidOver>(*laid_over) : std::span<const LaidOver>();
  }
  std::optional<Nominal> designed_for;  // design basis, set by study::varied; not given: sheet, supply and
                                        // load of this scenario
};

}  // namespace sixstep::study
