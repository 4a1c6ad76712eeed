// SPDX-License-Identifier: Apache-2.0
// What a page takes from a plan's rows: columns of numbers to draw from, how each figure is distributed, the runs to look at first.
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

/// How a run ended, as its colour tells it.
enum class RunState : std::uint8_t { holds, misses, fault, refused };

RunState state_of(const sixstep::analysis::RunRecord& record);

struct PlanColumn {
  enum class Kind : std::uint8_t { key, strayed, figure } kind = Kind::key;
  std::string name, unit;
  bool logarithmic = false;
  bool required = false;  ///< of a figure, between these
  std::optional<double> min{}, max{};
  std::vector<std::string> words{};  ///< of a key that is not a number; its values count through them
  std::vector<float> values{};       ///< a row each; NaN where there is none
};

struct PlanRows {
  std::size_t every = 1;  ///< each so manieth run is kept
  std::vector<double> numbers;
  std::vector<std::uint8_t> states;  ///< a RunState each
  std::vector<PlanColumn> columns;   ///< keys, strayed values, figures
};

/// At most `most` rows, evenly chosen.
PlanRows plan_rows(const text::PlanStory& story, std::size_t most);

/// What finite values a figure has, from least to greatest; low > high where there is none.
struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  bool empty() const { return !(low <= high); }
  void include(double x);
  void include(const Span& other);
};

/// Of all runs, a figure each.
std::vector<Span> figure_spans(const text::PlanStory& story);

inline constexpr std::size_t histogram_bins = 32;

/// Runs by the value of a figure, between the ends of a span; beside them those that never came to one, and those without.
struct Histogram {
  std::vector<std::size_t> counts = std::vector<std::size_t>(histogram_bins);
  std::size_t never = 0, missing = 0;
};
std::vector<Histogram> histograms(const text::PlanStory& story, const std::vector<Span>& spans);

}  // namespace report
