// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/robust.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/analysis/verify/design_scenario.hpp"
#include "sixstep/analysis/verify/scenario_spec.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/thermal.hpp"
#include "sixstep/study/measure/figures.hpp"
#include "sixstep/study/run/keep_going.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/believed_motor.hpp"

namespace sixstep::analysis {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

double factor_of(const std::vector<Tolerance>& tolerances, const Variation& v, Strays quantity) {
  double factor = 1.0;
  for (std::size_t n = 0; n < tolerances.size(); ++n)
    if (tolerances[n].quantity == quantity) factor *= v.factors[n];
  return factor;
}

design::MotorModel varied_motor(const design::MotorModel& motor, const std::vector<Tolerance>& tolerances,
                                const Variation& v) {
  const auto by = [&](Strays quantity) { return factor_of(tolerances, v, quantity); };
  design::MotorModel m = motor;
  m.machine.R_ohm *= by(Strays::resistance);
  m.machine.L_H *= by(Strays::inductance);
  m.machine.K_e_V_s *= by(Strays::torque_constant);
  m.K_t_Nm_A *= by(Strays::torque_constant);
  m.shaft.J_kg_m2 *= by(Strays::inertia);
  return m;
}

/// The motor model as a sheet. The sheet has one form of each value, whatever form the motor's own sheet has.
design::Sheet sheet_of(const design::Sheet& from, const design::MotorModel& m) {
  design::Sheet s;
  s.name = from.name;
  s.maker = from.maker;
  s.kind = from.kind;
  s.pole_pitch_mm = from.pole_pitch_mm;
  if (from.kind == design::MotorKind::rotary) s.pole_pairs = static_cast<int>(m.machine.pole_pairs);
  s.back_emf = from.back_emf;
  s.flat_deg = from.flat_deg;
  s.harmonic_orders = from.harmonic_orders;
  s.harmonic_sizes = from.harmonic_sizes;
  s.back_emf_angle_deg = from.back_emf_angle_deg;
  s.back_emf_shape = from.back_emf_shape;
  s.connection = from.connection;
  s.mutual_inductance_mH = from.mutual_inductance_mH;
  s.phase_resistance_deviation = from.phase_resistance_deviation;
  s.phase_back_emf_deviation = from.phase_back_emf_deviation;
  s.cogging_orders = from.cogging_orders;
  s.cogging_mNm = from.cogging_mNm;
  s.cogging_phase_deg = from.cogging_phase_deg;
  if (m.nominal_voltage_V > 0) s.nominal_voltage_V = {m.nominal_voltage_V, "", ""};
  s.resistance_ohm = {2 * m.machine.R_ohm, "terminal", ""};
  if (design::is_salient(from)) {  // both inductances deviate by the same factor
    const double d = from.d_axis_inductance_mH->value, q = from.q_axis_inductance_mH->value;
    const double by = 2e3 * m.machine.L_H / (d + q);
    s.d_axis_inductance_mH = base::Quantity{d * by, "phase", ""};
    s.q_axis_inductance_mH = base::Quantity{q * by, "phase", ""};
  } else {
    s.inductance_mH = {2e3 * m.machine.L_H, "terminal", ""};
  }
  s.magnet_loss_percent_K = from.magnet_loss_percent_K;
  s.saturation_current_A = from.saturation_current_A;
  s.torque_constant_mNm_A = base::Quantity{1e3 * m.K_t_Nm_A, "", ""};
  s.inertia_gcm2 = {1e7 * m.shaft.J_kg_m2, "", ""};
  // Bearings and iron have one common friction, because no figure of merit distinguishes them.
  s.viscous_friction_Nm_s = base::Quantity{m.shaft.B_Nm_s, "", ""};
  s.coulomb_friction_mNm = base::Quantity{1e3 * m.shaft.coulomb_Nm, "", ""};
  return s;
}

/// The outermost levels of a tolerance, below and above the nominal value.
std::vector<Tolerance::Level> ends(const Tolerance& t) {
  Tolerance::Level low{"", 1.0}, high{"", 1.0};
  for (const Tolerance::Level& level : t.levels) {
    if (level.factor < low.factor) low = level;
    if (level.factor > high.factor) high = level;
  }
  std::vector<Tolerance::Level> out{low};
  if (high.factor != low.factor) out.push_back(high);
  return out;
}

void add_corners(const std::vector<Tolerance>& tolerances, std::vector<Variation>& out) {
  std::vector<Variation> corners{{"", {}, false}};
  for (const Tolerance& t : tolerances) {
    std::vector<Variation> next;
    for (const Variation& corner : corners)
      for (const Tolerance::Level& end : ends(t)) {
        Variation v = corner;
        v.factors.push_back(end.factor);
        if (!end.words.empty()) v.words += (v.words.empty() ? "" : ", ") + end.words;
        next.push_back(std::move(v));
      }
    corners = std::move(next);
  }
  out.insert(out.end(), corners.begin(), corners.end());
}

/// Finds the worst variation of a figure. values[v] is the figure of variation v, values[0] the nominal
/// figure; a larger value is worse.
void find_worst(RobustFigure& figure, const std::vector<Variation>& all, const std::vector<double>& values) {
  figure.nominal = figure.worst = values.front();
  figure.alone = values.front();
  for (std::size_t n = 1; n < all.size(); ++n) {
    if (values[n] > figure.worst) {
      figure.worst = values[n];
      figure.at = all[n].words;
    }
    if (all[n].single && values[n] > figure.alone) {
      figure.alone = values[n];
      figure.culprit = all[n].words;
    }
  }
}

std::vector<RobustFigure> phases_of(const design::DriveDesign& design,
                                    const std::vector<Tolerance>& tolerances,
                                    const std::vector<Variation>& all) {
  std::vector<std::vector<double>> lost(design.loops.size());
  for (const Variation& v : all) {
    const std::vector<design::SensedLoop> loops =
        design::sensed_loops(design, varied_motor(design.motor, tolerances, v), design.spec.later_periods());
    for (std::size_t n = 0; n < loops.size(); ++n) {
      const design::LoopFigures f = design::sensed_figures(loops[n], design.spec.period_s, 1024);
      lost[n].push_back(f.stable && f.phase_rad ? -*f.phase_rad * 180 / base::pi : f.stable ? -180.0 : 0.0);
    }
  }
  std::vector<RobustFigure> out;
  for (std::size_t n = 0; n < design.loops.size(); ++n) {
    RobustFigure figure{.figure = "phase margin of the " + design.loops[n].name + " loop", .unit = "deg"};
    find_worst(figure, all, lost[n]);
    for (double* lost_deg : {&figure.nominal, &figure.worst, &figure.alone})
      *lost_deg = 0.0 - *lost_deg;  // avoids -0
    out.push_back(figure);
  }
  return out;
}

/// The measured value of each comparison; `never` if the run has no value.
std::vector<double> measured(const study::Scenario& scenario, const std::function<bool()>& keep_going) {
  std::vector<double> values(scenario.compare.size(), never);
  const base::Result<study::Outcome> outcome = study::run(
      scenario,
      {.on_record = {}, .on_event = {}, .keep_going = study::listening(keep_going), .keep_books = false});
  if (!outcome || outcome->fault) return values;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double x = as_read(outcome->comparisons[n], scenario);
    if (x == x) values[n] = x;
  }
  return values;
}

