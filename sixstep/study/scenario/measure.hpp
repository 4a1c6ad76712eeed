// SPDX-License-Identifier: Apache-2.0
// A figure of merit in a scenario: which metric, of which signal, over which window.
// docs/reference/figures.md defines each metric by its formula.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "sixstep/study/scenario/metrics.hpp"

namespace sixstep::study {

/// The signals of figures; signal_facts (signal_choices.hpp) has word, unit and meaning of each.
enum class Signal : std::uint8_t {
  current,
  phase_a,
  phase_b,
  phase_c,
  current_magnitude,
  speed,
  position,
  torque,
  bus_voltage,
  bus_current,
  pole_a,
  pole_b,
  pole_c,
  line_ab,
  line_bc,
  line_ca,
  emf_a,
  emf_b,
  emf_c,
  angle,
  duty,
  current_reference,
  speed_reference,
  position_reference,
  current_error,
  speed_error,
  position_error,
  load_torque,
  gate_T1,
  gate_T2,
  gate_T3,
  gate_T4,
  gate_T5,
  gate_T6,
  supply_power,
  motor_power,
  mechanical_power,
  load_power,
  copper_loss,
  device_loss,
  friction_loss,
  load_speed,
  load_angle,
  source_current,
  capacitor_current,
  battery_charge,
  battery_recovery,
  loop_current,
  winding_temperature,
  housing_temperature,
  junction_temperature,
  direct_current,  // this signal and the next ones: only with a field-oriented drive
  quadrature_current,
  direct_current_reference,
  quadrature_current_reference,
  direct_voltage,
  quadrature_voltage,
  angle_error
};

struct Measure {
  MetricKind metric = MetricKind::final_value;
  Signal signal = Signal::current;
  std::optional<double> from_s, to_s;  // window; default: whole run
  std::optional<double> level;         // metrics of a step: the value to reach
  std::optional<double> start;  // initial value of the step. Default, with `level`: the signal's first value
                                // in the window; else: the level before the step
  double fraction = 0.98;       // reach_time: fraction of the step from start to level
  double band = 0.02;           // settling_time: half width of the band, as a fraction of the step
  std::optional<double> tail;   // steady_error, largest_error: evaluated part at the end of each level, as a
                                // fraction of the level's duration
  std::optional<double> frequency_Hz;  // thd: frequency of the fundamental; default: the electrical frequency
  bool sampled = false;                // true: only the controller's samples are evaluated
  std::string label;                   // shown instead of metric and signal
};

/// Default tail: the last tenth of a level.
inline constexpr double default_tail = 0.1;

}  // namespace sixstep::study
