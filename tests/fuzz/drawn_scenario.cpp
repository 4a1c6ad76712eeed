// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/drawn_scenario.hpp"

#include <map>

#include "files/scenario_on_disk.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "tests/fuzz/draw.hpp"
#include "tests/fuzz/drawn_parts.hpp"
#include "text/motor/motor_library.hpp"
#include "text/scenario/scenario_text.hpp"

namespace sixstep::testing {
namespace {

using namespace study;

struct Motor {
  std::string name;
  design::Sheet sheet;
};

/// Motors of the library that can be simulated and that have a nominal voltage.
const std::vector<Motor>& library() {
  static const std::vector<Motor> motors = [] {
    std::vector<Motor> all;
    for (const std::string& name : text::built_in_motors()) {
      const auto sheet = files::read_sheet(name);
      if (!sheet) continue;
      const auto model = design::motor_model(*sheet);
      if (model && model->nominal_voltage_V > 0 && model->K_t_Nm_A > 0) all.push_back({name, *sheet});
    }
    return all;
  }();
  return motors;
}

/// Replaces the values of the sheet by random values of another motor.
void redraw(Draw& draw, design::Sheet& sheet) {
  const double U = draw.decades(6.0, 400.0), R = draw.decades(5e-3, 20.0), top = draw.decades(30.0, 3000.0);
  const double L = 1e3 * R * draw.decades(1e-4, 1e-2), K_t = 1e3 * U / top;
  const double J = draw.decades(1e-2, 3.0) * K_t * K_t * 1e-6 / R * 1e7;
  sheet.pole_pairs = 1 + draw.one_of(14);
  sheet.nominal_voltage_V = {U, "", ""};
  sheet.resistance_ohm = {R, "terminal", ""};
  sheet.inductance_mH = {L, "terminal", ""};
  sheet.torque_constant_mNm_A = base::Quantity{K_t, "terminal", ""};
  sheet.inertia_gcm2 = {J, "", ""};
  sheet.stall_torque_mNm = base::Quantity{K_t * U / R, "", ""};
  if (draw.chance(0.3)) {
    sheet.back_emf = design::BackEmfShape::sine;
  } else if (draw.chance(0.5)) {
    sheet.flat_deg = draw.between(5.0, 178.0);
  }
}

/// Replaces the phase currents of a part of the scenarios by low-side shunts, if the drive can use them. Nothing is drawn,
/// so that a seed keeps all else.
void measure_below(Scenario& s) {
  Sensors& x = s.sensors;
  if (x.currents != rig::CurrentMeasurement::phases || x.seed % 3 != 0) return;
  Scenario below = s;
  below.sensors.currents = rig::CurrentMeasurement::low_side;
  below.sensors.shunts = static_cast<study::ShuntLegs>(1 + x.seed / 3 % 7);
  below.sensors.shunt_least_on_s = x.seed % 2 == 0 ? 0.0 : 0.1 * s.pwm.period_s;
  if (check(below).empty() && study::compile(below)) s = below;
}

}  // namespace

DrawnScenario drawn_scenario(std::uint64_t seed) {
  Draw draw(seed);
  DrawnScenario out;
  Scenario& s = out.scenario;
  const bool own = draw.chance(0.4);
  const Motor& motor = library()[static_cast<std::size_t>(draw.one_of(static_cast<int>(library().size())))];
  s.motor = own ? "maxon-251601" : motor.name;
  s.sheet = motor.sheet;
  if (own) {
    for (const Motor& m : library())
      if (m.name == s.motor) s.sheet = m.sheet;
    s.motor_sheet = s.sheet;
    redraw(draw, s.sheet);
  }
  if (!s.motor_sheet) s.motor_sheet = s.sheet;
  draw_parts(draw, s);
  measure_below(s);
  s.title = "drawn with seed " + std::to_string(seed);
  out.text = text::scenario_text(s);
  return out;
}

}  // namespace sixstep::testing