/// Limit of a winding without a limit in the sheet, degC: insulation class E.
constexpr double hot_winding_degC = 120;

std::string at_degC(const char* quantity, double degC) {
  return quantity + (" at " + std::to_string(std::lround(degC))) + " degC";
}

}  // namespace

std::vector<Tolerance> sheet_tolerances(const design::Sheet& sheet, control::Mode mode) {
  const base::Result<design::ThermalModel> model = design::thermal_model(sheet);
  design::Temperatures hot{.winding_degC = hot_winding_degC};
  if (sheet.max_winding_temperature_degC) hot.winding_degC = sheet.max_winding_temperature_degC->value;
  std::vector<Tolerance> out{
      {Strays::resistance, {{"R -10 %", 0.9}, {"R +10 %", 1.1}, {at_degC("R", hot.winding_degC), on_R(hot)}}},
      {Strays::inductance, {{"L -20 %", 0.8}, {"L +20 %", 1.2}}},
  };
  if (mode == control::Mode::current) return out;
  Tolerance torque{Strays::torque_constant, {{"K_t -8 %", 0.92}, {"K_t +8 %", 1.08}}};
  if (model) {
    hot = design::at_the_limit(*model, 0.0, design::sheet_degC);
    torque.levels.push_back({at_degC("K_t", hot.housing_degC), on_K_e(sheet, hot)});
  }
  out.push_back(std::move(torque));
  out.push_back({Strays::inertia, {{"J doubled", 2.0}}});
  return out;
}

