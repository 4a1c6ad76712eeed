// SPDX-License-Identifier: Apache-2.0
// Defines the keys of a plan file: names, units, ranges and meanings. The structs define the defaults.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/plan/plan.hpp"
#include "sixstep/base/visitor.hpp"

namespace sixstep::analysis {

/// An axis as in a file.
struct AxisEntry {
  std::string key;
  std::vector<std::string> values;
  std::optional<double> from, to;
  int points = 0;
  Spacing spacing = Spacing::linear;
  bool strays = false;
};

struct PlanEntry {
  std::string title, scenario, notes;
  Sampling sampling = Sampling::grid;
  int points = 0, drives = 0, seed = 1;
  bool sheet_tolerances = false;
  std::string minimise;
  int evaluations = 200;
  std::vector<AxisEntry> vary;
};

inline constexpr base::Choice<Sampling> sampling_choices[] = {
    {"grid", Sampling::grid, "every combination of the values of all keys"},
    {"latin-hypercube", Sampling::latin_hypercube,
     "Latin hypercube: each key's range is divided into as many parts as there are points, with one point in each part"},
    {"sobol", Sampling::sobol, "a sequence that fills the ranges evenly for any number of points"},
    {"monte-carlo", Sampling::monte_carlo, "at random"},
    {"saltelli", Sampling::saltelli,
     "for Sobol indices, which show the keys on which a figure depends: points times (keys + 2) runs"},
};

inline constexpr base::Choice<Spacing> spacing_choices[] = {
    {"linear", Spacing::linear, "equal steps"},
    {"log", Spacing::logarithmic, "equal factors"},
};

inline void describe(base::Visitor& v, AxisEntry& s) {
  v.value("key", s.key, {.meaning = "key of the scenario that is varied, as pwm.period_s", .required = true});
  v.value("values", s.values, {.meaning = "values of the key, as in a scenario"});
  v.value("from", s.from,
          {.meaning = "first end of a range, instead of values; a grid includes this end", .unit_of = s.key});
  v.value("to", s.to, {.meaning = "second end of the range", .unit_of = s.key});
  v.value("points", s.points,
          {.meaning = "number of values on a grid, both ends included", .range = base::between(0, 1e9)});
  v.choice("spacing", s.spacing, spacing_choices,
           {.meaning = "whether the values are spaced equally (linear) or by equal ratios (log)"});
  v.value(
      "strays", s.strays,
      {.meaning =
           "true: only the simulated drive has this value, and its controller is designed for the nominal value, as with [[spread]]; false: the controller is designed for each value"});
}

inline void describe(base::Visitor& v, PlanEntry& s) {
  v.value("title", s.title, {.meaning = "title of the plan, one line"});
  v.value("scenario", s.scenario,
          {.meaning = "scenario of all runs, as a path relative to this file", .required = true});
  v.value("notes", s.notes, {.meaning = "question that the plan answers, shown on its page"});
  v.choice("sampling", s.sampling, sampling_choices, {.meaning = "how the points are placed in the ranges"});
  v.value(
      "points", s.points,
      {.meaning = "number of points of all arrangements except grid; saltelli makes points x (keys + 2) runs",
       .range = base::between(0, 1e9)});
  v.value(
      "drives", s.drives,
      {.meaning = "number of drives of the series of [[spread]], at each point; 0: only the drive as written",
       .range = base::between(0, 1e9)});
  v.value("seed", s.seed,
          {.meaning = "seed of the random drives and points; another seed gives another series",
           .range = base::from(0)});
  v.value("sheet_tolerances", s.sheet_tolerances,
          {.meaning =
               "whether drives also vary by the usual tolerances of resistance, inductance, torque constant "
               "and Hall edge angles, for values that [[spread]] does not contain"});
  v.value(
      "minimise", s.minimise,
      {.meaning =
           "label of the figure that the optimisation minimises, while every drive meets every requirement"});
  v.value(
      "evaluations", s.evaluations,
      {.meaning = "largest number of points that the optimisation tries", .range = base::between(1, 1e6)});
  v.list("vary", s.vary, {.meaning = "keys that differ from point to point"});
}

}  // namespace sixstep::analysis
