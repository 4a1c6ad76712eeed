// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/supply.hpp"

#include <cmath>
#include <string>

#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/supply_voltages.hpp"

namespace sixstep::study {

namespace {

void check_brake(const Supply& s, bool has_capacitor, base::Problems& out) {
  const double R = s.brake_resistance_ohm;
  if (!(R > 0)) {
    if (s.brake_on_V > 0 || s.brake_off_V > 0)
      out.push_back({s.brake_on_V > 0 ? "supply.brake_on_V" : "supply.brake_off_V",
                     base::six_digits(s.brake_on_V > 0 ? s.brake_on_V : s.brake_off_V),
                     "has no effect without supply.brake_resistance_ohm",
                     "give supply.brake_resistance_ohm, or remove this key"});
    return;
  }
  if (!has_capacitor)
    out.push_back({"supply.brake_resistance_ohm", base::six_digits(R),
                   "needs a bus with a capacitor, whose voltage can rise",
                   "give supply.resistance_ohm and supply.capacitance_F"});
  if (!(s.brake_on_V > s.brake_off_V) || !(s.brake_off_V > 0))
    out.push_back(
        {"supply.brake_on_V", base::six_digits(s.brake_on_V),
         "must be above supply.brake_off_V = " + base::six_digits(s.brake_off_V) + ", which must be above 0",
         "give both keys, for example brake_on_V = 30 and brake_off_V = 28"});
  else if (const double open_V = highest_open_V(s); !(s.brake_off_V > open_V))
    out.push_back({"supply.brake_off_V", base::six_digits(s.brake_off_V),
                   (s.source == SourceKind::steady ? "must be above supply.voltage_V = "
                                                   : "must be above the source's open-circuit voltage, ") +
                       base::six_digits(open_V),
                   "raise this value: else the resistor would never turn off"});
  else if (const double falls = s.brake_on_V * s.capacitor_resistance_ohm / (s.capacitor_resistance_ohm + R);
           !(falls < s.brake_on_V - s.brake_off_V))
    out.push_back({"supply.brake_off_V", base::six_digits(s.brake_off_V),
                   "is reached as soon as the resistor turns on: the resistor draws " +
                       base::six_digits(falls) +
                       " V across supply.capacitor_resistance_ohm, and the bus falls below brake_off_V",
                   "lower brake_off_V or supply.capacitor_resistance_ohm"});
}

/// Controllers are designed for voltage_V. A value far from the source's voltage is probably the default,
/// which the user forgot to change.
void check_nominal(const Supply& s, base::Problems& out) {
  const double open_V = highest_open_V(s);
  if (!(open_V > 0) || (s.voltage_V > open_V / 2 && s.voltage_V < open_V * 2)) return;
  out.push_back(
      {"supply.voltage_V", base::six_digits(s.voltage_V),
       "is the voltage of the design, and differs too much from the source's open-circuit voltage, " +
           base::six_digits(open_V) + " V",
       "write voltage_V = " + base::rounded(open_V, 3)});
}

void check_battery(const Supply& s, base::Problems& out) {
  const bool given = !s.battery_charges.empty() || !s.battery_voltages_V.empty() ||
                     s.battery_capacity_Ah > 0 || s.battery_recovery_ohm > 0 || s.battery_recovery_F > 0;
  if (s.source != SourceKind::battery) {
    if (given)
      out.push_back({"supply.source", "", "must be \"battery\" for the given battery_* keys",
                     "set source = \"battery\", or remove the battery_* keys"});
    return;
  }
  if (s.battery_charges.size() != s.battery_voltages_V.size() || s.battery_charges.size() < 2 ||
      s.battery_charges.size() > 100)
    out.push_back({"supply.battery_voltages_V", std::to_string(s.battery_voltages_V.size()) + " values",
                   "need as many supply.battery_charges, 2 to 100 of them",
                   "write for example battery_charges = [0, 1] and battery_voltages_V = [20, 25.2]"});
  for (std::size_t n = 0; n + 1 < s.battery_charges.size(); ++n)
    if (!(s.battery_charges[n + 1] > s.battery_charges[n])) {
      out.push_back({"supply.battery_charges[" + std::to_string(n + 1) + "]",
                     base::six_digits(s.battery_charges[n + 1]), "must be above the previous charge",
                     "sort battery_charges and battery_voltages_V from empty to full"});
      break;
    }
  if (!(s.battery_capacity_Ah > 0))
    out.push_back({"supply.battery_capacity_Ah", "", "is missing",
                   "give supply.battery_capacity_Ah, the charge of the full battery"});
  if ((s.battery_recovery_ohm > 0) != (s.battery_recovery_F > 0))
    out.push_back({"supply.battery_recovery_ohm", base::six_digits(s.battery_recovery_ohm),
                   "and supply.battery_recovery_F belong together", "give both keys, or remove both"});
  if (out.empty()) check_nominal(s, out);
}

void check_mains(const Supply& s, base::Problems& out) {
  const bool mains = s.source == SourceKind::single_phase || s.source == SourceKind::three_phase;
  if (!mains) {
    if (s.mains_rms_V > 0)
      out.push_back({"supply.mains_rms_V", base::six_digits(s.mains_rms_V),
                     "applies to rectified mains only, and supply.source is another source",
                     "write source = \"single-phase\" or \"three-phase\""});
    if (s.rectifier_drop_V > 0)
      out.push_back({"supply.rectifier_drop_V", base::six_digits(s.rectifier_drop_V),
                     "applies to rectified mains only, and supply.source is another source",
                     "write source = \"single-phase\" or \"three-phase\", or remove this key"});
    return;
  }
  if (!(highest_open_V(s) > 0))
    out.push_back(
        {"supply.mains_rms_V", base::six_digits(s.mains_rms_V),
         "is below the forward drop of the rectifier's diodes",
         "give supply.mains_rms_V, the rms voltage of the mains: for example 230, or 400 between two lines of three phases"});
  else
    check_nominal(s, out);
}

}  // namespace

void check_supply(const Scenario& s, base::Problems& out) {
  const bool R = s.supply.resistance_ohm > 0, C = s.supply.capacitance_F > 0;
  if (R && !C)
    out.push_back({"supply.resistance_ohm", base::six_digits(s.supply.resistance_ohm),
                   "needs a bus capacitor", "add supply.capacitance_F, or remove both keys for a stiff bus"});
  if (C && !R)
    out.push_back({"supply.capacitance_F", base::six_digits(s.supply.capacitance_F),
                   "needs the source's resistance",
                   "add supply.resistance_ohm, or remove both keys for a stiff bus"});
  if (!s.supply.sinks && !(R && C))
    out.push_back({"supply.sinks", "false", "needs a bus with a capacitor, whose voltage can rise",
                   "give supply.resistance_ohm and supply.capacitance_F"});
  if (s.supply.inductance_H > 0 && !(R && C))
    out.push_back({"supply.inductance_H", base::six_digits(s.supply.inductance_H), "needs a bus capacitor",
                   "give supply.resistance_ohm and supply.capacitance_F"});
  if (s.supply.capacitor_resistance_ohm > 0 && !C)
    out.push_back({"supply.capacitor_resistance_ohm", base::six_digits(s.supply.capacitor_resistance_ohm),
                   "needs supply.capacitance_F, which is not given",
                   "give supply.resistance_ohm and supply.capacitance_F"});
  if (s.supply.sink_limit_A > 0 && s.supply.sinks)
    out.push_back({"supply.sink_limit_A", base::six_digits(s.supply.sink_limit_A),
                   "has no effect while supply.sinks = true", "set sinks = false, or remove this key"});
  check_brake(s.supply, C, out);
  check_battery(s.supply, out);
  check_mains(s.supply, out);
  if (s.supply.source != SourceKind::steady && !(R && C))
    out.push_back({"supply.source", "", "needs supply.resistance_ohm and a bus capacitor",
                   "give supply.resistance_ohm and supply.capacitance_F"});
  if (s.initial.bus_V && !C)
    out.push_back({"initial.bus_V", base::six_digits(*s.initial.bus_V), "has no effect on a stiff bus",
                   "remove this key, or give supply.resistance_ohm and supply.capacitance_F"});
}

}  // namespace sixstep::study
