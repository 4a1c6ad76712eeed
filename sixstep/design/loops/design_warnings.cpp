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

/// Three digits say what a warning needs.
std::string milliseconds(double s) { return base::three_digits(s * 1e3) + " ms"; }
std::string microseconds(double s) { return base::three_digits(s * 1e6) + " us"; }

struct Collector {
  std::vector<Warning> found;
  void add(std::string what, std::string cure, bool grave = false) {
    found.push_back({std::move(what), std::move(cure), grave});
  }
};

/// The figures with a delay of one period, whichever of the two that is.
const LoopFigures& delayed(const DriveDesign& d, const LoopDesign& loop) {
  return d.spec.delay_periods == 1 ? loop.figures : loop.other;
}

std::string slower(const DriveDesign& d, const LoopDesign& loop) {
  if (loop.name == "position") return "lower the position gain";
  std::string text = loop.name == "current" && d.spec.mode != control::Mode::current ? "current_settle_s"
                     : d.spec.bandwidth_rad_s                                        ? "bandwidth_rad_s"
                                                                                     : "settle_s";
  return "design the " + loop.name + " loop slower (" + text + ")";
}

void look_at_stability(const DriveDesign& d, const LoopDesign& loop, Collector& out) {
  if (!loop.figures.stable)
    return out.add("the " + loop.name + " loop is unstable", slower(d, loop) + " or shorten period_s", true);
  const LoopFigures& late = delayed(d, loop);
  if (!late.stable)
    return out.add("the " + loop.name + " loop is unstable where its command counts one period late",
                   slower(d, loop) + ", or keep period_s below " + microseconds(d.longest_period_s));
  const double phase_deg = late.phase_rad.value_or(base::pi) * 180.0 / base::pi;
  const std::string cure = loop.name == "current" ? slower(d, loop) + ", or keep period_s below " +
                                                        microseconds(d.longest_period_s)
                                                  : slower(d, loop);
  if (phase_deg < least_phase_deg)
    out.add("with one period of delay the " + loop.name + " loop keeps " + base::three_digits(phase_deg) +
                " degrees of phase, less than " + base::three_digits(least_phase_deg),
            cure);
  else if (late.sensitivity_peak > greatest_sensitivity)
    out.add("with one period of delay the " + loop.name + " loop amplifies disturbances up to " +
                base::three_digits(late.sensitivity_peak) + " times",
            cure);
}

/// What the sensor of the speed leaves of the phase, at the lowest speed.
void look_at_sensing(const DriveDesign& d, Collector& out) {
  if (d.loops.size() < 2 || !(d.lag.delay_s() > 0.0)) return;
  const LoopDesign& speed = d.loops[1];
  if (!speed.figures.stable) return;  // told already
  const bool shaft = d.spec.rotor.shaft.kind != ShaftSensorKind::none;
  const std::string at = " at " + base::three_digits(d.lowest_speed_rad_s) + " rad/s, where a speed from " +
                         (shaft ? "the " + edges_words(d.spec.rotor) : std::string("Hall edges")) + " is " +
                         milliseconds(d.lag.delay_s()) + " old";
  std::string cure = "design the speed loop slower (settle_s";
  for (const SettlingLimit& limit : d.limits)
    if (limit.sensing.edges == d.spec.rotor.edges && limit.lowest_speed_rad_s == d.lowest_speed_rad_s &&
        limit.settle_s)
      cure.append(" ").append(base::three_digits(*limit.settle_s));
  cure += d.spec.rotor.edges > 1 ? "), take the speed over one edge (edges = 1), or raise lowest_speed_rad_s"
                                 : ") or raise lowest_speed_rad_s";
  if (!speed.built.stable) return out.add("the speed loop is unstable" + at, cure, true);
  const double phase_deg = speed.built.phase_rad.value_or(base::pi) * 180.0 / base::pi;
  // A tenth of a degree: what rounding a settling time may cost.
  if (phase_deg < least_phase_deg - 0.1)
    out.add("the speed loop keeps " + base::three_digits(phase_deg) + " degrees of phase" + at, cure);
}

/// A P loop on counted edges: one step away it asks for K_p steps per second, so the next edge is 1/K_p away
/// and the speed as old.
void look_at_steps(const DriveDesign& d, Collector& out) {
  if (d.spec.mode != control::Mode::position || !d.spec.rotor.hall || d.loops.size() < 3) return;
  const double blind_s = 1.0 / (d.loops[2].gains.d1 * 180.0 / base::pi);
  const base::LinearUnit deg = motion_of(d.motor).unit("deg");
  const std::string step = base::three_digits(60.0 / d.motor.machine.pole_pairs * deg.factor) +
                           (d.motor.kind == MotorKind::linear ? " mm" : " degrees");
  if (const std::optional<double> stands = d.loops[1].figures.delay_s; stands && blind_s > *stands)
    out.add("within a Hall step of " + step + " of its target the drive learns its speed every " +
                milliseconds(blind_s) + " (1/K_p), and the speed loop stands " + milliseconds(*stands) +
                ": it comes to within a few steps and never rests",
            "take an encoder where the shaft is to rest; or turn the drive off once it is there");
}

void look_at_sign(const DriveDesign& d, const LoopDesign& loop, Collector& out) {
  if (loop.gains.d1 <= 0.0 && loop.name == "current")
    out.add("the current loop is asked to be slower than the motor's own L/R, " +
                milliseconds(d.motor.machine.L_H / d.motor.machine.R_ohm) +
                ": its proportional gain is negative",
            "ask for a shorter settle_s, or take method = cancellation");
}

