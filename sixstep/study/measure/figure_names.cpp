// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/figures.hpp"

namespace sixstep::study {

std::string figure_name(const Measure& m) {
  if (!m.label.empty()) return m.label;
  const MetricFact& fact = fact_of(m.metric);
  std::string words(fact.phrase);
  const std::string phrase(fact_of(m.signal).phrase);
  constexpr std::string_view power = "power ";  // "power from the bus" becomes "energy from the bus"
  switch (fact.of) {
    case TakenOf::energies:
    case TakenOf::transitions:
    case TakenOf::commutations:
      return words;
    case TakenOf::switching:
      return is_gate(m.signal) ? words + " of " + phrase : words;
    case TakenOf::power:
      if (phrase.starts_with(power)) return "energy " + phrase.substr(power.size());
      break;
    case TakenOf::signal:
    case TakenOf::fundamental:
    case TakenOf::band:
      break;
  }
  return words + " " + phrase;
}

std::string figure_name(const Scenario& scenario, const Measure& m) {
  const std::string name = figure_name(m);
  return scenario.sheet.kind == design::MotorKind::linear && m.label.empty() ? base::linear_words(name)
                                                                             : name;
}

}  // namespace sixstep::study
