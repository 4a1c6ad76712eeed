// SPDX-License-Identifier: Apache-2.0
// A scenario as typed data: everything one run needs, files already resolved to numbers. What each key means,
// its unit, range and default stands in scenario_description.hpp and nowhere else.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/control/bridge_command.hpp"
#include "sixstep/design/sheet/sheet.hpp"
#include "sixstep/study/scenario/at.hpp"
#include "sixstep/study/scenario/control.hpp"
#include "sixstep/study/scenario/measure.hpp"
#include "sixstep/study/scenario/protection.hpp"
#include "sixstep/study/scenario/sensors.hpp"

namespace sixstep::study {

struct Supply {
  double voltage_V = 24.0;
  double resistance_ohm = 0.0;  // with capacitance_F > 0: source behind R feeding C; else a stiff bus
  double capacitance_F = 0.0;
  bool sinks = true;
  double inductance_H = 0.0;          // in series with resistance_ohm
  double brake_resistance_ohm = 0.0;  // across the bus from brake_on_V until brake_off_V; 0: no chopper
  double brake_on_V = 0.0, brake_off_V = 0.0;
};

enum class Device : std::uint8_t { mosfet, igbt };

struct Bridge {
  Device device = Device::mosfet;
  double on_resistance_ohm = 0.0;
  double saturation_V = 0.0;  // igbt
  double diode_drop_V = 0.0;
  double diode_resistance_ohm = 0.0;
  double dead_time_s = 0.0;
  bool dead_time_at_commutation = false;
};

enum class Alignment : std::uint8_t { edge, centre };
enum class CommutationAt : std::uint8_t { hall_edge, sample };
enum class SampleAt : std::uint8_t { start, middle };

struct Pwm {
  double period_s = 30e-6;
  Alignment alignment = Alignment::edge;
  control::Chopping chopping = control::Chopping::soft;
  CommutationAt commutation = CommutationAt::hall_edge;
  SampleAt sample = SampleAt::start;
  int delay_periods = 0;
  double timer_Hz = 0.0;         // 0: edges are not quantised
  double minimum_pulse_s = 0.0;  // a shorter pulse does not come, a shorter gap closes
};

struct Load {
  double torque_Nm = 0.0;
  std::vector<double> times_s;  // steps: torques_Nm[n] holds from times_s[n] on
  std::vector<double> torques_Nm;
  double viscous_Nm_s = 0.0;  // added to the motor's own friction
  double coulomb_Nm = 0.0;
  double static_Nm = 0.0;  // breakaway torque where larger than coulomb
  double inertia_kg_m2 = 0.0;
  double gear = 1.0;              // motor turns per load turn; what the load is given in is at its own side
  double stiffness_Nm_rad = 0.0;  // of the shaft to the load; 0: rigid
  double damping_Nm_s_rad = 0.0;
  double fan_Nm_s2 = 0.0;  // torque per square of the load's speed
  double gravity_Nm = 0.0;
  double gravity_angle_deg = 0.0;
  bool locked = false;
};

struct Initial {
  double speed_rad_s = 0.0;
  double angle_rad = 0.0;       // mechanical
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
};

enum class Distribution : std::uint8_t { uniform, normal };

/// How one number of motor, supply, bridge, load or start strays from one drive of a series to the next.
struct Spread {
  std::string key;  // as written in the scenario: "motor_override.resistance_ohm", "supply.voltage_V"
  Distribution distribution = Distribution::uniform;
  std::optional<double>
      relative;  // half width (uniform) or standard deviation (normal), as part of the value
  std::optional<double> absolute;  // the same in the key's unit, instead of relative
  double cut_sigma = 3.0;          // normal: standard deviations beyond which no drive lies
  std::string source;
};

/// What the designer of a controller goes by.
struct Nominal {
  design::Sheet sheet;
  Supply supply;
  Load load;
};

struct Scenario {
  std::string title;
  std::vector<std::string>
      extends;        // files it is laid over, as written; their keys are in it (filled by text)
  std::string motor;  // name or path as written
  double duration_s = 0.0;
  std::string notes;    // what the run teaches, shown in the report
  design::Sheet sheet;  // the motor's sheet with overrides applied (filled by text)
  Supply supply;
  Bridge bridge;
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
  std::vector<Spread> spread;           // over a batch of runs; a single run is the nominal one
  std::optional<Nominal> designed_for;  // else for the motor, supply and load at hand (set by study::varied)
};

}  // namespace sixstep::study
