// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/reference.hpp"

#include <cmath>
#include <string_view>

#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/check/reference_cures.hpp"
#include "sixstep/study/check/reference_keys.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"

namespace sixstep::study {

namespace {

using base::written;

/// Largest number of half periods of a square wave in a run. A run with this number of levels needs 144 MB of
/// memory.
constexpr double most_half_periods = 2e6;

/// One reference, its place in the file, and how long it applies.
struct Place {
  const Reference& r;
  std::string table;  ///< "reference", "at[0].reference"
  double left_s;
  control::Mode mode;
  const Scenario& s;
  base::Problems& out;

  void say(const char* key, std::string value, std::string limit, std::string cure) const {
    out.push_back({table + "." + key, std::move(value), std::move(limit), std::move(cure)});
  }
  std::string shape() const { return "shape = \"" + std::string(base::word(shape_choices, r.shape)) + "\""; }
  void missing(const char* key, const char* cure) const { say(key, "", "is missing for " + shape(), cure); }
};

void check_unit(const Place& p) {
  const control::Mode mode = p.mode;
  const base::Motion motion = design::motion_of(p.s.sheet);
  const std::string_view unit = motion.unit(reference_unit(mode)).linear;
  if (p.r.unit && mode != control::Mode::off && *p.r.unit != unit)
    p.say("unit", "\"" + *p.r.unit + "\"",
          "is not the unit of mode \"" + std::string(base::word(mode_choices, mode)) + "\"",
          cure_of_unit(*p.r.unit, mode, motion));
}

void check_strays(const Place& p) {
  for (const ShapeKey& key : shape_keys)
    if (key.given(p.r) && !reads(p.r.shape, key))
      p.say(
          key.key, "", "has no effect with " + p.shape(),
          "set shape = " + readers_of(key) +
              ", or remove this key; if an extended file has this key, reference = { .. } replaces all keys of the extended file's reference");
  if (p.r.shape == Shape::csv && p.r.column && p.r.file.empty() && !p.r.times_s.empty())
    p.say("column", "\"" + *p.r.column + "\"",
          "applies to a file only, and times_s and values are given here",
          "give file = \"NAME.csv\" instead of times_s and values, or remove this key");
}

void check_ramp(const Place& p) {
  const Reference& r = p.r;
  if (!r.end_s && !r.slope)
    p.missing("end_s", "give reference.end_s, the time of the final value, or reference.slope, the rate");
  if (r.end_s && r.slope)
    p.say("slope", written(*r.slope), "contradicts end_s: both keys determine the rate",
          "remove reference.slope or reference.end_s");
  if (r.end_s && !(*r.end_s > r.begin_s))
    p.say("end_s", written(*r.end_s), "must be after begin_s = " + written(r.begin_s),
          "set reference.end_s after begin_s, or set shape = \"steps\" for a jump");
}

/// A sine with fewer than two samples per period looks like another sine.
void check_sine(const Place& p) {
  const double most_Hz = 0.5 / p.s.pwm.period_s;
  if (!(p.r.frequency_Hz > 0))
    p.missing("frequency_Hz", "give the frequency of the sine in Hz");
  else if (!(p.r.frequency_Hz < most_Hz))
    p.say("frequency_Hz", written(p.r.frequency_Hz),
          "must be below half the controller's sampling rate, " + written(most_Hz) + " Hz",
          "lower this value, or shorten pwm.period_s");
}

void check_trapezoid(const Place& p) {
  if (!p.r.slope) p.missing("slope", "give the largest rate, in the unit of control.mode per s");
  if (!p.r.acceleration)
    p.missing("acceleration", "give the largest change of the rate, in the unit of control.mode per s2");
}

void check_square(const Place& p) {
  if (p.left_s / (p.r.period_s / 2) > most_half_periods)
    p.say("period_s", written(p.r.period_s), "is too short: the run would have more than a million periods",
          "lengthen this value, or shorten duration_s");
}

void check_rows(const Place& p) {
  const Reference& r = p.r;
  if (r.times_s.empty() && r.values.empty())
    return p.missing("file", "give file = \"NAME.csv\", or times_s and values");
  // Rows after the end of the run are allowed, because a measurement may be longer than the run.
  const double endless = std::numeric_limits<double>::infinity();
  check_steps(r.times_s, r.values, p.table, "values", endless, p.out);
}

void check_steps_of(const Place& p) {
  check_steps(p.r.times_s, p.r.values, p.table, "values", p.left_s, p.out);
  if (p.r.times_s.empty()) p.missing("times_s", "give times_s and values");
}

void check_shape(const Place& p) {
  switch (p.r.shape) {
    case Shape::constant:
      return;
    case Shape::steps:
      return check_steps_of(p);
    case Shape::square:
      return check_square(p);
    case Shape::ramp:
      return check_ramp(p);
    case Shape::sine:
      return check_sine(p);
    case Shape::trapezoid:
      return check_trapezoid(p);
    case Shape::csv:
      return check_rows(p);
  }
}

/// The key that sets the reference's largest value; a problem names this key.
const char* value_key(const Reference& r) {
  switch (r.shape) {
    case Shape::constant:
      return "value";
    case Shape::steps:
      return "values";
    case Shape::square:
      return "high";
    case Shape::ramp:
    case Shape::trapezoid:
      return r.start && std::fabs(*r.start) > std::fabs(r.end) ? "start" : "end";
    case Shape::sine:
      return "amplitude";
    case Shape::csv:
      return r.file.empty() ? "values" : "file";
  }
  return "value";
}

/// Checks each reference separately, so that the message names the reference with the wrong duty.
void check_duty(const Place& p) {
  if (p.mode != control::Mode::duty) return;
  Scenario alone;
  alone.duration_s = p.left_s;
  alone.reference = p.r;
  if (const double largest = largest_reference(alone); largest > 1.0)
    p.say(value_key(p.r), written(largest), "must lie from -1 to 1 in duty mode", cure_of_duty(largest));
}

void check_one(const Place& p) {
  const std::size_t before = p.out.size();
  check_unit(p);
  check_strays(p);
  check_shape(p);
  if (p.out.size() == before) check_duty(p);
}

}  // namespace

void check_steps(const std::vector<double>& times, const std::vector<double>& values,
                 const std::string& table, const char* value_key, double duration_s, base::Problems& out,
                 const char* times_key) {
  if (times.size() != values.size())
    out.push_back(
        {table + "." + value_key, std::to_string(values.size()) + " entries",
         std::string("must be as many as ") + times_key + ", which has " + std::to_string(times.size()),
         "give one value for each time in times_s"});
  constexpr std::size_t most_told = 5;  // limits the messages: a list in falling order would cause one
                                        // message per entry
  for (std::size_t n = 0, before = out.size(); n < times.size() && out.size() < before + most_told; ++n) {
    if (times[n] < 0 || (n > 0 && !(times[n] > times[n - 1])))
      out.push_back({table + "." + times_key, written(times[n]),
                     "must be at least 0 and above the entry before", "sort the times"});
    else if (!(times[n] < duration_s))
      out.push_back({table + "." + times_key, written(times[n]),
                     "is not before the end of the run (duration_s = " + written(duration_s) + ")",
                     "lengthen duration_s, or remove the entry"});
  }
}

void check_references(const Scenario& s, base::Problems& out) {
  check_one({s.reference, "reference", s.duration_s, s.control.mode, s, out});
  const std::vector<control::Mode> modes = modes_from(s);
  for (std::size_t n = 0; n < s.at.size(); ++n)
    if (s.at[n].reference)
      check_one({*s.at[n].reference, "at[" + std::to_string(n) + "].reference", s.duration_s - s.at[n].time_s,
                 modes[n], s, out});
}

}  // namespace sixstep::study
