// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/field_study.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/analysis/verify/scenario_loops.hpp"
#include "sixstep/analysis/verify/scenario_spec.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/design_warnings.hpp"
#include "sixstep/design/loops/harmonic_current.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/belief_costs.hpp"
#include "sixstep/study/scenario/believed_motor.hpp"
#include "sixstep/study/scenario/low_side_window.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"

namespace sixstep::analysis {
namespace {

using control::Mode;
using design::DerivationStep;
using design::LoopDesign;

double circle_V(const FieldStudy& f) { return f.design.bus_V / std::sqrt(3.0); }

/// Speed in rad/s at which the magnet's back-EMF equals the radius of the voltage circle.
double base_speed_rad_s(const FieldStudy& f) { return circle_V(f) / f.simulated.magnet_V_s; }

/// |v|^2 = (R i + w p psi)^2 + (w p L_q i)^2, solved for the speed w; i: current i_q, other symbols of model.md 7.
/// Returns 0 if R i exceeds |v|.
double speed_for_current_rad_s(const FieldStudy& f, double i_q_A, double voltage_V) {
  const design::FieldMachine& m = f.simulated;
  const double e = m.magnet_V_s, x = m.pole_pairs * m.L_q_H * i_q_A, r = m.R_ohm * i_q_A;
  const double a = e * e + x * x, half_b = r * e, c = r * r - voltage_V * voltage_V;
  return c < 0 ? (std::sqrt(half_b * half_b - a * c) - half_b) / a : 0.0;
}

LoopDesign named(std::string name, std::string method, design::PiGains gains,
                 std::vector<DerivationStep> steps) {
  return {.name = std::move(name),
          .method = std::move(method),
          .gains = gains,
          .steps = std::move(steps),
          .placed = {},
          .loop = {},
          .figures = {},
          .other = {},
          .built = {},
          .step = {}};
}

bool is_current(const study::LoopGains& g) { return g.loop.starts_with("current"); }

/// The derivation steps of one axis in field_steps; both axes have the same number of steps.
std::vector<DerivationStep> steps_of(const study::Compiled& c, std::size_t axis) {
  const auto axes = static_cast<std::size_t>(std::count_if(c.gains.begin(), c.gains.end(), is_current));
  const auto each = static_cast<std::ptrdiff_t>(c.field_steps.size() / axes);
  const auto from = c.field_steps.begin() + each * static_cast<std::ptrdiff_t>(axis);
  return {from, from + each};
}

/// Steps that derive an outer loop's gains. Position loop: the given gain and its conversion. Other loops: the
/// pole placement; empty if the gains do not come from it.
std::vector<DerivationStep> outer_steps(const study::LoopGains& g) {
  if (g.loop == "position")
    return {{"K_p", "as given", g.d1, "rad/s/deg"},
            {"K_p", "the same in radians", g.d1 * 180.0 / base::pi, "1/s"}};
  const bool placed = g.derivation && g.derivation->gains.d1 == g.d1 && g.derivation->gains.d0 == g.d0;
  return placed ? g.derivation->steps : std::vector<DerivationStep>();
}

/// The open loop with this name; its inner loops are closed.
design::Transfer open_loop(const std::string& name, const design::DriveLoops& loops) {
  if (name == "speed") return open_speed_loop(loops);
  if (name == "position") return open_position_loop(loops);
  return open_current_loop(loops);
}

void add_loops(const study::Compiled& c, const design::DriveLoops& loops, FieldStudy& f) {
  std::size_t axis = 0;
  const design::Transfer speed = open_speed_loop(loops);
  for (const study::LoopGains& g : c.gains) {
    design::DriveLoops own = loops;
    own.late_periods = f.design.spec.late_periods();
    if (g.loop == "current d") {
      own.winding.L_H = f.machine.L_d_H;
      own.current = {g.d1, g.d0};
    }
    design::DriveLoops other = own;
    other.late_periods =
        f.design.spec.delay_periods > 0 ? f.design.spec.sooner_periods() : f.design.spec.later_periods();
    LoopDesign loop =
        named(g.loop, g.origin, {g.d1, g.d0}, is_current(g) ? steps_of(c, axis++) : outer_steps(g));
    design::SensedLoop sensed{open_loop(g.loop, own), {}, {}};
    if (!is_current(g)) sensed.lag = f.design.lag;
    if (g.loop == "position") sensed.around = speed;
    judge_loop(loop, open_loop(g.loop, own), open_loop(g.loop, other), sensed, own.period_s,
               design::settling_band(f.design));
    f.design.loops.push_back(std::move(loop));
  }
}

/// Adds the delay of the speed measurement at the lowest requested speed, or by default at a tenth of the
/// largest speed on this bus.
void add_sensing(const design::DriveLoops& loops, FieldStudy& f) {
  design::DriveDesign& d = f.design;
  d.lowest_speed_rad_s =
      d.spec.lowest_speed_rad_s.value_or(base::shortened(0.1 * base_speed_rad_s(f), 2, base::Towards::down));
  if (d.spec.mode == Mode::current || !d.spec.rotor.lags()) return;
  const double full = d.current_at_full_torque_A * loops.winding.torque_Nm_A / loops.motor.shaft.J_kg_m2;
  const double crossover = design::speed_crossover_rad_s(loops.speed.d1, full);
  d.lag = speed_lag(d.spec.rotor, f.machine.pole_pairs, d.lowest_speed_rad_s, crossover);
  d.sensing = lag_steps(d.spec.rotor, f.machine.pole_pairs, d.lowest_speed_rad_s, crossover);
}

void add_axes(const control::FieldDriveConfig<double>& c, FieldStudy& f) {
  const design::FieldMachine& m = f.machine;
  f.axes = {
      {"p psi", "peak of the back-EMF's fundamental per speed", m.magnet_V_s, "V s"},
      {"K_q", "3/2 p psi, torque per i_q", torque_per_q_A(m), "N m/A"},
      {"p L_d", "decoupling: voltage across the magnet per speed and i_d", c.current.d_V_s_A, "V s/A"},
      {"p L_q", "decoupling: voltage along the magnet per speed and i_q", c.current.q_V_s_A, "V s/A"},
      {"n T p", "angle by which the magnet turns until a command acts, per speed", c.advance.rad_s, "s"}};
  if (!c.current.decouples) f.axes.erase(f.axes.begin() + 2, f.axes.begin() + 4);
  if (c.per_ampere.k_per_A != 0)
    f.axes.push_back({"k", "(L_q - L_d)/(2 psi), most torque per ampere", c.per_ampere.k_per_A, "1/A"});
  if (c.harmonic.on) {
    const design::HarmonicFigures shape = design::harmonic_figures(c.harmonic);
    f.axes.push_back({"g", "torque swing of a constant i_q, relative to its mean", shape.swing, ""});
    f.axes.push_back(
        {"1/|g|^2", "copper loss of the shape's current, relative to a constant i_q", shape.copper, ""});
  }
  if (!(c.weakening.most_A > 0)) return;
  f.axes.push_back({"K", "weakening, per sample", c.weakening.K_A_per_V, "A/V"});
  f.axes.push_back({"psi/L_d", "current against the magnet above which weakening needs more voltage",
                    most_weakening_A(m), "A"});
}

void add_limits(const control::FieldDriveConfig<double>& c, FieldStudy& f) {
  const double I = f.design.nominal_current_A;
  f.limits = {
      {"U_s/sqrt 3", "the circle, the largest phase voltage in every direction", circle_V(f), "V"},
      {"w_0", "speed at which the magnet's back-EMF reaches the circle", base_speed_rad_s(f), "rad/s"}};
  if (I > 0) {
    f.limits.push_back({"i_q",
                        f.design.spec.mode == Mode::current ? "the sheet's nominal current"
                                                            : "largest current reference of the speed loop",
                        I, "A"});
    f.limits.push_back({"w(i_q)", "highest speed at which the circle drives i_q",
                        speed_for_current_rad_s(f, I, circle_V(f)), "rad/s"});
    f.limits.push_back({"K_q i_q", "torque of this current", I * torque_per_q_A(f.simulated), "N m"});
  }
  if (!(c.weakening.most_A > 0)) return;
  const double left =
      f.simulated.magnet_V_s - f.simulated.pole_pairs * f.simulated.L_d_H * c.weakening.most_A;
  if (left > 0)
    f.limits.push_back({"w_1", "m U_s/(sqrt 3 p (psi - L_d I)): weakened, without a load",
                        c.weakening.part * circle_V(f) / left, "rad/s"});
}

std::string slower(const std::string& name) {
  if (name == "position") return "lower control.position.gain_rad_s_per_deg";
  if (name == "speed") return "lengthen control.speed.settle_s";
  return "lower control.field.bandwidth_Hz or the gains of control.current";
}

/// `on`: "" or on which motor.
void look_at_loop(const LoopDesign& loop, const std::string& on, FieldStudy& f) {
  const auto warn = [&](const std::string& what, bool grave) {
    f.warnings.push_back({on + "the " + loop.name + " loop " + what,
                          on.empty() ? slower(loop.name) : "correct [believed]", grave});
  };
  const design::LoopFigures& built = loop.built;
  const bool sensed = built.phase_rad != loop.figures.phase_rad;
  const std::string with = sensed ? " with the delay of its sensor" : "";
  if (!loop.figures.stable || !built.stable) return warn("is unstable" + with, true);
  const double phase_deg = built.phase_rad.value_or(base::pi) * 180.0 / base::pi;
  if (phase_deg < design::least_phase_deg - 0.1)
    warn("has a phase margin of " + base::three_digits(phase_deg) + " degrees" + with + ", less than " +
             base::three_digits(design::least_phase_deg),
         phase_deg < design::unusable_phase_deg);
  else if (built.sensitivity_peak > design::greatest_sensitivity)
    warn("amplifies disturbances up to " + base::three_digits(built.sensitivity_peak) + " times", false);
  if (loop.name != "position" && std::isfinite(loop.step.overshoot) && loop.step.overshoot > 0.1)
    f.warnings.push_back(
        {on + "the " + loop.name + " loop overshoots a step by " +
             base::three_digits(100.0 * loop.step.overshoot) + " %, because of the zero of its PI",
         on.empty() ? "limit how fast the setpoint rises (control.slew)" : "correct [believed]", false});
}

void look_at_separation(FieldStudy& f) {
  for (std::size_t n = 0; n + 1 < f.design.loops.size(); ++n) {
    const LoopDesign &inner = f.design.loops[n], &outer = f.design.loops[n + 1];
    if (outer.name.starts_with("current") || outer.name == "position") continue;
    if (!inner.figures.crossover_rad_s || !outer.figures.crossover_rad_s) continue;
    const double ratio = *inner.figures.crossover_rad_s / *outer.figures.crossover_rad_s;
    if (ratio < design::least_separation)
      f.warnings.push_back({"the " + inner.name + " loop crosses over at only " + base::three_digits(ratio) +
                                " times the frequency of the " + outer.name + " loop",
                            slower(outer.name), false});
  }
}

void look_at_bus(const control::FieldDriveConfig<double>& c, double asked_rad_s, FieldStudy& f) {
  if (asked_rad_s > base_speed_rad_s(f) && !(c.weakening.most_A > 0))
    f.warnings.push_back({"the reference is " + base::three_digits(asked_rad_s) + " rad/s, and above " +
                              base::three_digits(base_speed_rad_s(f)) +
                              " rad/s the back-EMF exceeds the bus voltage even without a current",
                          "set control.field.weakening_A, or raise supply.voltage_V", false});
}

/// Largest i_q that the drive may command, A: of a current drive its reference, of another the limit.
double largest_current_A(const study::Scenario& s, const FieldStudy& f) {
  return f.design.spec.mode == Mode::current ? study::largest_reference(s) : f.design.nominal_current_A;
}

/// Adds the window of low-side shunts, and warns if the reference needs a greater modulation than they allow.
void look_at_low_side(const study::Scenario& s, double asked_rad_s, FieldStudy& f) {
  const std::optional<double> most = study::greatest_modulation(s);
  if (s.sensors.currents != rig::CurrentMeasurement::low_side || !most) return;
  const double i_q_A = largest_current_A(s, f);
  const double up_to = speed_for_current_rad_s(f, i_q_A, *most * circle_V(f));
  const std::string current =
      "i_q = " + base::three_digits(i_q_A) + " A, the largest " +
      (f.design.spec.mode == Mode::current ? "reference," : "that the drive commands,");
  f.limits.push_back({"d", "duty up to which a low-side shunt shows its leg's current",
                      study::low_side_of(s).greatest_duty, ""});
  f.limits.push_back({"m", "modulation up to which two legs are shown at every angle", *most, ""});
  f.limits.push_back({"w(m)", "speed at which " + current + " needs this modulation", up_to, "rad/s"});
  if (asked_rad_s > up_to)
    f.warnings.push_back({"the reference is " + base::three_digits(asked_rad_s) + " rad/s, and above " +
                              base::three_digits(up_to) + " rad/s " + current +
                              " needs duties at which the low-side shunts show fewer than two currents (" +
                              study::window_keys(s) + ")",
                          "shorten these times, raise supply.voltage_V, or set sensors.shunts = \"abc\"",
                          false});
}

/// Adds the lag of the estimated speed: w_n^2/(s + w_n)^2 for a tracking loop with damping 1.
void look_at_estimator(const study::Compiled& c, double period_s, FieldStudy& f) {
  if (!c.estimator.on) return;
  f.axes.insert(f.axes.end(), c.estimator_steps.begin(), c.estimator_steps.end());
  const auto& K_i = c.estimator.tracking.K_i;
  const double w_n = std::sqrt(std::ldexp(static_cast<double>(K_i.mantissa), -K_i.right)) / period_s;
  for (const LoopDesign& loop : f.design.loops) {
    if (loop.name != "speed" || !loop.figures.crossover_rad_s) continue;
    const double lost_deg = 2 * base::atan2(*loop.figures.crossover_rad_s, w_n) * 180.0 / base::pi;
    if (lost_deg > 20.0)
      f.warnings.push_back({"the speed loop loses " + base::three_digits(lost_deg) +
                                " degrees of phase to the loop that follows the magnet's angle",
                            "lengthen control.speed.settle_s, or raise control.field.angle_bandwidth_Hz",
                            false});
  }
}

/// The same gains on the simulated motor, and beliefs with which no drive works.
void look_at_beliefs(const study::Compiled& c, FieldStudy& f) {
  std::vector<study::BeliefCost> costs = study::belief_costs(f.scenario, c);
  if (costs.empty()) return;
  for (study::BeliefCost& cost : costs) {
    if (cost.grave) f.warnings.push_back({cost.text, "correct [believed], or the mounting", true});
    f.beliefs.push_back(std::move(cost.text));
  }
  FieldStudy real;
  real.machine = f.simulated;
  real.design.spec = f.design.spec;
  real.design.lag = f.design.lag;
  add_loops(c, loops_of(f.scenario, c), real);
  for (const LoopDesign& loop : real.design.loops) look_at_loop(loop, "on the motor itself ", f);
  if (f.warnings.empty())
    f.warnings.push_back(
        {"the drive is designed for wrong numbers (wrong beliefs above)", "correct [believed]", false});
}

double fastest_asked_rad_s(const study::Scenario& s) {
  if (s.control.mode != Mode::speed) return 0.0;
  double most = 0.0;
  for (const study::Level& level : study::reference_levels(s)) most = std::max(most, std::fabs(level.value));
  return most;
}

}  // namespace

bool FieldStudy::usable() const {
  return std::none_of(warnings.begin(), warnings.end(), [](const design::Warning& w) { return w.grave; });
}

base::Result<FieldStudy> study_field(const study::Scenario& s) {
  if (s.control.drive != study::FirmwareKind::field)
    return base::Problem{"control.drive", "", "is not field-oriented",
                         "set control.drive = \"field-oriented\""};
  if (s.control.mode == Mode::off)
    return base::Problem{"control.mode", "\"off\"", "has no loop",
                         "set control.mode = \"current\", \"speed\" or \"position\""};
  if (s.control.field.law == study::FieldLaw::finite_set)
    return base::Problem{"control.field.law", "\"finite-set\"", "has no gains and no linear loop",
                         "run the scenario, or set control.field.law = \"pi\""};
  if (base::Problems problems = study::check(s); !problems.empty()) return problems;
  const base::Result<study::Compiled> c = study::compile(s);
  if (!c) return c.problems();
  const design::DriveLoops loops = believed_loops_of(s, *c);
  FieldStudy f;
  f.scenario = s;
  f.simulated = design::field_machine(c->motor, s.sheet);
  f.simulated_shaft = c->shaft;
  f.machine = design::field_machine(c->believed.motor, study::believed_sheet(s));
  design::DriveDesign& d = f.design;
  d.spec = spec_of(s);
  d.motor = loops.motor;
  d.bus_V = s.supply.voltage_V;
  d.current_at_full_torque_A = c->drive.current_at_full_torque_A;
  d.torque_limit_Nm = d.current_at_full_torque_A * torque_per_q_A(f.machine);
  d.nominal_current_A = d.spec.mode == Mode::current
                            ? c->believed.motor.nominal_current_A
                            : std::min(c->drive.current_limit_A, d.current_at_full_torque_A);
  add_sensing(loops, f);
  add_loops(*c, loops, f);
  add_axes(*c->field, f);
  add_limits(*c->field, f);
  for (const LoopDesign& loop : d.loops) look_at_loop(loop, "", f);
  look_at_beliefs(*c, f);
  look_at_separation(f);
  look_at_estimator(*c, s.pwm.period_s, f);
  look_at_bus(*c->field, fastest_asked_rad_s(s), f);
  look_at_low_side(s, fastest_asked_rad_s(s), f);
  return f;
}

}  // namespace sixstep::analysis
