// SPDX-License-Identifier: Apache-2.0
#include "report/groups.hpp"

#include <algorithm>
#include <cmath>

#include "report/windows.hpp"
#include "sixstep/base/linear.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace report {
namespace {

using sixstep::control::Mode;
using sixstep::study::Trace;

constexpr const char* hall_labels[] = {"H1", "H2", "H3"};

/// The meaning of a column, shown when the pointer is over its label.
std::string meaning_of(const Trace& trace, std::string_view name) {
  for (const auto& column : trace.columns)
    if (column.name == name)
      return column.frame.empty() ? column.meaning : column.meaning + " (" + column.frame + ")";
  return {};
}

void add(Group& group, const Trace& trace, std::string_view name, std::string label, std::string style) {
  if (const auto* values = find_column(trace, name))
    group.curves.push_back({std::move(label), std::move(style), meaning_of(trace, name), values});
}

std::vector<double> times(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

std::vector<double> in_degrees(std::vector<double> angles) {
  return times(std::move(angles), 180.0 / 3.14159265358979323846);
}

/// The chart of currents. A field-oriented drive has no driven pair; the currents in its rotor's frame are in
/// another chart.
Group currents(const Trace& trace, bool of_field) {
  Group g{.id = "currents", .title = "Currents", .unit = "A", .height_px = 270, .quantity = "current"};
  // i_m is equal to one phase current at every instant. It is drawn first, so that the phase currents are
  // above it.
  if (!of_field) add(g, trace, "i_m_A", "i_m", "beneath");
  add(g, trace, "i_a_A", "i_a", "a");
  add(g, trace, "i_b_A", "i_b", "b");
  add(g, trace, "i_c_A", "i_c", "c");
  if (!of_field) add(g, trace, "i_ref_A", "i_ref", "reference");
  return g;
}

/// The sum of a delta's branch currents, which cannot be measured at a terminal. The circulating current is a
/// third of the sum.
Group loop_current(const Trace& trace) {
  Group g{.id = "loop-current",
          .title = "Sum of the delta's branch currents: three times the circulating current",
          .unit = "A",
          .height_px = 150,
          .quantity = "current"};
  add(g, trace, "loop_A", "j_ab + j_bc + j_ca", "main");
  return g;
}

/// The currents that a field-oriented drive controls.
Group rotor_currents(const Trace& trace) {
  Group g{.id = "rotor-currents",
          .title = "Currents along the magnet and across it",
          .unit = "A",
          .height_px = 216,
          .quantity = "current"};
  add(g, trace, "i_d_A", "i_d", "a");
  add(g, trace, "i_d_ref_A", "i_d*", "a-soft");
  add(g, trace, "i_q_A", "i_q", "main");
  add(g, trace, "i_q_ref_A", "i_q*", "reference");
  return g;
}

Group rotor_voltages(const Trace& trace) {
  Group g{.id = "rotor-voltages",
          .title = "Voltages along the magnet and across it",
          .unit = "V",
          .height_px = 150};
  add(g, trace, "v_d_V", "v_d", "a");
  add(g, trace, "v_q_V", "v_q", "main");
  return g;
}

/// The estimated angle of the magnet minus the true angle.
Group rotor_angle(const Trace& trace) {
  Group g{.id = "rotor-angle", .title = "Error of the magnet's angle", .unit = "deg", .height_px = 150};
  add(g, trace, "angle_error_deg", "error", "main");
  return g;
}

Group logic(const Trace& trace, std::deque<std::vector<double>>& derived) {
  Group g{.id = "logic", .title = "Gates and Hall probes", .unit = "", .height_px = 216, .logic = true};
  add(g, trace, "gate_T1", "T1 a↑", "a");
  add(g, trace, "gate_T2", "T2 a↓", "a-soft");
  add(g, trace, "gate_T3", "T3 b↑", "b");
  add(g, trace, "gate_T4", "T4 b↓", "b-soft");
  add(g, trace, "gate_T5", "T5 c↑", "c");
  add(g, trace, "gate_T6", "T6 c↓", "c-soft");
  const auto* hall = find_column(trace, "hall");
  if (!hall) return g;
  for (int bit = 2; bit >= 0; --bit) {  // bits 2, 1, 0 are H1, H2, H3
    std::vector<double> level;
    level.reserve(hall->size());
    for (const double code : *hall)
      level.push_back(std::isfinite(code) ? (static_cast<int>(code) >> bit & 1) : code);
    derived.push_back(std::move(level));
    g.curves.push_back({hall_labels[2 - bit], "main", "Hall probe", &derived.back()});
  }
  return g;
}

Group line_voltages(const Trace& trace) {
  Group g{.id = "line-voltages", .title = "Line voltages", .unit = "V", .height_px = 216, .lanes = true};
  add(g, trace, "u_ab_V", "u_ab", "a");
  add(g, trace, "u_bc_V", "u_bc", "b");
  add(g, trace, "u_ca_V", "u_ca", "c");
  return g;
}

Group back_emf(const Trace& trace) {
  Group g{.id = "back-emf", .title = "Back-EMF", .unit = "V", .height_px = 150};
  add(g, trace, "e_a_V", "e_a", "a");
  add(g, trace, "e_b_V", "e_b", "b");
  add(g, trace, "e_c_V", "e_c", "c");
  return g;
}

Group speed(const Trace& trace, bool linear) {
  Group g{.id = "speed",
          .title = "Speed",
          .unit = linear ? "m/s" : "rad/s",
          .height_px = 190,
          .quantity = linear ? "" : "speed"};
  add(g, trace, "speed_rad_s", linear ? "v" : "ω", "main");
  add(g, trace, "speed_ref_rad_s", linear ? "v_ref" : "ω_ref", "reference");
  return g;
}

Group torque(const Trace& trace, bool linear) {
  Group g{.id = "torque",
          .title = linear ? "Force" : "Torque",
          .unit = linear ? "N" : "Nm",
          .height_px = 150,
          .quantity = linear ? "" : "torque"};
  add(g, trace, "torque_Nm", linear ? "F" : "T_e", "main");
  const auto* load = find_column(trace, "load_Nm");
  if (load && std::ranges::any_of(*load, [](double t) { return t != 0.0; }))
    add(g, trace, "load_Nm", linear ? "F_load" : "T_load", "reference");
  return g;
}

Group duty(const Trace& trace) {
  Group g{.id = "duty", .title = "Duty", .unit = "", .height_px = 130};
  add(g, trace, "duty", "d", "main");
  return g;
}

/// The shaft's angle if it is controlled. In other modes, it only increases and is not shown.
Group position(const Trace& trace, std::deque<std::vector<double>>& derived, bool linear) {
  Group g{.id = "position",
          .title = "Position",
          .unit = linear ? "mm" : "°",
          .height_px = 220,
          .quantity = linear ? "" : "angle"};
  if (const auto* angle = find_column(trace, "angle_rad")) {
    derived.push_back(linear ? times(*angle, 1e3) : in_degrees(*angle));
    g.curves.push_back({linear ? "x" : "θ", "main", meaning_of(trace, "angle_rad"), &derived.back()});
  }
  const auto* wanted = linear ? find_column(trace, "position_ref_deg") : nullptr;
  if (!linear) add(g, trace, "position_ref_deg", "θ_ref", "reference");
  if (wanted) {
    derived.push_back(times(*wanted, sixstep::base::in_linear("deg").factor));
    g.curves.push_back({"x_ref", "reference", meaning_of(trace, "position_ref_deg"), &derived.back()});
  }
  return g;
}

/// The bus voltage. A constant bus voltage needs no chart.
Group bus(const Trace& trace) {
  Group g{.id = "bus", .title = "Bus voltage", .unit = "V", .height_px = 130};
  const auto* volts = find_column(trace, "bus_V");
  if (!volts) return g;
  const auto [low, high] = std::ranges::minmax(*volts, [](double a, double b) { return a < b; });
  if (high - low > 1e-9 * std::abs(high)) add(g, trace, "bus_V", "U_s", "main");
  return g;
}

/// Whether a group has no curve, or only zeros, such as the speed of a locked rotor. Currents are always
/// shown: a current of zero is information.
bool nothing_to_see(const Group& g) {
  if (g.logic || g.id == "currents") return g.curves.empty();
  return std::ranges::all_of(g.curves, [](const Curve& curve) {
    return std::ranges::none_of(*curve.values, [](double v) { return std::abs(v) > 0.0; });
  });
}

}  // namespace

Groups chart_groups(const Trace& trace, const sixstep::study::Scenario& scenario) {
  const Mode mode = scenario.control.mode;
  const bool linear = scenario.sheet.kind == sixstep::design::MotorKind::linear;
  Groups out;
  auto& charts = out.charts;
  if (mode == Mode::position) charts.push_back(position(trace, out.derived, linear));
  if (mode == Mode::position || mode == Mode::speed) charts.push_back(speed(trace, linear));
  const bool of_field = scenario.control.drive == sixstep::study::FirmwareKind::field;
  charts.push_back(currents(trace, of_field));
  charts.push_back(loop_current(trace));
  if (of_field) {
    charts.push_back(rotor_currents(trace));
    charts.push_back(rotor_voltages(trace));
    charts.push_back(rotor_angle(trace));
  }
  charts.push_back(logic(trace, out.derived));
  charts.push_back(line_voltages(trace));
  charts.push_back(back_emf(trace));
  if (mode != Mode::position && mode != Mode::speed) charts.push_back(speed(trace, linear));
  charts.push_back(torque(trace, linear));
  charts.push_back(duty(trace));
  charts.push_back(bus(trace));
  std::erase_if(charts, nothing_to_see);
  if (linear)
    for (Group& chart : charts)
      for (Curve& curve : chart.curves) curve.meaning = sixstep::base::linear_words(curve.meaning);
  if (const auto* angle = find_column(trace, "angle_rad")) out.angle_deg = in_degrees(*angle);
  return out;
}

}  // namespace report
