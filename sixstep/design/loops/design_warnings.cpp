// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/design_warnings.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/motion.hpp"

namespace sixstep::design {
namespace {

/// A number times 1000 with three digits, as used in warnings.
std::string milli(double x) { return base::three_digits(x * 1e3); }
std::string milliseconds(double s) { return milli(s) + " ms"; }

struct Collector {
  std::vector<Warning> found;
  void add(Concern of, std::string what, bool grave = false, std::string cure = "") {
    found.push_back({.what = std::move(what), .cure = std::move(cure), .grave = grave, .of = of});
  }
};

/// Text for the bound that the phase margin does not reach: ", less than 20" if the loop is not usable, else
/// ", less than 45".
std::string below_bound(double phase_deg) {
  return ", less than " +
         base::three_digits(phase_deg < unusable_phase_deg ? unusable_phase_deg : least_phase_deg);
}

void look_at_stability(const DriveDesign& d, const LoopDesign& loop, Collector& out) {
  if (!loop.figures.stable)
    return out.add(Concern::stability, "the " + loop.name + " loop is unstable", true);
  // The figures are computed with the drive's own delay; only the table shows the effect of another board's
  // delay.
  const double late = d.spec.late_periods();
  const std::string with = late > 0.0 ? "with " + periods_words(late) + " of delay the " : "the ";
  const double phase_deg = loop.figures.phase_rad.value_or(base::pi) * 180.0 / base::pi;
  if (phase_deg < least_phase_deg)
    out.add(Concern::delay,
            with + loop.name + " loop has a phase margin of " + base::three_digits(phase_deg) + " degrees" +
                below_bound(phase_deg),
            phase_deg < unusable_phase_deg);
  else if (loop.figures.sensitivity_peak > greatest_sensitivity)
    out.add(Concern::delay, with + loop.name + " loop amplifies disturbances up to " +
                                base::three_digits(loop.figures.sensitivity_peak) + " times");
}

/// Checks the phase margin with the lag of the speed's sensor at the lowest speed.
void look_at_sensing(const DriveDesign& d, Collector& out) {
  if (d.loops.size() < 2 || !(d.lag.delay_s() > 0.0)) return;
  const LoopDesign& speed = d.loops[1];
  if (!speed.figures.stable) return;  // already reported
  const bool shaft = d.spec.rotor.shaft.kind != ShaftSensorKind::none;
  const std::string at = " at " + base::three_digits(d.lowest_speed_rad_s) + " rad/s, where a speed from " +
                         (shaft ? "the " + edges_words(d.spec.rotor) : std::string("Hall edges")) + " is " +
                         milliseconds(d.lag.delay_s()) + " old";
  if (!speed.built.stable) return out.add(Concern::sensing, "the speed loop is unstable" + at, true);
  const double phase_deg = speed.built.phase_rad.value_or(base::pi) * 180.0 / base::pi;
  // Rounding of a settling time may reduce the phase margin by a tenth of a degree.
  if (phase_deg < least_phase_deg - 0.1)
    out.add(Concern::sensing,
            "the speed loop has a phase margin of " + base::three_digits(phase_deg) + " degrees" +
                below_bound(phase_deg) + "," + at,
            phase_deg < unusable_phase_deg);
}

/// Warns of a coarse measured speed, in speed mode only: a position drive's speed depends on the move, and
/// only a run can show the effect.
void look_at_grain(const DriveDesign& d, Collector& out) {
  if (!is_grainy(d)) return;
  out.add(Concern::grain,
          "at " + base::three_digits(d.high_speed_rad_s) + " rad/s one step of the measured speed is " +
              base::three_digits(d.speed_step_rad_s) + " rad/s. Each step changes the torque reference by " +
              base::rounded(100.0 * d.speed_step_part, 3) + " % of the torque limit, and the voltage by " +
              base::three_digits(d.speed_step_V) + " V; the bus has " +
              base::three_digits(std::fmax(d.high_speed_left_V, 0.0)) + " V left");
}

/// Warns of a position loop on counted edges. The loop is a P loop with the gain K_p: one step away from the
/// setpoint it commands K_p steps per second. The next edge follows after the time 1/K_p, and the age of the
/// measured speed grows to this time.
void look_at_steps(const DriveDesign& d, Collector& out) {
  if (d.spec.mode != control::Mode::position || !d.spec.rotor.hall || d.loops.size() < 3) return;
  const double blind_s = 1.0 / (d.loops[2].gains.d1 * 180.0 / base::pi);
  const base::LinearUnit deg = motion_of(d.motor).unit("deg");
  const std::string step = base::three_digits(60.0 / d.motor.machine.pole_pairs * deg.factor) +
                           (d.motor.kind == MotorKind::linear ? " mm" : " degrees");
  if (const std::optional<double> stands = d.loops[1].figures.delay_s; stands && blind_s > *stands)
    out.add(Concern::rest, "within one Hall step (" + step +
                               ") of the target the drive measures its speed only every " +
                               milliseconds(blind_s) + " (1/K_p), later than the " + milliseconds(*stands) +
                               " that the speed loop tolerates: the rotor never comes to rest");
}

void look_at_sign(const DriveDesign& d, const LoopDesign& loop, Collector& out) {
  if (loop.gains.d1 <= 0.0 && loop.name == "current")
    out.add(Concern::sign, "the current loop is designed to be slower than the motor's own L/R, " +
                               milliseconds(d.motor.machine.L_H / d.motor.machine.R_ohm) +
                               ", which makes the proportional gain negative");
}

void look_at_overshoot(const LoopDesign& loop, Collector& out) {
  // A loop that the lag of its sensor makes unstable has no step response.
  if (loop.name != "position" && loop.figures.stable && loop.built.stable && loop.step.overshoot > 0.1)
    out.add(Concern::overshoot,
            "the " + loop.name + " loop overshoots a step by " +
                base::three_digits(100.0 * loop.step.overshoot) + " %, because of the zero of its PI" +
                (loop.built.phase_rad != loop.figures.phase_rad ? " and the delay of its sensor" : ""));
}

void look_at_separation(const LoopDesign& inner, const LoopDesign& outer, Collector& out) {
  if (!inner.figures.crossover_rad_s || !outer.figures.crossover_rad_s) return;
  const double ratio = *inner.figures.crossover_rad_s / *outer.figures.crossover_rad_s;
  if (ratio < least_separation)
    out.add(Concern::separation, "the " + inner.name + " loop crosses over at only " +
                                     base::three_digits(ratio) + " times the frequency of the " + outer.name +
                                     " loop, less than " + base::three_digits(least_separation));
}

/// A ripple above the nominal current is grave. Below half of the nominal current, the current is
/// discontinuous or reverses in each period. At the nominal current, the peak exceeds the mean by more than
/// 50 %, and the copper loss is larger by a twelfth.
void look_at_ripple(const DriveDesign& d, Collector& out) {
  const double allowed_A = greatest_ripple * d.nominal_current_A;
  if (!(d.ripple.worst_A > allowed_A)) return;
  const bool grave = d.ripple.worst_A > d.nominal_current_A;
  std::string what = "the PWM ripple reaches " + base::three_digits(d.ripple.worst_A) + " A, " +
                     base::rounded(100.0 * d.ripple.worst_A / d.nominal_current_A, 4) + " % of " +
                     nominal_current_words(d);
  // The period with the allowed ripple is proportional to L, also if L/R is not long compared with the
  // period.
  const double allowed_s = period_for_ripple_s(d.motor, d.bus_V, d.spec.chopping, allowed_A);
  if (grave)
    what += "; a choke of " + milli((d.spec.period_s / allowed_s - 1) * d.motor.machine.L_H) +
            " mH in each motor lead reduces the ripple to " + base::three_digits(100 * greatest_ripple) +
            (d.nominal_printed ? " % of the nominal current" : " % of this current");
  out.add(Concern::ripple, std::move(what), grave);
}

void look_at_braking(const DriveDesign& d, Collector& out) {
  const double top =
      d.motor.no_load_speed_rad_s > 0.0 ? d.motor.no_load_speed_rad_s : d.bus_V / d.motor.K_t_Nm_A;
  if (d.spec.chopping == control::Chopping::soft && d.braking_limit_rad_s < top)
    out.add(
        Concern::braking,
        "soft chopping cannot limit the braking current of " + base::three_digits(d.nominal_current_A) +
            " A" + (d.nominal_printed ? "" : std::string(", ") + nominal_current_words(d) + ",") + " above " +
            base::three_digits(d.braking_limit_rad_s) +
            " rad/s, i R_tt/K_t (i: this current, R_tt: line-to-line resistance, K_t: torque constant): above this speed the lower switches short the motor, and the current is larger");
}

/// Checks the voltage that a step needs: the first command after a step of the nominal current i is d1 i,
/// with the controller's gain d1.
void look_at_voltage(const DriveDesign& d, Collector& out) {
  const double first_V = d.loops[0].gains.d1 * d.nominal_current_A;
  if (first_V > d.bus_V)
    out.add(Concern::voltage, "a step of " + std::string(nominal_current_words(d)) + " needs " +
                                  base::three_digits(first_V) + " V at once, but the bus has only " +
                                  base::three_digits(d.bus_V) +
                                  " V, so the current settles later than designed");
  if (d.headroom_end_rad_s <= 0.0)
    out.add(Concern::voltage,
            "the bus cannot drive " + std::string(nominal_current_words(d)) + " even through the held rotor",
            true);
}

void look_at_settling(const DriveDesign& d, const LoopDesign& loop, Collector& out) {
  if (!loop.placed || !loop.figures.stable) return;
  if (loop.placed->settle_s < 10.0 * d.spec.period_s)
    out.add(Concern::pace, "the " + loop.name + " loop is designed to settle within " +
                               milliseconds(loop.placed->settle_s) + ", " +
                               base::three_digits(loop.placed->settle_s / d.spec.period_s) +
                               " control periods, fewer than ten");
}

void look_at_heat(const DriveDesign& d, Collector& out) {
  const bool current = d.spec.mode == control::Mode::current;
  if (!d.nominal_printed) {
    if (current || !d.spec.torque_limit_Nm)
      out.add(
          Concern::heat,
          "the sheet names no nominal current: a tenth of the stall current, " +
              base::three_digits(d.nominal_current_A) + " A, is used instead",
          false,
          current
              ? "give nominal_current_A in the motor file"
              : "give nominal_current_A in the motor file, or a torque_limit_Nm that bridge and winding withstand");
    return;
  }
  const double most_A = d.most_current_A();
  if (!current && most_A > greatest_overload * d.nominal_current_A)
    out.add(Concern::heat, "the speed loop may command " + base::three_digits(most_A) + " A, " +
                               base::three_digits(most_A / d.nominal_current_A) +
                               " times the nominal current");
}

}  // namespace

bool is_grainy(const DriveDesign& d) {
  return d.spec.mode == control::Mode::speed && d.speed_step_rad_s > 0.0 &&
         (d.speed_step_part > greatest_speed_step || d.speed_step_V > d.high_speed_left_V);
}

std::vector<Warning> warnings_of(const DriveDesign& d) {
  Collector out;
  for (const LoopDesign& loop : d.loops) {
    look_at_stability(d, loop, out);
    look_at_settling(d, loop, out);
    look_at_sign(d, loop, out);
    look_at_overshoot(loop, out);
  }
  // The position loop is not checked here: its gain is chosen for a response without overshoot.
  if (d.loops.size() > 1) look_at_separation(d.loops[0], d.loops[1], out);
  look_at_sensing(d, out);
  look_at_grain(d, out);
  look_at_steps(d, out);
  look_at_voltage(d, out);
  look_at_ripple(d, out);
  look_at_braking(d, out);
  look_at_heat(d, out);
  if (!d.motor.left_to_a_run.empty())
    out.add(Concern::other, "this design neglects " + d.motor.left_to_a_run + ", which a run simulates",
            false, "check the design by a run of your scenario");
  return out.found;
}

}  // namespace sixstep::design