std::vector<study::Spread> tolerance_spread(const design::Sheet& sheet) {
  std::vector<study::Spread> spreads;
  for (const Tolerance& tolerance : sheet_tolerances(sheet, control::Mode::speed)) {
    const double least = tolerance.levels.front().factor;
    if (least >= 1.0) continue;  // a tolerance with one side only
    const char* key = tolerance.quantity == Strays::resistance   ? "motor_override.resistance_ohm"
                      : tolerance.quantity == Strays::inductance ? "motor_override.inductance_mH"
                      : sheet.back_emf_mV_s && !sheet.torque_constant_mNm_A
                          ? "motor_override.back_emf_mV_s"
                          : "motor_override.torque_constant_mNm_A";
    if (tolerance.quantity == Strays::inductance && design::is_salient(sheet)) continue;
    spreads.push_back(
        {.key = key, .relative = 1.0 - least, .absolute = {}, .source = tolerance.levels.front().words});
  }
  return spreads;
}

std::vector<study::Spread> hall_edge_spread(const study::Scenario& scenario) {
  std::vector<study::Spread> spreads;
  if (!rotor_sensing_of(scenario).hall || scenario.control.drive == study::FirmwareKind::sensorless)
    return spreads;
  const std::size_t edges = std::max<std::size_t>(6, scenario.sensors.hall_edges_deg.size());
  for (std::size_t n = 0; n < edges; ++n)
    spreads.push_back({.key = "sensors.hall_edges_deg[" + std::to_string(n) + "]",
                       .relative = {},
                       .absolute = mounted_hall_edge_deg,
                       .source = "Hall edge +-3 deg"});
  return spreads;
}

std::string tolerances_not_drawn(const study::Scenario& scenario) {
  std::string text;
  if (design::is_salient(scenario.sheet))
    text = "the inductances, because no key changes both of a salient rotor";
  if (hall_edge_spread(scenario).empty())
    text +=
        std::string(text.empty() ? "" : "; ") + "the places of Hall edges, because the drive reads no probes";
  return text;
}

std::vector<Variation> variations(const std::vector<Tolerance>& tolerances) {
  const std::vector<double> ones(tolerances.size(), 1.0);
  std::vector<Variation> out{{"", ones, false}};
  for (std::size_t n = 0; n < tolerances.size(); ++n)
    for (const Tolerance::Level& level : tolerances[n].levels) {
      Variation v{level.words, ones, true};
      v.factors[n] = level.factor;
      out.push_back(v);
    }
  add_corners(tolerances, out);
  return out;
}

study::Scenario varied_scenario(const study::Scenario& nominal, const design::MotorModel& motor,
                                const std::vector<Tolerance>& tolerances, const Variation& variation) {
  study::Scenario s = nominal;
  s.designed_for = study::Nominal{nominal.sheet, nominal.supply, nominal.load};
  design::MotorModel varied = varied_motor(motor, tolerances, variation);
  varied.shaft.J_kg_m2 -= nominal.load.inertia_kg_m2;  // load.inertia_kg_m2 stays nominal; the rotor's
                                                       // inertia contains the whole deviation
  s.sheet = sheet_of(nominal.sheet, varied);
  return s;
}

namespace {

/// The simulated motor with the sum of the load's and the rotor's inertia, around which the motors vary. It is
/// the design's motor unless the drive believes another one.
design::MotorModel simulated_motor(const design::DriveDesign& design, const study::Scenario& s) {
  if (!study::believes_a_motor(s.believed)) return design.motor;
  base::Result<design::MotorModel> motor = design::motor_model(s.sheet);
  if (!motor) return design.motor;
  motor->shaft.J_kg_m2 += s.load.inertia_kg_m2;
  return *motor;
}

}  // namespace

Robustness robustness(const design::DriveDesign& design, const study::Scenario& scenario,
                      const std::vector<Tolerance>& tolerances, const ForEach& for_each,
                      const std::function<bool()>& keep_going) {
  const std::vector<Variation> all = variations(tolerances);
  const design::MotorModel motor = simulated_motor(design, scenario);
  std::vector<std::vector<double>> by_variation(all.size());
  for_each(all.size(), [&](std::size_t n) {
    by_variation[n] =
        measured(n == 0 ? scenario : varied_scenario(scenario, motor, tolerances, all[n]), keep_going);
  });
  Robustness out;
  out.runs = all.size();
  for (std::size_t k = 0; k < scenario.compare.size(); ++k) {
    const study::Measure& measure = scenario.compare[k].measure;
    RobustFigure figure{.figure = figure_name(scenario, measure),
                        .unit = std::string(unit_in(scenario, figure_unit(measure)).linear)};
    std::vector<double> values;
    values.reserve(all.size());
    for (const std::vector<double>& v : by_variation) values.push_back(v[k]);
    find_worst(figure, all, values);
    out.figures.push_back(std::move(figure));
  }
  out.phases = phases_of(design, tolerances, all);
  return out;
}

}  // namespace sixstep::analysis
