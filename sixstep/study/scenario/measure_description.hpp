// SPDX-License-Identifier: Apache-2.0
// The keys of [[require]] and [[compare]]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/measure_choices.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

using base::above;
using base::between;
using base::from;

inline void describe(base::Visitor& v, Measure& s, bool needs_metric = true) {
  v.choice("metric", s.metric, metric_choices,
           {.meaning = "name of the figure that is computed from the signal", .required = needs_metric});
  v.choice("signal", s.signal, signal_choices, {.meaning = "signal from which the figure is computed"});
  v.value("from_s", s.from_s,
          {.meaning = "start of the window. Default: the start of the run", .unit = "s", .range = from(0)});
  v.value("to_s", s.to_s,
          {.meaning = "end of the window. Default: the end of the run", .unit = "s", .range = above(0)});
  v.value(
      "level", s.level,
      {.meaning = "value that the signal must reach, in the signal's unit", .unit_here = unit_of(s.signal)});
  v.value(
      "start", s.start,
      {.meaning =
           "initial value of the step, in the signal's unit. Default: the signal's value at from_s; "
           "for steps of the reference, the level before the step, and 0 before the first step (reach_time_s of a "
           "square: always 0)",
       .unit_here = unit_of(s.signal)});
  v.value("fraction", s.fraction,
          {.meaning = "reach_time_s: fraction of the step from start to level",
           .range = base::Range{0, 1, false, true}});
  v.value(
      "band", s.band,
      {.meaning = "settling_time_s: half width of the band, as a fraction of the step", .range = above(0)});
  v.value(
      "tail", s.tail,
      {.meaning =
           "steady_error, largest_error: last fraction of the duration of each reference level that is evaluated. Default: 0.1; the whole window if from_s is given",
       .range = base::Range{0, 1, false, true}});
  v.value("frequency_Hz", s.frequency_Hz,
          {.meaning =
               "thd: frequency of the fundamental. Default: the electrical frequency, from the rotor's angle",
           .unit = "Hz",
           .range = base::Range{0, 1e7, false, true}});
  v.value("sampled", s.sampled, {.meaning = "whether only the controller's samples are evaluated"});
  v.value("label", s.label, {.meaning = "name of the figure, instead of metric and signal"});
}

inline void describe(base::Visitor& v, Requirement& s) {
  describe(v, s.measure);
  const std::string_view unit = figure_unit(s.measure);
  v.value("min", s.min, {.meaning = "lower limit of the figure, in the figure's unit", .unit_here = unit});
  v.value("max", s.max, {.meaning = "upper limit of the figure, in the figure's unit", .unit_here = unit});
}

inline void describe(base::Visitor& v, Recording& s, Signal signal) {
  v.value(
      "column", s.column,
      {.meaning = "with file: heading of the recorded column; without it the column that the heading names "
                  "as a trace does"});
  v.value("figures", s.figures,
          {.meaning = "with file: figures of both, of difference_rms, mean, rms, min, max, peak_to_peak, "
                      "harmonic_N (N = 1: amplitude), high_s, low_s, period_s. Default: difference_rms"});
  v.value("free", s.free,
          {.meaning = "with file: properties of the probe that are fitted, of scale, offset and shift"});
  v.value(
      "scale", s.scale,
      {.meaning =
           "with file: the signal's unit per unit of the recorded column; where it is free, only its sign "
           "counts for the search of the shift"});
  v.value("offset", s.offset,
          {.meaning = "with file: added to the scaled recording", .unit_here = unit_of(signal)});
  v.value(
      "shift_s", s.shift_s,
      {.meaning = "with file: time of its first row after from_s; the fit begins here and covers a period",
       .unit = "s"});
  v.value("mean_s", s.mean_s,
          {.meaning = "with file: length of a moving mean that both get", .unit = "s", .range = from(0)});
  v.value("shortest_s", s.shortest_s,
          {.meaning = "high_s, low_s, period_s: shortest pulse that counts", .unit = "s", .range = from(0)});
  v.value("longest_s", s.longest_s,
          {.meaning = "high_s, low_s, period_s: longest pulse that counts", .unit = "s", .range = above(0)});
  v.value("conditions_percent", s.conditions_percent,
          {.meaning = "with file: 95 % uncertainty of the simulated figures, because speed, duty "
                      "or supply of the recorded drive are not known exactly",
           .unit = "percent",
           .range = from(0)});
  v.value(
      "tolerance_percent", s.tolerance_percent,
      {.meaning =
           "with file: a figure that differs by more than this part of the recorded figure, beyond the uncertainty, fails the run; difference_rms: this part of the simulated signal's peak-to-peak value. Without "
           "it no comparison does",
       .unit = "percent",
       .range = from(0)});
}

inline void describe(base::Visitor& v, Comparison& s) {
  if (!s.recording) s.recording = std::make_shared<Recording>();
  v.value(
      "file", s.recording->file,
      {.meaning = "recording of a real drive, laid over the signal: a CSV file beside this one, also packed "
                  "by gzip; instead of metric, value and source"});
  const bool by_value = s.recording->file.empty();
  describe(v, s.measure, by_value);
  v.value("value", s.value,
          {.meaning = "expected value, in the figure's unit",
           .required = by_value,
           .unit_here = figure_unit(s.measure)});
  v.value(
      "source", s.source,
      {.meaning = "where the value comes from, such as a data sheet or a publication", .required = by_value});
  describe(v, *s.recording, s.measure.signal);
}

}  // namespace sixstep::study
