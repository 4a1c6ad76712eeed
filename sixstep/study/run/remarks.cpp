// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/remarks.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/linear.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/thermal_ranges.hpp"
#include "sixstep/study/check/unused_keys.hpp"
#include "sixstep/study/compile/pulse.hpp"
#include "sixstep/study/run/belief_costs.hpp"
#include "sixstep/study/run/commutation_remarks.hpp"
#include "sixstep/study/run/export_notes.hpp"
#include "sixstep/study/run/export_protection.hpp"
#include "sixstep/study/run/limit_remarks.hpp"
#include "sixstep/study/run/loop_stability.hpp"
#include "sixstep/study/run/low_side_limits.hpp"
#include "sixstep/study/run/thermal_remarks.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"

namespace sixstep::study {

namespace {

/// Usual limit of a junction, degC: data sheets of silicon switches print 150 or 175.
constexpr double usual_junction_limit_degC = 150.0;
/// Least number of control periods in a commutation step. With fewer, the current is controlled only a few
/// times per step.
constexpr double least_periods_per_step = 5.0;
/// A remark follows if more than this fraction of the shunt's samples lies outside of the pulse.
constexpr double hidden_part = 0.01;

std::string speed(const Scenario& s, double rad_s) {
  return few_digits(rad_s) + (s.sheet.kind == design::MotorKind::linear ? " m/s" : " rad/s");
}
std::string ms(double t_s) { return few_digits(1e3 * t_s) + " ms"; }
std::string us(double t_s) { return few_digits(1e6 * t_s) + " us"; }

/// Compares a bus voltage that equals its default with the motor's nominal voltage.
std::string on_supply(const Scenario& s) {
  const auto& nominal = s.sheet.nominal_voltage_V;
  const double usual_V = Supply{}.voltage_V;
  if (s.supply.source != SourceKind::steady || s.supply.voltage_V != usual_V || !nominal ||
      std::fabs(nominal->value - usual_V) < 0.1 * usual_V)
    return {};
  return "the bus is at supply.voltage_V = " + few_digits(usual_V) +
         " V, its default, but the motor's nominal voltage is " + few_digits(nominal->value) + " V";
}

/// Finds values of the reference after the run's end. With linear interpolation the first of these values is
/// still used: the run's last instant lies on the line to it.
std::string on_late_values(const Scenario& s) {
  const Reference& r = s.reference;
  if (r.shape != Shape::csv || s.control.mode == control::Mode::off) return {};  // check() refuses late steps
  const auto behind =
      std::count_if(r.times_s.begin(), r.times_s.end(), [&s](double t) { return t > s.duration_s; });
  const auto unreached = behind - (r.interpolation == Interpolation::linear ? 1 : 0);
  if (unreached < 1) return {};
  return std::to_string(unreached) + " of the " + std::to_string(r.times_s.size()) +
         " values of the reference are after the end of the run, duration_s = " + few_digits(s.duration_s) +
         ": the run does not use these values" +
         (r.file.empty() ? "" : "; check the unit of the times: without a unit they are in s");
}

/// Time between two sector edges.
double sector_s(const Compiled& c, double rad_s) {
  return base::pi / 3 / (c.motor.machine.pole_pairs * rad_s);
}

/// Finds a shunt amplifier that is too slow. With one pole at current_bandwidth_Hz, f, it has reached 1 -
/// exp(-2 pi f t) of the current after t = shunt_settle_s, the end of the shortest measured pulse.
std::string on_shunt_amplifier(const Scenario& s) {
  constexpr double enough = 0.9;
  const bool shunts = s.sensors.currents == rig::CurrentMeasurement::dc_link ||
                      s.sensors.currents == rig::CurrentMeasurement::low_side;
  if (!shunts || !s.sensors.current_bandwidth_Hz) return {};
  const double rate = 2 * base::pi * *s.sensors.current_bandwidth_Hz;
  const double shown = 1 - base::exp(-rate * s.sensors.shunt_settle_s);
  if (shown >= enough) return {};
  return "after sensors.shunt_settle_s = " + us(s.sensors.shunt_settle_s) +
         " of a pulse the current sensor shows " + few_digits(100 * shown) +
         " % of the current (sensors.current_bandwidth_Hz = " + few_digits(*s.sensors.current_bandwidth_Hz) +
         "), so that the true current is larger; after " + few_digits(1e6 * std::log(10.0) / rate) +
         " us the sensor shows 90 %";
}

/// Finds samples that the drive uses although the shunt does not show the current yet. The drive computes the
/// least duty from shunt_settle_s and the dead time only. For duties between this computed least duty and the
/// real least duty the drive reads 0 A.
std::string on_samples_taken_too_soon(const Scenario& s, double shown_duty) {
  const double taken_duty = least_visible_duty(s);
  if (!(shown_duty > taken_duty * (1 + 1e-9))) return {};
  const bool centre = s.pwm.alignment == Alignment::centre;
  const double settle_s = (centre ? shown_duty / 2 : shown_duty - 0.5) * s.pwm.period_s - pulse_late_s(s);
  return "; from a duty of " + few_digits(taken_duty) +
         " on the drive uses such samples as the current; set sensors.shunt_settle_s = " +
         few_digits(1e6 * base::shortened(settle_s * (1 - 1e-9), 3, base::Towards::up)) + " us";
}

std::string on_shunt(const Scenario& s, const Compiled& c, const RunWatch& w) {
  if (static_cast<double>(w.hidden_samples) <= hidden_part * static_cast<double>(w.samples)) return {};
  std::string hidden_by = "sensors.shunt_settle_s = " + us(s.sensors.shunt_settle_s);
  if (s.sensors.current_delay_s > 0.0)
    hidden_by += ", sensors.current_delay_s = " + us(s.sensors.current_delay_s);
  if (pulse_late_s(s) > 0.0) hidden_by += ", bridge.dead_time_s = " + us(s.bridge.dead_time_s);
  if (s.pwm.minimum_pulse_s > 0.0) hidden_by += ", pwm.minimum_pulse_s = " + us(s.pwm.minimum_pulse_s);
  if (w.shunt_least_duty >= 1.0)
    return "the shunt shows no current at all: no pulse lasts long enough for its sample (" + hidden_by + ")";
  std::string text =
      std::to_string(w.hidden_samples) + " of " + std::to_string(w.samples) +
      " current samples fell outside of the pulse: the shunt shows a current only above a duty of " +
      few_digits(w.shunt_least_duty) + " (" + hidden_by + ")";
  const double unseen_A = unseen_at_rest_A(s, c.motor.machine.R_ohm);
  if (unseen_A > 0.0)
    text +=
        "; at standstill this duty gives " + few_digits(unseen_A) + " A: smaller currents are not measured";
  return text + on_samples_taken_too_soon(s, w.shunt_least_duty);
}

/// The smallest reference speed other than 0.
double slowest_reference(const Scenario& s) {
  double slowest = 0.0;
  for (const Level& level : reference_levels(s)) {
    const double asked = std::fabs(level.value);
    if (asked > 0.0 && (slowest == 0.0 || asked < slowest)) slowest = asked;
  }
  return slowest;
}

std::string on_hall_timeout(const Scenario& s, const Compiled& c) {
  if (s.control.mode != control::Mode::speed || s.sensors.rotor != RotorSensing::hall) return {};
  const double asked = slowest_reference(s);
  if (asked == 0.0 || sector_s(c, asked) <= s.sensors.timeout_s) return {};
  return "at the reference of " + speed(s, asked) + " a Hall edge comes every " + ms(sector_s(c, asked)) +
         ", longer than sensors.timeout_s = " + ms(s.sensors.timeout_s) +
         ": between two edges the drive measures the speed 0; the slowest measurable speed is " +
         speed(s, sector_s(c, 1.0) / s.sensors.timeout_s);
}

std::string on_gains(const LoopGains& g, const std::string& key, double period_s) {
  const double ki = g.d1 + g.d0;
  if (g.origin != "given as kp, ki" || !(ki > g.d1 && g.d1 > 0.0)) return {};
  return key + ".ki = " + base::six_digits(ki) + " adds " + few_digits(ki / g.d1) +
         " times kp in each sample; if this gain is per second, as in other tools, set ki_per_s = " +
         base::six_digits(ki) + ", which is ki = " + base::six_digits(ki * period_s);
}

/// Pole placement results in a negative gain if the requested poles are slower than the plant's pole: the
/// loop must then slow the plant down.
std::string on_sign(const LoopGains& g, const std::string& key) {
  if (!(g.d1 < 0.0) || g.origin.starts_with("given")) return {};
  return "the " + g.loop + " loop's gain on the error is negative, d1 = " + few_digits(g.d1) +
         ": at a step the output first moves in the wrong direction, because " + key +
         ".settle_s is slower than the plant itself; set a shorter settle_s";
}

std::string on_stability(const Scenario& s, const Compiled& c, const LoopGains& g) {
  const std::optional<base::Problem> p = unstable_current_loop(s, c.motor, g);
  return p ? p->where + " " + p->limit + "; " + p->cure : "";
}

/// The largest back-EMF between two terminals per speed, V s/rad.
double line_peak_V_s(const Compiled& c) {
  const bool sine = c.motor.machine.back_emf == plant::BackEmf::sine;
  return c.motor.machine.K_e_V_s * (sine ? std::sqrt(3.0) : 2.0);
}

std::string on_back_emf(const Scenario& s, const Compiled& c, const RunWatch& w) {
  const double emf_V = line_peak_V_s(c) * w.emf_rad_s;
  if (!(emf_V > 1.01 * w.emf_bus_V)) return {};
  return "at " + speed(s, w.emf_rad_s) + " the back-EMF of " + few_digits(emf_V) +
         " V between two terminals is above the bus of " + few_digits(w.emf_bus_V) +
         " V: without a current against the magnet the diodes feed the bus at every duty";
}

/// Finds a winding that stays below its limit with the motor file's thermal values, but may exceed it within
/// the tolerances of these values.
std::string on_worse_ends(const Scenario& s, const RunWatch& w) {
  const auto model = design::thermal_model(s.sheet);
  const auto worse = design::at_worse_ends(s.sheet);
  if (!model || !worse) return {};
  const double start = s.heat.winding_degC.value_or(s.heat.ambient_degC);
  const double rise = design::greater_rise(*model, worse->model) * (w.winding_degC - start);
  if (!(start + rise > worse->model.max_winding_degC)) return {};
  return "the winding stayed below " + few_digits(model->max_winding_degC) +
         " degC with the thermal values of the motor file, but may exceed this limit with the worse ends of the thermal ranges; repeat the run with [motor_override] " +
         worse->values;
}

std::string on_heat(const Scenario& s, const RunWatch& w, const Outcome& out) {
  std::string text;
  const auto& limit = s.sheet.max_winding_temperature_degC;
  if (s.heat.motor && limit && w.winding_degC > limit->value)
    text = "the winding reached " + few_digits(w.winding_degC) + " degC, and the motor's sheet allows " +
           few_digits(limit->value) + " degC";
  else if (s.heat.motor && limit)
    text = on_worse_ends(s, w);
  double junction = s.heat.devices ? w.junction_degC : 0.0;
  for (const DeviceLoss& device : out.devices) junction = std::fmax(junction, device.junction_degC);
  if (junction > usual_junction_limit_degC)
    text += (text.empty() ? "" : "; ") + ("a switch's junction reached " + few_digits(junction)) +
            " degC, and most switches are rated for 150 or 175 degC";
  return text;
}

std::string on_steps(const Scenario& s, const Compiled& c, const RunWatch& w) {
  // A field-oriented drive has no commutation steps.
  if (s.control.mode == control::Mode::off || s.control.drive == FirmwareKind::field ||
      w.fastest_rad_s == 0.0)
    return {};
  const double periods = sector_s(c, w.fastest_rad_s) / s.pwm.period_s;
  if (periods >= least_periods_per_step) return {};
  return "at " + speed(s, w.fastest_rad_s) + " a commutation step lasts " + few_digits(periods) +
         " control periods, fewer than five; a shorter pwm.period_s gives more samples in a step";
}

void on_protection(const Scenario& s, const Compiled& c, Outcome& out) {
  base::Problems found;
  if (s.control.drive == FirmwareKind::product) look_at_protection(s, c.motor, found);
  const bool stalled =
      out.trip && std::count(out.trip->reasons.begin(), out.trip->reasons.end(), "stall") > 0;
  for (const base::Problem& p : found)
    if (!(stalled && p.where == "protection.stall_current_A")) out.remarks.push_back(to_string(p));
}

/// After a trip of the drive, a constant load torque still acts and turns the coasting rotor.
std::string on_load_after_trip(const Scenario& s, const Outcome& out) {
  if (!out.trip || s.load.locked || s.load.torque_Nm == 0.0) return {};
  return "after the trip load.torque_Nm = " + base::six_digits(s.load.torque_Nm) +
         " turns the shaft, as a hanging weight does; for a load that only brakes use load.coulomb_Nm";
}

/// Adds remarks on loops and samples. A user's controller gets none of them, because its loops are unknown.
void add_loop_remarks(const Scenario& s, const Compiled& c, const RunWatch& w, Outcome& out) {
  const auto add = [&out](std::string text) {
    if (!text.empty()) out.remarks.push_back(std::move(text));
  };
  add(on_shunt(s, c, w));
  add(on_shunt_amplifier(s));
  add(on_hall_timeout(s, c));
  for (const LoopGains& g : out.gains) {
    const std::string key = g.loop == "speed" ? "control.speed" : "control.current";
    add(on_gains(g, key, s.pwm.period_s));
    add(on_sign(g, key));
    add(on_stability(s, c, g));
  }
  add(on_back_emf(s, c, w));
  add(on_steps(s, c, w));
  add(on_idle_duty_step(s, w));
  add(on_chopped_staying_leg(s, w));
  add(on_long_overlap(s, c.motor, c.drive.nominal_bus_V, w));
}

/// Remarks on the winding's heat. They depend on heat.ambient_degC, also in a run without temperatures.
struct ThermalRemarks {
  std::string limit, cold, kept, hot;
  /// True if a remark or a check used the ambient temperature. A product drive's thresholds are always judged
  /// with this temperature.
  bool use_ambient(const Scenario& s) const {
    return !limit.empty() || !cold.empty() || !kept.empty() ||
           (s.control.drive == FirmwareKind::product && design::thermal_model(s.sheet));
  }
};

ThermalRemarks thermal_remarks(const Scenario& s, const Compiled& c, const RunWatch& w,
                               const WindingWatch& winding, const Outcome& out) {
  ThermalRemarks t;
  // A product drive is made for a real bridge. Scenarios with other drives are studies: export judges their
  // limits, and a remark judges the steady current at the run's end.
  if (s.control.drive == FirmwareKind::product) t.limit = limit_above_nominal(s, c.motor);
  t.cold = on_cold_winding(s, winding);
  t.hot = on_heat(s, w, out);
  if (t.cold.empty() && t.hot.empty()) t.kept = on_kept_current(s, winding, c);
  return t;
}

}  // namespace

void add_remarks(const Scenario& s, const Compiled& c, const RunWatch& w, const WindingWatch& winding,
                 Outcome& out) {
  const auto add = [&out](std::string text) {
    if (!text.empty()) out.remarks.push_back(std::move(text));
  };
  ThermalRemarks thermal = thermal_remarks(s, c, w, winding, out);
  if (const std::string unused = unused_keys(s, thermal.use_ambient(s)); !unused.empty())
    add("keys without effect: " + unused);
  if (!s.not_usable.empty()) add("the design of this drive is NOT USABLE: " + s.not_usable);
  for (BeliefCost& cost : belief_costs(s, c)) add(std::move(cost.text));
  add(sheet_contradiction(s));
  add(on_supply(s));
  add(std::move(thermal.limit));
  on_protection(s, c, out);
  add(on_load_after_trip(s, out));
  add(on_late_values(s));
  for (std::string& text : passed_limits(s, w, out)) add(std::move(text));
  add(std::move(thermal.cold));
  add(std::move(thermal.kept));
  for (std::string& text : passed_currents(s, c.own.is ? c.drive.current_limit_A : 0.0, w))
    add(std::move(text));
  add(blind_samples(s, out));
  if (!c.own.is) add_loop_remarks(s, c, w, out);
  add(std::move(thermal.hot));
}

}  // namespace sixstep::study
