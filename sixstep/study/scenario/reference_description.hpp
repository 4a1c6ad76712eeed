// SPDX-License-Identifier: Apache-2.0
// The keys of a reference: their names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

/// Longest time, s: 104 days. A run counts time in picoseconds; their 63 bits are enough for 106 days.
inline constexpr double longest_s = 9e6;
inline constexpr double shortest_period_s = 1e-9;

inline void describe_moving(base::Visitor& v, Reference& s) {
  v.value("begin_s", s.begin_s,
          {.meaning = "ramp, trapezoid: time at which the change begins",
           .unit = "s",
           .range = base::between(0, longest_s)});
  v.value(
      "start", s.start,
      {.meaning =
           "ramp, trapezoid: initial value, in the unit of control.mode. Default: the reference's value before begin_s, 0 at the start of the run",
       .mode_unit = "*"});
  v.value("end", s.end,
          {.meaning = "ramp, trapezoid: final value, in the unit of control.mode", .mode_unit = "*"});
  v.value("end_s", s.end_s,
          {.meaning = "ramp: time at which the ramp reaches its final value",
           .unit = "s",
           .range = base::between(0, longest_s)});
  v.value(
      "slope", s.slope,
      {.meaning =
           "ramp, instead of end_s: rate of the ramp, in the unit of control.mode per s, without sign; trapezoid: largest rate",
       .range = base::above(0),
       .mode_unit = "*/s"});
  v.value(
      "acceleration", s.acceleration,
      {.meaning = "trapezoid: slope of the rate at both ends of the move, in the unit of control.mode per s2",
       .range = base::above(0),
       .mode_unit = "*/s2"});
  v.value("offset", s.offset,
          {.meaning = "sine: mean of the reference, in the unit of control.mode", .mode_unit = "*"});
  v.value("amplitude", s.amplitude,
          {.meaning = "sine: amplitude, in the unit of control.mode", .mode_unit = "*"});
  v.value("frequency_Hz", s.frequency_Hz,
          {.meaning = "sine: its frequency", .unit = "Hz", .range = base::from(0)});
  v.value(
      "phase_deg", s.phase_deg,
      {.meaning = "sine: phase at the start of the run; 0: the sine rises through its mean", .unit = "deg"});
}

inline void describe(base::Visitor& v, Reference& s) {
  v.choice("shape", s.shape, shape_choices, {.meaning = "course of the reference over time"});
  v.value("value", s.value,
          {.meaning = "constant: the reference, in the unit of control.mode", .mode_unit = "*"});
  v.value("times_s", s.times_s,
          {.meaning = "steps, csv: times at which the values begin, rising",
           .unit = "s",
           .range = base::from(0)});
  v.value("values", s.values,
          {.meaning = "steps, csv: the references, in the unit of control.mode", .mode_unit = "*"});
  v.value("high", s.high,
          {.meaning = "square: value in the first half of each period, in the unit of control.mode",
           .mode_unit = "*"});
  v.value("low", s.low,
          {.meaning = "square: value in the second half of each period, in the unit of control.mode",
           .mode_unit = "*"});
  v.value("period_s", s.period_s,
          {.meaning = "square: length of one period", .unit = "s", .range = base::from(shortest_period_s)});
  describe_moving(v, s);
  v.value(
      "file", s.file,
      {.meaning =
           "csv: path of a file, relative to this file, with the time in s first, then the reference; instead of times_s and values"});
  v.value("column", s.column,
          {.meaning =
               "csv: heading of the column with the reference; not needed if the file has only two columns"});
  v.choice("interpolation", s.interpolation, interpolation_choices,
           {.meaning = "csv: course of the reference between rows"});
  v.value(
      "unit", s.unit,
      {.meaning =
           "unit of the reference, which a run compares with the unit of control.mode: 1, A, rad/s or deg"});
}

}  // namespace sixstep::study
