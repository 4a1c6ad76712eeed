// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "report/figures.hpp"
#include "report/setup_words.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/source_words.hpp"

namespace report {

using namespace sixstep;

std::string supply(const study::Supply& s) {
  if (s.capacitance_F == 0.0) return given(s.voltage_V, "V") + ", stiff";
  std::string words = fmt::format(
      "{} behind {}{} on {}", text::source_words(s, given), given(s.resistance_ohm, "ohm"),
      s.inductance_H > 0.0 ? " and " + given(s.inductance_H, "H") : "", given(s.capacitance_F, "F"));
  if (s.capacitor_resistance_ohm > 0.0) words += " with " + given(s.capacitor_resistance_ohm, "ohm");
  if (!s.sinks)
    words += s.sink_limit_A > 0.0 ? ", takes at most " + given(s.sink_limit_A, "A") + " back"
                                  : ", takes no current back";
  if (s.brake_resistance_ohm > 0.0)
    words += fmt::format(", brake resistor {} from {} until {}", given(s.brake_resistance_ohm, "ohm"),
                         given(s.brake_on_V, "V"), given(s.brake_off_V, "V"));
  return words;
}

std::string bridge(const study::Bridge& b) {
  const bool ideal = b.on_resistance_ohm == 0.0 && b.diode_drop_V == 0.0 && b.diode_resistance_ohm == 0.0;
  const bool igbt = b.device == study::Device::igbt;
  std::string text = igbt    ? fmt::format("IGBTs {} + {}, diodes {} + {}", given(b.saturation_V, "V"),
                                           given(b.on_resistance_ohm, "ohm"), given(b.diode_drop_V, "V"),
                                           given(b.diode_resistance_ohm, "ohm"))
                     : ideal ? "ideal switches and diodes"
                             : fmt::format("switches {}, diodes {} + {}", given(b.on_resistance_ohm, "ohm"),
                                           given(b.diode_drop_V, "V"), given(b.diode_resistance_ohm, "ohm"));
  if (b.dead_time_s > 0.0) text += ", dead time " + given(b.dead_time_s, "s");
  if (b.phases != rig::WireOrder::abc)
    text += fmt::format(", phases {} at legs a, b, c", base::word(study::phase_order_choices, b.phases));
  return text;
}

std::string shaft(const study::Load& load, bool linear) {
  if (load.locked) return "locked";
  const auto of = [linear](double x, const char* turning, const char* moving) {
    return given(x, linear ? moving : turning);
  };
  if (!load.dynamometer_rad_s.empty())
    return "turned by a dynamometer, " + text::counted(load.dynamometer_rad_s.size(), "point");
  std::string text = "free";
  if (load.torque_Nm != 0.0) text += ", load " + of(load.torque_Nm, "Nm", "N");
  if (!load.torques_Nm.empty())
    text += ", " + text::counted(load.torques_Nm.size(),
                                 load.between == study::Between::lines ? "load point" : "load step");
  if (!load.at_speeds_Nm.empty())
    text += ", load over speed, " + text::counted(load.at_speeds_Nm.size(), "point");
  if (load.inertia_kg_m2 != 0.0)
    text += (linear ? ", load mass " : ", load inertia ") + of(load.inertia_kg_m2, "kg m2", "kg");
  if (load.gear != 1.0) text += fmt::format(", gear {} : 1", plain(load.gear, 6, true));
  if (load.gear_efficiency < 1.0) text += " of " + given(100 * load.gear_efficiency, "%");
  if (load.stiffness_Nm_rad != 0.0) text += ", elastic, " + of(load.stiffness_Nm_rad, "Nm/rad", "N/m");
  if (load.viscous_Nm_s != 0.0) text += ", viscous friction " + of(load.viscous_Nm_s, "Nm s", "N s/m");
  if (load.coulomb_Nm != 0.0) text += ", Coulomb friction " + of(load.coulomb_Nm, "Nm", "N");
  if (load.static_Nm != 0.0) text += ", breaks loose at " + of(load.static_Nm, "Nm", "N");
  if (const double square = study::square_law(load).Nm_s2; square != 0.0)
    text += (linear ? ", drag " : ", fan ") + of(square, "Nm s2", "N s2/m2");
  if (load.gravity_Nm != 0.0) text += ", weight " + given(load.gravity_Nm, "Nm");
  return text;
}

std::string heat(const study::Heat& h) {
  if (!h.motor && !h.devices) return "";
  std::string text = h.motor ? fmt::format("winding from {}, housing from {}, air {}",
                                           given(h.winding_degC.value_or(h.ambient_degC), "degC"),
                                           given(h.housing_degC.value_or(h.ambient_degC), "degC"),
                                           given(h.ambient_degC, "degC"))
                             : "";
  if (h.devices) text += (text.empty() ? "" : "; ") + std::string("junctions");
  return text;
}

}  // namespace report
