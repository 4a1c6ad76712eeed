// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/recordings.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/written.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/scenario/signal_choices.hpp"

namespace sixstep::study {

namespace {

/// Most samples that a run keeps of one signal.
constexpr double most_samples = 4e6;

struct AskedRecording {
  const LaidOver& laid;
  const std::string& where;
  const Scenario& s;
  base::Problems& out;
  void refuse(const char* key, std::string value, std::string limit, std::string cure) const {
    out.push_back({where + "." + key, std::move(value), std::move(limit), std::move(cure)});
  }
};

void check_words(const AskedRecording& a) {
  const Recording& c = a.laid.recording;
  bool pulses = false;
  for (const std::string& word : c.asked()) {
    const std::optional<NamedFigure> figure = recorded_figure(word);
    if (!figure)
      a.refuse("figures", word, "is no figure of a recording",
               "write difference_rms, mean, rms, min, max, peak_to_peak, harmonic_1 to harmonic_99, high_s, "
               "low_s or period_s");
    else
      pulses |= is_of_pulses(figure->fact->figure);
  }
  for (const std::string& word : c.free)
    if (word != "scale" && word != "offset" && word != "shift")
      a.refuse("free", word, "is no property of a probe", "write scale, offset or shift");
  if (pulses && !a.laid.measure.level)
    a.refuse("level", "", "is missing: it separates the pulses", "give it in the signal's unit");
  const Recording usual;
  const bool sized = c.shortest_s != usual.shortest_s || c.longest_s;
  if (!pulses && (a.laid.measure.level || sized))
    a.refuse(sized ? "shortest_s" : "level", "", "has no effect without high_s, low_s or period_s",
             "remove it");
}

void check_rows(const AskedRecording& a) {
  const Recording& c = a.laid.recording;
  const Measure& m = a.laid.measure;
  const double length_s = m.to_s.value_or(a.s.duration_s) - m.from_s.value_or(0.0),
               interval_s = c.rows->interval_s,
               recorded_s = interval_s * static_cast<double>(c.rows->values.size());
  if (a.s.duration_s / interval_s > most_samples)
    return a.refuse("file", c.file,
                    "has a row each " + base::six_digits(interval_s) + " s, too many for a run of " +
                        base::six_digits(a.s.duration_s) + " s",
                    "keep each tenth row, or shorten duration_s");
  const double common_s = std::min(length_s, c.shift_s + recorded_s) - std::max(0.0, c.shift_s);
  if (common_s < interval_s * static_cast<double>(fewest_rows))
    a.refuse("file", c.file,
             "has fewer than " + std::to_string(fewest_rows) + " rows in the window of " +
                 base::six_digits(length_s) + " s: it covers " + base::six_digits(recorded_s) + " s from " +
                 base::six_digits(c.shift_s) + " s on",
             "change from_s, to_s or shift_s");
  if (c.mean_s > 0.5 * std::min(recorded_s, length_s))
    a.refuse("mean_s", base::written(c.mean_s), "is longer than half of the recording or the window",
             "shorten it");
}

}  // namespace

void check_recording(const LaidOver& laid, const std::string& where, const Scenario& s, base::Problems& out) {
  const AskedRecording a{laid, where, s, out};
  const Signal signal = laid.measure.signal;
  const std::optional<std::size_t> column = column_of(signal);
  if (!column || !applies(static_cast<ColumnId>(*column), s))
    a.refuse("signal", std::string(fact_of(signal).word), "is not a column of this run's trace",
             "name a column of the trace: i_a, u_a_V, u_ab_V, e_a_V, speed");
  if (laid.recording.scale == 0.0)
    a.refuse("scale", "0", "must not be 0", "give the signal's unit per recorded unit");
  check_words(a);
  if (laid.recording.rows) check_rows(a);
}

}  // namespace sixstep::study
