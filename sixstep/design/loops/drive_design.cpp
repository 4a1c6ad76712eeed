// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/drive_design.hpp"

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/design_warnings.hpp"
#include "sixstep/design/loops/drive_loops.hpp"
#include "sixstep/design/loops/gain_rules.hpp"
#include "sixstep/design/loops/margins.hpp"
#include "sixstep/design/loops/spec_check.hpp"

namespace sixstep::design {
namespace {

using control::Mode;

// Ratio of the settling times of the thesis's two loops (chapter 6).
constexpr double inner_faster = 10.0;

/// Longest default settling time of a current loop, in L/R. A pole pair with a settling time above 2
/// time_constants_to_settle L/R (9.2 L/R) would need a negative proportional gain.
constexpr double winding_times = 8.0;

/// Shortest settling time of a placed pole pair, in control periods.
constexpr double fewest_periods = 4.0;

double settle_of_current(const DesignSpec& w, const MotorModel& m) {
  const double usual = std::fmax(usual_current_settle_s_of(m), fewest_periods * w.period_s);
  if (w.mode == Mode::current) return w.settle_s.value_or(usual);
  return w.current_settle_s.value_or(
      std::fmin(usual, w.settle_s.value_or(usual_speed_settle_s) / inner_faster));
}

DriveLoops loops_of(const DriveDesign& d, const MotorModel& motor, double late_periods) {
  DriveLoops to{.motor = motor,
                .winding = driven_pair(motor, d.spec.chopping),
                .period_s = d.spec.period_s,
                .late_periods = late_periods};
  for (const LoopDesign& loop : d.loops) {
    if (loop.name == "current") to.current = loop.gains;
    if (loop.name == "speed") to.speed = loop.gains;
    if (loop.name == "position") to.position_gain_rad_s_per_deg = loop.gains.d1;
  }
  to.current_at_full_torque_A = d.current_at_full_torque_A;
  return to;
}

/// Time in which the slowest root decays to a hundredth of the settling band, s.
double watched_s(const Transfer& whole, double period_s) {
  const double decay = slowest_decay(whole.den);
  const double periods = decay > 0.0 ? 8.5 / decay : 2000.0;
  return std::fmin(periods, 200000.0) * period_s;
}

void judge(DriveDesign& d, LoopDesign& loop, std::size_t index) {
  const DesignSpec& w = d.spec;
  const double late = w.late_periods(), other = w.delay_periods > 0 ? w.sooner_periods() : w.later_periods();
  judge_loop(loop, open_loops(d, d.motor, late)[index], open_loops(d, d.motor, other)[index],
             sensed_loops(d, d.motor, late)[index], w.period_s, settling_band(d));
}

base::Result<LoopDesign> by_placement(const char* name, const ZohPlant& plant, double settle_s,
                                      double damping, double period_s) {
  base::Result<PolePlacement> placed = place_poles(plant, settle_s, damping, period_s);
  if (!placed) return placed.problems();
  return LoopDesign{.name = name,
                    .method = "pole placement",
                    .gains = placed->gains,
                    .steps = placed->steps,
                    .placed = *placed,
                    .loop = {},
                    .figures = {},
                    .other = {},
                    .built = {},
                    .step = {}};
}

base::Result<LoopDesign> by_rule(const char* name, const char* method, const base::Result<RuleGains>& rule) {
  if (!rule) return rule.problems();
  return LoopDesign{.name = name,
                    .method = method,
                    .gains = rule->gains,
                    .steps = rule->steps,
                    .placed = {},
                    .loop = {},
                    .figures = {},
                    .other = {},
                    .built = {},
                    .step = {}};
}

base::Result<LoopDesign> current_loop(const DriveDesign& d) {
  const DesignSpec& w = d.spec;
  const LoopWinding winding = driven_pair(d.motor, w.chopping);
  const double settle = settle_of_current(w, d.motor);
  base::Result<LoopDesign> loop =
      w.method == GainMethod::cancellation
          ? by_rule("current", "pole-zero cancellation",
                    cancel_pole(winding.R_ohm, winding.L_H,
                                w.bandwidth_rad_s.value_or(time_constants_to_settle / settle), w.period_s))
          : by_placement("current", current_plant(winding, w.period_s), settle,
                         w.current_damping.value_or(w.damping), w.period_s);
  if (loop) tell_chopping(w.chopping, loop->steps);
  return loop;
}

base::Result<LoopDesign> speed_loop(const DriveDesign& d) {
  const DesignSpec& w = d.spec;
  const plant::Shaft& shaft = d.motor.shaft;
  if (w.method == GainMethod::symmetrical_optimum) {
    const ZohPlant plant = current_plant(driven_pair(d.motor, w.chopping), w.period_s);
    const double lag = lag_of_loop_s(plant, d.loops[0].gains, w.period_s);
    const double a = w.bandwidth_rad_s ? 1.0 / (*w.bandwidth_rad_s * lag) : 1.0 + 2.0 * w.damping;
    if (w.bandwidth_rad_s && !(a > 1.0))
      return base::Problem{
          "bandwidth_rad_s", base::written(*w.bandwidth_rad_s),
          "must be below the limit from the current loop's lag, " + base::written(1.0 / lag) + " rad/s",
          "lower this value; at a third of this limit the rule gives a phase margin of 53 degrees"};
    return by_rule("speed", "symmetrical optimum",
                   symmetrical_optimum(shaft.J_kg_m2, d.torque_limit_Nm, lag, a, w.period_s));
  }
  return by_placement("speed", speed_plant(d.torque_limit_Nm, shaft.J_kg_m2, shaft.B_Nm_s, w.period_s),
                      w.settle_s.value_or(usual_speed_settle_s), w.damping, w.period_s);
}

bool overshoots(const Transfer& open, double gain, double period_s) {
  Transfer loop = open;
  for (double& x : loop.num) x *= gain;
  const Transfer whole = closed(loop);
  if (!is_stable(whole.den)) return true;
  // A step that approaches 1 from below may exceed 1 by rounding.
  return step_response(whole, period_s, watched_s(whole, period_s)).overshoot > 1e-9;
}

/// The largest position gain with which the linear loop does not overshoot. Bisection is possible because the
/// overshoot grows with the gain.
double largest_position_gain(const DriveDesign& d) {
  DriveLoops loops = loops_of(d, d.motor, d.spec.late_periods());
  loops.position_gain_rad_s_per_deg = 1.0;
  const Transfer open = open_position_loop(loops);
  double low = 0.0, high = 1e-3;
  while (!overshoots(open, high, d.spec.period_s) && high < 1e6) {
    low = high;
    high *= 2.0;
  }
  for (int n = 0; n < 24; ++n) {
    const double middle = low + (high - low) / 2.0;
    (overshoots(open, middle, d.spec.period_s) ? high : low) = middle;
  }
  return low;
}

LoopDesign position_loop(double gain, const char* method, const char* meaning) {
  return {.name = "position",
          .method = method,
          .gains = {gain, 0.0},
          .steps = {{"K_p", meaning, gain, "rad/s/deg"},
                    {"K_p", "the same in radians", gain * 180.0 / base::pi, "1/s"}},
          .placed = {},
          .loop = {},
          .figures = {},
          .other = {},
          .built = {},
          .step = {}};
}

/// Phase margin of a current loop with the longer of the board's two delays, rad; empty if the loop has no
/// crossover.
std::optional<double> phase_left_rad(const DriveDesign& d, const PiGains& gains, double period_s) {
  const LoopWinding winding = driven_pair(d.motor, d.spec.chopping);
  if (!d.spec.sampled_in_middle) {
    const std::optional<Margins> m = margins(current_plant(winding, period_s), gains, period_s, true);
    return m ? std::optional(m->phase_rad) : std::nullopt;
  }
  const DriveLoops loops{.motor = d.motor,
                         .winding = winding,
                         .period_s = period_s,
                         .late_periods = d.spec.later_periods(),
                         .current = gains};
  constexpr int points = 256;  // this number of points suffices, because a PI loop's phase has no narrow
                               // features
  return loop_figures(open_current_loop(loops), period_s, points).phase_rad;
}

/// The longest period at which the same design rule gives a phase margin of 45 degrees with the longer of the
/// delays. Bisection is possible because the phase falls with the period.
double longest_period(const DriveDesign& d) {
  const auto holds = [&](double period_s) {
    DriveDesign at = d;
    at.spec.period_s = period_s;
    const base::Result<LoopDesign> loop = current_loop(at);
    if (!loop) return false;
    const std::optional<double> phase_rad = phase_left_rad(d, loop->gains, period_s);
    return phase_rad && *phase_rad >= base::pi / 4.0;
  };
  double low = 1e-9, high = 2e-9;
  while (holds(high) && high < 1.0) {
    low = high;
    high *= 2.0;
  }
  for (int n = 0; n < 40; ++n) {
    const double middle = low + (high - low) / 2.0;
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

/// The speed loop's crossover with its proportional gain only, rad/s; 0 without a speed loop.
double crossover_of(const DriveDesign& d) {
  if (d.loops.size() < 2) return 0.0;
  return speed_crossover_rad_s(d.loop("speed").gains.d1, d.torque_limit_Nm / d.motor.shaft.J_kg_m2);
}

SettlingQuestion settling_question(const DriveDesign& d) {
  return {loops_of(d, d.motor, d.spec.late_periods()), d.torque_limit_Nm, d.spec.damping};
}

/// Factor on the time of the step at the torque limit. The additional time is for the loop's settling after
/// the limit.
constexpr double times_of_torque = 1.5;

/// Chooses the default settling time: the thesis's time, or the longer limit by sensor or torque.
void choose_settling(DriveDesign& d) {
  if (d.spec.mode == Mode::speed)  // not for a move, which is at its limits most of the time for any settling
                                   // time of the loop
    d.settle_by_torque_s =
        times_of_torque * d.motor.shaft.J_kg_m2 * d.lowest_speed_rad_s / 2 / d.most_torque_Nm();
  if (d.spec.settle_s) return;
  double least = d.settle_by_torque_s;
  if (d.spec.rotor.lags())
    least = std::fmax(
        least, fastest_settling_s(settling_question(d), d.spec.rotor, d.lowest_speed_rad_s).value_or(least));
  d.spec.settle_s =
      least > usual_speed_settle_s ? base::shortened(least, 2, base::Towards::up) : usual_speed_settle_s;
}

/// A step of the measured speed causes a step of the torque command, d1 times the speed step. It is computed
/// at high speed: a tick of the timer is then a larger fraction of the measured time, and the speed itself is
/// larger.
void add_speed_step(DriveDesign& d, double crossover) {
  d.high_speed_rad_s =
      base::shortened(high_speed_part * std::fmax(d.headroom_end_rad_s, 0.0), 2, base::Towards::down);
  d.speed_step_rad_s =
      speed_step_rad_s(d.spec.rotor, d.motor.machine.pole_pairs, d.high_speed_rad_s, crossover);
  d.speed_step_part = std::fabs(d.loops[1].gains.d1) * d.speed_step_rad_s;
  d.speed_step_V = d.speed_step_part * d.current_at_full_torque_A * std::fabs(d.loops[0].gains.d1);
  d.high_speed_left_V = headroom_V(d.motor, d.bus_V, d.nominal_current_A / 2, d.high_speed_rad_s);
  if (!(d.speed_step_rad_s > 0.0)) return;
  d.sensing.push_back({"w_high", "0.9 of the speed where \"voltage left\" ends, rounded down to two digits",
                       d.high_speed_rad_s, "rad/s"});
  d.sensing.push_back(
      {"dw_high", "one step of the measured speed at this speed", d.speed_step_rad_s, "rad/s"});
  d.sensing.push_back({"d1 dw", "change of the torque reference by that step, as a part of the torque limit",
                       d.speed_step_part, ""});
  d.sensing.push_back({"du", "change of the voltage: d1 dw times T_max/K_t times the current loop's d1",
                       d.speed_step_V, "V"});
  d.sensing.push_back({"u_left", "remaining voltage of the bus at w_high and half the nominal current",
                       d.high_speed_left_V, "V"});
}

void add_sensing(DriveDesign& d) {
  if (!d.spec.rotor.lags() || d.loops.size() < 2) return;
  const double pole_pairs = d.motor.machine.pole_pairs, crossover = crossover_of(d);
  d.lag = speed_lag(d.spec.rotor, pole_pairs, d.lowest_speed_rad_s, crossover);
  d.sensing = lag_steps(d.spec.rotor, pole_pairs, d.lowest_speed_rad_s, crossover);
  add_speed_step(d, crossover);
  d.limits = settling_limits(settling_question(d), d.spec.rotor,
                             {.lowest = d.lowest_speed_rad_s, .highest = d.high_speed_rad_s});
}

/// Derivation for a P loop with counted edges: one step away from the setpoint it commands K_p (its gain)
/// steps per second.
void add_steps(DriveDesign& d) {
  if (!d.spec.rotor.hall || d.loops.size() < 3) return;
  std::erase_if(d.sensing, [](const DerivationStep& s) { return s.symbol == "q" || s.symbol == "1/K_p"; });
  const double gain = d.loops[2].gains.d1 * 180.0 / base::pi;
  d.sensing.push_back({"q", "60/p, a Hall step", 60.0 / d.motor.machine.pole_pairs, "deg"});
  d.sensing.push_back({"1/K_p", "time to the next edge, one step away from the target", 1.0 / gain, "s"});
}

void add_limits(DriveDesign& d) {
  d.ripple = worst_ripple(d.motor, d.bus_V, d.spec.period_s, d.spec.chopping);
  d.headroom_end_rad_s = speed_for_current_rad_s(d.motor, d.bus_V, d.nominal_current_A);
  d.braking_limit_rad_s = soft_braking_limit_rad_s(d.motor, d.nominal_current_A);
  d.commutation_limit_rad_s = commutation_limit_rad_s(d.motor, d.bus_V, d.nominal_current_A);
  d.longest_period_s = longest_period(d);
}

void finish(DriveDesign& d) {
  for (std::size_t n = 0; n < d.loops.size(); ++n) judge(d, d.loops[n], n);
  add_steps(d);
  d.warnings = warnings_of(d);
}

}  // namespace

double DriveDesign::most_current_A() const {
  return std::fmin(current_at_full_torque_A, spec.current_limit_A.value_or(current_at_full_torque_A));
}

double DriveDesign::most_torque_Nm() const {
  return std::fmin(torque_limit_Nm, motor.K_t_Nm_A * most_current_A());
}

double usual_current_settle_s_of(const MotorModel& m) {
  const double by_winding = winding_times * m.machine.L_H / m.machine.R_ohm;
  return by_winding < usual_current_settle_s ? base::shortened(by_winding, 2, base::Towards::down)
                                             : usual_current_settle_s;
}

void judge_loop(LoopDesign& loop, const Transfer& open, const Transfer& other, const SensedLoop& sensed,
                double period_s, double band) {
  loop.loop = open;
  loop.figures = loop_figures(open, period_s);
  loop.other = loop_figures(other, period_s);
  const bool lags = sensed.lag.delay_s() > 0.0;
  loop.built = lags ? sensed_figures(sensed, period_s) : loop.figures;
  if (!loop.built.stable) return;
  const Transfer whole = closed(open);
  const double watched = watched_s(whole, period_s);
  // The step of a position loop is determined by limits, not by the linear loop; it is not computed with the
  // sensor's lag.
  loop.step = lags && loop.name == "speed" ? sensed_step(sensed, period_s, 2 * watched, band)
                                           : step_response(whole, period_s, watched);
}

double settling_band(const DriveDesign& d) { return d.spec.rotor.hall && d.lag.delay_s() > 0.0 ? 0.1 : 0.02; }

double settling_band(const DriveDesign& d, const LoopDesign& loop) {
  return loop.name == "speed" ? settling_band(d) : 0.02;
}

const LoopDesign& DriveDesign::loop(std::string_view name) const {
  for (const LoopDesign& l : loops)
    if (l.name == name) return l;
  return loops.back();
}

base::Result<DriveDesign> design_drive(const MotorModel& motor, const DesignSpec& spec) {
  if (base::Problems found = check_spec(motor, spec); !found.empty()) return found;
  DriveDesign d;
  d.spec = spec;
  d.motor = motor;
  d.motor.shaft.J_kg_m2 += spec.load_inertia_kg_m2;
  d.bus_V = spec.voltage_V.value_or(motor.nominal_voltage_V);
  d.torque_limit_Nm = spec.torque_limit_Nm.value_or(usual_torque_limit_Nm(motor, d.bus_V));
  d.current_at_full_torque_A = d.torque_limit_Nm / motor.K_t_Nm_A;
  const NominalCurrent nominal = nominal_current(motor, d.bus_V);
  d.nominal_current_A = nominal.A;
  d.nominal_printed = nominal.printed;
  d.lowest_speed_rad_s = spec.lowest_speed_rad_s.value_or(
      base::shortened(0.1 * d.bus_V / motor.K_t_Nm_A, 2, base::Towards::down));
  base::Result<LoopDesign> current = current_loop(d);
  if (!current) return current.problems();
  d.loops.push_back(*current);
  if (spec.mode != Mode::current) {
    choose_settling(d);
    base::Result<LoopDesign> speed = speed_loop(d);
    if (!speed) return speed.problems();
    d.loops.push_back(*speed);
  }
  add_limits(d);
  add_sensing(d);
  if (spec.mode == Mode::position)
    d.loops.push_back(position_loop(largest_position_gain(d), "largest linear gain without overshoot",
                                    "largest gain without overshoot"));
  finish(d);
  return d;
}

DriveDesign with_position_gain(const DriveDesign& design, double gain_rad_s_per_deg) {
  DriveDesign d = design;
  d.loops.back() =
      position_loop(gain_rad_s_per_deg, "largest gain under the limits",
                    "largest gain whose overshoot is at most 1 % of the move or three sensor steps");
  finish(d);
  return d;
}

std::vector<Transfer> open_loops(const DriveDesign& design, const MotorModel& motor, double late_periods) {
  const DriveLoops loops = loops_of(design, motor, late_periods);
  std::vector<Transfer> out{open_current_loop(loops)};
  if (design.loops.size() > 1) out.push_back(open_speed_loop(loops));
  if (design.loops.size() > 2) out.push_back(open_position_loop(loops));
  return out;
}

std::vector<SensedLoop> sensed_loops(const DriveDesign& design, const MotorModel& motor,
                                     double late_periods) {
  const std::vector<Transfer> open = open_loops(design, motor, late_periods);
  std::vector<SensedLoop> out{{open[0], {}, {}}};
  if (open.size() > 1) out.push_back({open[1], design.lag, {}});
  if (open.size() > 2) out.push_back({open[2], design.lag, open[1]});
  return out;
}

}  // namespace sixstep::design
