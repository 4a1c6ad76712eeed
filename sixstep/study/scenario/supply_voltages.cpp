// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/scenario/supply_voltages.hpp"

#include <algorithm>
#include <cmath>

namespace sixstep::study {

double open_circuit_V(const Supply& s, double charge) {
  const std::vector<double>&q = s.battery_charges, &V = s.battery_voltages_V;
  if (q.size() < 2 || V.size() != q.size()) return V.empty() ? s.voltage_V : V.front();
  std::size_t n = 0;
  while (n + 2 < q.size() && charge > q[n + 1]) ++n;
  return V[n] + (V[n + 1] - V[n]) / (q[n + 1] - q[n]) * (charge - q[n]);
}

double highest_open_V(const Supply& s) {
  if (s.source == SourceKind::steady) return s.voltage_V;
  if (s.source != SourceKind::battery) return std::sqrt(2.0) * s.mains_rms_V - 2 * s.rectifier_drop_V;
  return s.battery_voltages_V.empty()
             ? 0.0
             : *std::max_element(s.battery_voltages_V.begin(), s.battery_voltages_V.end());
}

double highest_open_V(const Scenario& s) {
  double highest = s.supply.source == SourceKind::battery ? open_circuit_V(s.supply, s.supply.battery_charge)
                                                          : highest_open_V(s.supply);
  for (const At& at : s.at) highest = std::max(highest, at.supply.voltage_V.value_or(0.0));
  return std::max(highest, s.initial.bus_V.value_or(0.0));
}

}  // namespace sixstep::study
