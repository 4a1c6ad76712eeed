// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/heat.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/thermal.hpp"

namespace sixstep::study {

namespace {

void check_energies(const Bridge& b, base::Problems& out) {
  const bool energies = b.turn_on_J > 0 || b.turn_off_J > 0 || b.recovery_J > 0;
  const bool point = b.energies_at_V > 0 && b.energies_at_A > 0;
  if (energies != point)
    out.push_back(
        {energies ? "bridge.energies_at_V" : "bridge.turn_on_J", "",
         energies
             ? "and bridge.energies_at_A are missing: the switching energies belong to a voltage and a current"
             : "is missing: without turn_on_J, energies_at_V and energies_at_A have no effect",
         "give turn_on_J, turn_off_J, recovery_J, energies_at_V and energies_at_A"});
  if (energies && point && !(b.turn_on_J > 0 && b.turn_off_J > 0))
    out.push_back({b.turn_on_J > 0 ? "bridge.turn_off_J" : "bridge.turn_on_J", "",
                   "is missing: each pulse turns a switch on and off",
                   "give turn_on_J and turn_off_J, both above 0"});
  const std::array<std::pair<const char*, double>, 3> gate{
      {{"bridge.gate_current_A", b.gate_current_A},
       {"bridge.gate_source_charge_C", b.gate_source_charge_C},
       {"bridge.gate_drain_charge_C", b.gate_drain_charge_C}}};
  const auto given = std::count_if(gate.begin(), gate.end(), [](const auto& key) { return key.second > 0; });
  // When a switch turns on or off, voltage and current change one after the other, each with its gate charge.
  // Without one of the charges the computed loss would be too small.
  if (given == 1 || given == 2)
    for (const auto& [key, value] : gate)
      if (!(value > 0))
        out.push_back(
            {key, base::six_digits(value), "must be above 0 if one of the three gate values is given",
             "give all three keys gate_current_A, gate_source_charge_C and gate_drain_charge_C, or remove all three"});
  if (given == 3 && energies)
    out.push_back(
        {"bridge.gate_drain_charge_C", base::six_digits(b.gate_drain_charge_C),
         "repeats turn_on_J and turn_off_J",
         "remove the energies (turn_on_J, turn_off_J) or the gate values (gate_current_A and both charges)"});
}

}  // namespace

void check_heat(const Scenario& s, base::Problems& out) {
  check_energies(s.bridge, out);
  const Heat& h = s.heat;
  if (h.motor)
    if (const auto model = design::thermal_model(s.sheet); !model)
      for (const base::Problem& p : model.problems())
        out.push_back({"heat.motor", "true", "needs values that the motor's sheet does not have: " + p.where,
                       "add the sheet's thermal lines to the motor file, or give them in [motor_override]"});
  if (h.motor)
    if (auto lost = design::lost_magnets(h.housing_degC ? "heat.housing_degC" : "heat.ambient_degC", s.sheet,
                                         h.housing_degC.value_or(h.ambient_degC)))
      out.push_back(std::move(*lost));
  if (h.devices && !(s.bridge.junction_K_W > 0))
    out.push_back(
        {"heat.devices", "true", "needs bridge.junction_K_W",
         "give bridge.junction_K_W, the thermal resistance of a switch from junction to heat sink"});
  if (!h.devices && s.bridge.on_resistance_percent_K > 0)
    out.push_back({"bridge.on_resistance_percent_K", base::six_digits(s.bridge.on_resistance_percent_K),
                   "has no effect while heat.devices = false",
                   "set heat.devices = true, or remove this key"});
  const auto unused = [&](const char* key, const std::optional<double>& value) {
    if (value && !h.motor)
      out.push_back({key, base::six_digits(*value), "applies only with heat.motor = true",
                     "set heat.motor = true, or remove this key"});
  };
  unused("heat.winding_degC", h.winding_degC);
  unused("heat.housing_degC", h.housing_degC);
  if ((h.motor || h.devices) && h.step_s < s.pwm.period_s)
    out.push_back({"heat.step_s", base::six_digits(h.step_s), "must not be shorter than pwm.period_s",
                   "set heat.step_s to pwm.period_s or more"});
}

}  // namespace sixstep::study
