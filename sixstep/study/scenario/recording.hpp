// SPDX-License-Identifier: Apache-2.0
// A recording of a real drive that is laid over a signal of the run: the keys of a [[compare]] with a file.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/study/scenario/measure.hpp"

namespace sixstep::study {

/// Fewest rows of a comparison.
inline constexpr std::size_t fewest_rows = 16;

/// Rows of a recorded column, evenly spaced.
struct RecordedRows {
  double interval_s = 0.0;
  double step = 0.0;  ///< least difference of two values: the converter's step, in the column's unit
  std::vector<double> values;
};

struct Recording {
  std::string file, column;  // as written
  std::vector<std::string> figures;
  std::vector<std::string> free;  // fitted properties of the probe: "scale", "offset", "shift"
  double scale = 1.0;             // signal = scale * recorded + offset
  double offset = 0.0;            // in the signal's unit
  double shift_s = 0.0;           // time of the first row after the window's start
  double mean_s = 0.0;            // moving mean of both
  double shortest_s = 0.0;        // pulses that count
  std::optional<double> longest_s;
  double conditions_percent = 0.0;
  std::optional<double> tolerance_percent;
  std::shared_ptr<const RecordedRows> rows;  // filled by text

  /// The figures, by default the distance.
  std::vector<std::string> asked() const;
  bool is_free(std::string_view property) const;
  /// Whether values are numbers of a probe, in another unit than the signal's.
  bool has_probe() const { return scale != 1.0 || is_free("scale"); }
};

/// A signal of the run with the recording that is laid over it. Of the measure it uses signal, window, level,
/// frequency_Hz and label.
struct LaidOver {
  Measure measure;
  Recording recording;
  std::size_t place = 0;  // number of its [[compare]]
};

enum class RecordedFigure : std::uint8_t {
  difference,
  mean,
  rms,
  minimum,
  maximum,
  peak_to_peak,
  harmonic,
  high,
  low,
  period
};

/// One row per figure; `phrase` precedes the signal's phrase. An empty unit is the signal's.
struct RecordedFigureFact {
  RecordedFigure figure;
  std::string_view word, phrase, unit;
};
inline constexpr RecordedFigureFact recorded_figures[] = {
    {RecordedFigure::difference, "difference_rms", "rms distance of", ""},
    {RecordedFigure::mean, "mean", "mean", ""},
    {RecordedFigure::rms, "rms", "rms", ""},
    {RecordedFigure::minimum, "min", "minimum of", ""},
    {RecordedFigure::maximum, "max", "maximum of", ""},
    {RecordedFigure::peak_to_peak, "peak_to_peak", "peak-to-peak", ""},
    {RecordedFigure::harmonic, "harmonic_", "harmonic", ""},
    {RecordedFigure::high, "high_s", "time above the level,", "s"},
    {RecordedFigure::low, "low_s", "time below the level,", "s"},
    {RecordedFigure::period, "period_s", "period of the pulses,", "s"},
};
constexpr bool is_of_pulses(RecordedFigure f) { return f >= RecordedFigure::high; }

/// A figure as a file names it: "rms", "harmonic_5". Empty: no such figure.
struct NamedFigure {
  const RecordedFigureFact* fact = nullptr;
  int order = 0;

  std::string name(const Measure& measure) const;
  std::string_view unit(const Measure& measure) const;
};
std::optional<NamedFigure> recorded_figure(std::string_view word);

}  // namespace sixstep::study
