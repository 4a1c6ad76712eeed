// SPDX-License-Identifier: Apache-2.0
// Reads a plan's rows for a page: columns of numbers for the drawings, and the distribution of each figure.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/plan/plan_table.hpp"
#include "text/results/plan_text.hpp"

namespace report {

/// How a run ended, which determines the colour of its drawing.
enum class RunState : std::uint8_t { holds, misses, fault, refused };

RunState state_of(const sixstep::analysis::RunRecord& record);

struct PlanColumn {
  enum class Kind : std::uint8_t { key, strayed, figure } kind = Kind::key;
  std::string name, unit;
  bool logarithmic = false;
  bool required = false;  ///< true: the figure has a requirement with these limits
  std::optional<double> min{}, max{};
  std::vector<std::string> words{};  ///< words of a key without numbers; `values` are then indices into
                                     ///< `words`
  std::vector<float> values{};       ///< one value per row; NaN: none
};

struct PlanRows {
  std::size_t every = 1;  ///< every n-th run is a row
  std::vector<double> numbers;
  std::vector<std::uint8_t> states;  ///< a RunState per row
  std::vector<PlanColumn> columns;   ///< keys, values of the spread, figures
};

/// Returns at most `most` rows, evenly chosen.
PlanRows plan_rows(const text::PlanStory& story, std::size_t most);

/// The range of a figure's finite values; low > high if there are none.
struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  bool empty() const { return !(low <= high); }
  void include(double x);
  void include(const Span& other);
};

/// Spans over all runs, one per figure.
std::vector<Span> figure_spans(const text::PlanStory& story);

inline constexpr std::size_t histogram_bins = 32;

/// The number of runs per interval of a figure's value. Runs whose event never occurred, and runs without a
/// value, are counted separately.
struct Histogram {
  std::vector<std::size_t> counts = std::vector<std::size_t>(histogram_bins);
  std::size_t never = 0, missing = 0;
};
std::vector<Histogram> histograms(const text::PlanStory& story, const std::vector<Span>& spans);

}  // namespace report
