// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/limit_remarks.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/linear.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/supply_voltages.hpp"

namespace sixstep::study {
namespace {

std::string on_battery(const Scenario& s, const RunWatch& w) {
  if (s.supply.source != SourceKind::battery) return {};
  if (w.empty_s)
    return "the battery was empty at t = " + few_digits(*w.empty_s) + " s, and its charge fell to " +
           few_digits(w.lowest_charge) +
           ". The run draws more charge than the battery has; give a larger supply.battery_capacity_Ah or battery_charge, or a shorter run";
  if (w.full_s)
    return "the battery was full at t = " + few_digits(*w.full_s) + " s, and its charge rose to " +
           few_digits(w.highest_charge) +
           ". The run returns more charge than the battery can store; begin with a lower supply.battery_charge, or add a brake chopper (supply.brake_resistance_ohm)";
  return {};
}

/// Chopping frequency above which a remark follows. Comparator, gate driver and dead time need 0.5 us or more
/// of each half period of 2.5 us.
constexpr double fast_chopping_Hz = 200e3;

/// A speed or a current may exceed its limit by a thousandth without a remark.
constexpr double past = 1.001;

std::string on_fastest(const Scenario& s, const RunWatch& w) {
  const auto& limit = s.sheet.max_speed_rpm;
  if (!limit) return {};
  const double allowed = limit->value / base::rpm_per_rad_s;
  if (!(w.fastest_rad_s > past * allowed)) return {};
  const bool linear = s.sheet.kind == design::MotorKind::linear;
  const auto in_rpm = [&](double rad_s) {
    return linear ? few_digits(rad_s) + " m/s"
                  : few_digits(rad_s) + " rad/s (" + few_digits(rad_s * base::rpm_per_rad_s) + " rpm)";
  };
  return std::string(linear ? "the slide" : "the rotor") + " reached " + in_rpm(w.fastest_rad_s) +
         ", and the sheet allows " + in_rpm(allowed);
}

std::string on_bus(const Scenario& s, const RunWatch& w, const Outcome& out) {
  const bool rectifier =
      s.supply.source == SourceKind::single_phase || s.supply.source == SourceKind::three_phase;
  const bool sinks = s.supply.sinks && !rectifier && std::none_of(s.at.begin(), s.at.end(), [](const At& at) {
                       return at.supply.sinks == false;
                     });
  const bool caught = s.supply.brake_resistance_ohm > 0.0 || s.control.regeneration.limit_V;
  const double open = highest_open_V(s);
  if (sinks || caught || !(w.highest_bus_V > risen_part * open)) return {};
  const bool driven = out.energy && out.energy->load < 0.0;
  return "the bus rose to " + few_digits(w.highest_bus_V) + " V, " + few_digits(w.highest_bus_V / open) +
         " times the source's voltage, because the source takes no current back" +
         (rectifier ? "" : " (supply.sinks = false)") +
         (driven
              ? ", and the load drives the shaft, for which no capacitance is large enough; add a brake chopper "
                "(supply.brake_resistance_ohm)"
              : "; add a brake chopper (supply.brake_resistance_ohm), a larger supply.capacitance_F or "
                "control.regeneration.limit_V");
}

/// Comparators with `comparator = "event"` chop at a frequency proportional to 1/band_A, independent of
/// pwm.period_s.
std::string on_chopping(const Scenario& s, const Outcome& out) {
  const CurrentLoop& loop = s.control.current;
  if (loop.type != CurrentLoopType::hysteresis || loop.comparator != Comparator::event ||
      !(out.simulated_s > 0.0))
    return {};
  const double Hz = static_cast<double>(out.turn_ons) / out.chopped_switches / out.simulated_s;
  if (!(Hz > fast_chopping_Hz)) return {};
  const double wider_A = base::shortened(loop.band_A * Hz / fast_chopping_Hz, 2, base::Towards::up);
  return "the comparators chop at " + few_digits(1e-3 * Hz) +
         " kHz on average, independent of pwm.period_s, and few "
         "bridges for motors switch above " +
         few_digits(1e-3 * fast_chopping_Hz) + " kHz; control.current.band_A = " + base::six_digits(wider_A) +
         " gives about that frequency";
}

}  // namespace

std::string few_digits(double x) {
  return std::fabs(x) < 1000.0 ? base::three_digits(x) : std::to_string(std::llround(x));
}

std::vector<std::string> passed_limits(const Scenario& s, const RunWatch& w, const Outcome& out) {
  std::vector<std::string> all;
  for (std::string text : {on_battery(s, w), on_fastest(s, w), on_bus(s, w, out), on_chopping(s, out)})
    if (!text.empty()) all.push_back(std::move(text));
  return all;
}

std::vector<std::string> passed_currents(const Scenario& s, double given_limit_A, const RunWatch& w) {
  constexpr double ripple = 1.25;  // a limited current exceeds its limit by the ripple and at commutations
  std::vector<std::string> all;
  const std::string reached = "a phase current reached " + few_digits(w.highest_phase_A) + " A, and ";
  if (given_limit_A > 0.0 && w.highest_phase_A > ripple * given_limit_A)
    all.push_back(reached + "the controller was given current_limit_A = " + few_digits(given_limit_A) +
                  " A, which the controller itself must keep");
  if (s.sensors.currents != rig::CurrentMeasurement::ideal && s.sensors.current_range_A &&
      w.highest_phase_A > past * *s.sensors.current_range_A)
    all.push_back(reached + "the converters show at most sensors.current_range_A = " +
                  few_digits(*s.sensors.current_range_A) + " A: the drive cannot measure larger currents");
  return all;
}

}  // namespace sixstep::study
