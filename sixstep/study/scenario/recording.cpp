// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/scenario/recording.hpp"

#include <algorithm>

#include "sixstep/study/scenario/measure_choices.hpp"

namespace sixstep::study {

std::vector<std::string> Recording::asked() const {
  return figures.empty() ? std::vector<std::string>{"difference_rms"} : figures;
}

bool Recording::is_free(std::string_view property) const {
  return std::find(free.begin(), free.end(), property) != free.end();
}

std::optional<NamedFigure> recorded_figure(std::string_view word) {
  for (const RecordedFigureFact& fact : recorded_figures) {
    if (fact.figure != RecordedFigure::harmonic) {
      if (fact.word == word) return NamedFigure{&fact, 0};
      continue;
    }
    if (!word.starts_with(fact.word)) continue;
    const std::string_view digits = word.substr(fact.word.size());
    int order = 0;
    for (const char c : digits) order = c >= '0' && c <= '9' && order < 100 ? 10 * order + (c - '0') : 1000;
    if (order >= 1 && order < 100) return NamedFigure{&fact, order};
  }
  return {};
}

std::string NamedFigure::name(const Measure& measure) const {
  std::string out(order == 1 ? "fundamental" : fact->phrase);
  if (order > 1) out.append(1, ' ').append(std::to_string(order));
  if (order > 0) out.append(" of");
  return out.append(1, ' ').append(measure.label.empty() ? fact_of(measure.signal).phrase : measure.label);
}

std::string_view NamedFigure::unit(const Measure& measure) const {
  return order > 1 ? "1" : fact->unit.empty() ? unit_of(measure.signal) : fact->unit;
}

}  // namespace sixstep::study
