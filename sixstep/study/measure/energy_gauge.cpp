// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/energy_gauge.hpp"

#include "sixstep/plant/view.hpp"

namespace sixstep::study {

void EnergyGauge::segment(const SegmentView& g, double s) {
  if (switches_) begin_segment(losses_, g, window_);
  const Clip seen = clipped(window_, g.t_s, g.plant.expansion().h, s);
  if (seen.empty()) return;
  seen_ = true;
  add_up_to(g, seen.to, 1.0);
  if (seen.from > 0.0) add_up_to(g, seen.from, -1.0);
}

/// Adds the segment's energies from its beginning to its fraction s, multiplied by `sign`.
void EnergyGauge::add_up_to(const SegmentView& g, double s, double sign) {
  const plant::SegmentEnergy<double> e = g.plant.energy(s);
  const plant::Motion motion = g.plant.motion();
  const double B = g.plant.lean ? g.plant.lean->constants().B : g.plant.general->constants().B;
  sum_.supplied.add(sign * e.supplied);
  sum_.copper.add(sign * e.copper);
  sum_.devices.add(sign * e.devices);
  sum_.air_gap.add(sign * e.air_gap);
  sum_.friction.add(sign * (e.viscous + e.dry));
  sum_.load.add(sign * e.load);
  const double squares = B > 0 && g.plant.lean ? e.viscous / B : 0.0;  // integral of w^2 over time
  sum_.load_friction.add(sign * (e.load_viscous + load_.viscous_Nm_s * squares +
                                 load_.coulomb_Nm * plant::against(motion, e.travel)));
}

namespace {

/// Maps each power to its energy.
struct EnergyOf {
  Signal power;
  double (*taken)(const Energies&);
};
constexpr EnergyOf energy_figures[] = {
    {Signal::supply_power, [](const Energies& e) { return e.supplied.value; }},
    {Signal::motor_power, [](const Energies& e) { return e.supplied.value - e.devices.value; }},
    {Signal::mechanical_power, [](const Energies& e) { return e.air_gap.value; }},
    {Signal::load_power, [](const Energies& e) { return e.load.value; }},
    {Signal::copper_loss, [](const Energies& e) { return e.copper.value; }},
    {Signal::device_loss, [](const Energies& e) { return e.devices.value; }},
    {Signal::friction_loss, [](const Energies& e) { return e.friction.value; }},
};
static_assert([] {
  for (const SignalFact& fact : signal_facts) {
    bool has = false;
    for (const EnergyOf& e : energy_figures) has = has || e.power == fact.signal;
    if (has != is_power(fact.signal)) return false;
  }
  return true;
}());

}  // namespace

std::optional<double> EnergyGauge::energy(Signal signal) const {
  if (!seen_) return std::nullopt;
  for (const EnergyOf& e : energy_figures)
    if (e.power == signal) return e.taken(sum_);
  return std::nullopt;
}

std::optional<double> EnergyGauge::efficiency() const {
  if (!seen_) return std::nullopt;
  const double electrical = sum_.supplied.value + losses_.switching();
  const double mechanical = sum_.air_gap.value - (sum_.friction.value - sum_.load_friction.value);
  if (electrical > 0.0) return mechanical > 0.0 ? mechanical / electrical : 0.0;
  if (mechanical < 0.0) return electrical < 0.0 ? electrical / mechanical : 0.0;
  return std::nullopt;
}

}  // namespace sixstep::study