void look_at_overshoot(const LoopDesign& loop, Collector& out) {
  if (loop.name != "position" && loop.figures.stable && loop.step.overshoot > 0.1)
    out.add("the " + loop.name + " loop overshoots a step by " +
                base::three_digits(100.0 * loop.step.overshoot) + " %, for the PI's zero" +
                (loop.built.phase_rad != loop.figures.phase_rad ? " and the delay of its sensor" : ""),
            loop.name == "current" ? "give method = cancellation, or limit how fast the setpoint rises"
                                   : "limit how fast the setpoint rises (control/slew.hpp)");
}

void look_at_separation(const LoopDesign& inner, const LoopDesign& outer, Collector& out) {
  if (!inner.figures.crossover_rad_s || !outer.figures.crossover_rad_s) return;
  const double ratio = *inner.figures.crossover_rad_s / *outer.figures.crossover_rad_s;
  if (ratio < least_separation)
    out.add("the " + inner.name + " loop crosses over at only " + base::three_digits(ratio) +
                " times the frequency of the " + outer.name + " loop",
            "make the " + outer.name + " loop slower or the " + inner.name + " loop faster until it is " +
                base::three_digits(least_separation) + " times");
}

void look_at_ripple(const DriveDesign& d, Collector& out) {
  if (d.ripple.worst_A > greatest_ripple * d.nominal_current_A) {
    const double period_s =
        period_for_ripple_s(d.motor, d.bus_V, d.spec.chopping, greatest_ripple * d.nominal_current_A);
    out.add("the PWM ripple reaches " + base::three_digits(d.ripple.worst_A) + " A, " +
                base::three_digits(100.0 * d.ripple.worst_A / d.nominal_current_A) + " % of " +
                nominal_current_words(d),
            "keep period_s below " + microseconds(period_s) +
                (d.spec.chopping == control::Chopping::hard ? ", or chop softly" : ", or add inductance"));
  }
}

void look_at_braking(const DriveDesign& d, Collector& out) {
  const double top =
      d.motor.no_load_speed_rad_s > 0.0 ? d.motor.no_load_speed_rad_s : d.bus_V / d.motor.K_t_Nm_A;
  if (d.spec.chopping == control::Chopping::soft && d.braking_limit_rad_s < top)
    out.add("soft chopping cannot hold a braking current of " + base::three_digits(d.nominal_current_A) +
                " A" + (d.nominal_printed ? "" : std::string(", ") + nominal_current_words(d) + ",") +
                " above " + base::three_digits(d.braking_limit_rad_s) +
                " rad/s, (i/K_t) R: the motor brakes through the lower switches",
            "brake with chopping = complementary or hard, or smooth_chopping.hpp on the chip");
}

/// The first command of a step of the nominal current is d1 i.
void look_at_voltage(const DriveDesign& d, Collector& out) {
  const double first_V = d.loops[0].gains.d1 * d.nominal_current_A;
  if (first_V > d.bus_V)
    out.add("a step of " + std::string(nominal_current_words(d)) + " asks for " +
                base::three_digits(first_V) + " V at once, the bus has " + base::three_digits(d.bus_V) +
                " V: it settles later than designed",
            slower(d, d.loops[0]) + " or raise voltage_V");
  if (d.headroom_end_rad_s <= 0.0)
    out.add("the bus cannot drive " + std::string(nominal_current_words(d)) + " even through the held rotor",
            "raise voltage_V", true);
}

void look_at_settling(const DriveDesign& d, const LoopDesign& loop, Collector& out) {
  if (!loop.placed || !loop.figures.stable) return;
  if (loop.placed->settle_s < 10.0 * d.spec.period_s)
    out.add("the " + loop.name + " loop is to settle within " + milliseconds(loop.placed->settle_s) + ", " +
                base::three_digits(loop.placed->settle_s / d.spec.period_s) + " control periods",
            slower(d, loop) + " or shorten period_s to a tenth");
}

void look_at_heat(const DriveDesign& d, Collector& out) {
  if (d.spec.mode == control::Mode::current) return;
  if (!d.nominal_printed)
    return out.add(
        "the sheet names no nominal current: a tenth of the stall current, " +
            base::three_digits(d.nominal_current_A) + " A, stands in for it",
        "give the sheet's nominal_current_A, or torque_limit_Nm with what bridge and winding bear");
  if (d.current_at_full_torque_A > 3.0 * d.nominal_current_A)
    out.add("the speed loop may ask for " + base::three_digits(d.current_at_full_torque_A) + " A, " +
                base::three_digits(d.current_at_full_torque_A / d.nominal_current_A) +
                " times the nominal current",
            "give torque_limit_Nm what bridge, winding and load bear");
}

}  // namespace

std::vector<Warning> warnings_of(const DriveDesign& d) {
  Collector out;
  for (const LoopDesign& loop : d.loops) {
    look_at_stability(d, loop, out);
    look_at_settling(d, loop, out);
    look_at_sign(d, loop, out);
    look_at_overshoot(loop, out);
  }
  // A position gain is bounded by the overshoot itself.
  if (d.loops.size() > 1) look_at_separation(d.loops[0], d.loops[1], out);
  look_at_sensing(d, out);
  look_at_steps(d, out);
  look_at_voltage(d, out);
  look_at_ripple(d, out);
  look_at_braking(d, out);
  look_at_heat(d, out);
  if (!d.motor.left_to_a_run.empty())
    out.add("this design leaves out " + d.motor.left_to_a_run + ", which a run has",
            "hold it to a run of your scenario");
  return out.found;
}

}  // namespace sixstep::design
