// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/thermal_remarks.hpp"

#include <cmath>
#include <limits>

#include "sixstep/study/run/limit_remarks.hpp"
#include "sixstep/study/scenario/supply_voltages.hpp"

namespace sixstep::study {
namespace {

using Course = WindingWatch::Course;

constexpr const char* by_ends = " by the worse ends of the thermal ranges";

std::string degC(double temperature) { return few_digits(temperature) + " degC"; }
std::string at(double t_s) { return "t = " + few_digits(t_s) + " s"; }

/// The loss of a drive that goes on as at the run's end.
struct GoesOn {
  EndWatch::Kept loss;
  double equal_A = 0.0;  ///< current through two phases with this loss
  double housing_W = 0.0;

  design::Heating heating(const Scenario& s, double cold_W) const {
    return {.copper_W = cold_W, .housing_W = housing_W, .ambient_degC = s.heat.ambient_degC};
  }
};

/// Time that a run-up or a braking still takes, s; infinite without one, and if the load drives the shaft away from the
/// reference.
double run_up_s(const Scenario& s, const GoesOn& on, const design::MotorModel& motor) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (!on.loss.rad_s2) return never;
  const double asked = reference_levels(s).back().value, w = on.loss.speed_rad_s;
  const bool by_speed = s.control.mode == control::Mode::speed;
  const bool by_sign = s.control.mode == control::Mode::current || s.control.mode == control::Mode::duty;
  if (by_sign && asked * *on.loss.rad_s2 < 0.0) return never;
  const double last = by_speed ? asked : std::copysign(highest_open_V(s) / motor.K_t_Nm_A, *on.loss.rad_s2);
  const double left_s = (last - w) / *on.loss.rad_s2;
  return left_s > 0.0 ? left_s : never;
}

/// The loss without the current that accelerates the shaft.
double cold_W_after_run_up(const GoesOn& on, const Compiled& c) {
  const double accelerates_A = c.shaft.J_kg_m2 * std::fabs(*on.loss.rad_s2) / c.motor.K_t_Nm_A;
  const double left_A = std::fmax(on.equal_A - accelerates_A, 0.0);
  return 2 * c.motor.machine.R_ohm * left_A * left_A;
}

/// "125 degC at t = 83.3 s", from the run's end on.
std::string limit_words(const Course& of, double end_s, const std::optional<double>& more_s) {
  const std::string limit = degC(of.model.max_winding_degC);
  return more_s ? limit + " at " + at(end_s + *more_s) : "less than " + limit + " for ever";
}

/// "from t = 0.9 s to the end the winding loses a steady 68.3 W, as with 8.14 A through two phases"; `nominal_A` 0: not
/// compared.
std::string loss_words(const GoesOn& on, const Scenario& s, double nominal_A) {
  const EndWatch::Kept& kept = on.loss;
  std::string text = "from " + at(kept.since_s) + " to the end the winding loses " +
                     (kept.steady ? "a steady " : "") + few_digits(kept.copper_W) + " W" +
                     (kept.steady ? "" : " on average");
  if (s.heat.motor) text += " (" + few_digits(kept.cold_W) + " W if it were at 25 degC)";
  text += ", as with " + few_digits(on.equal_A) + " A through two phases";
  if (nominal_A > 0.0)
    text += ", " + few_digits(on.equal_A / nominal_A) + " times the nominal current of " +
            few_digits(nominal_A) + " A";
  return text;
}

/// Empty text if the winding withstands the loss; no text if the loss ends with a run-up.
std::optional<std::string> on_loss(const EndWatch::Kept& kept, const Scenario& s, const WindingWatch& watch,
                                   const Compiled& c) {
  constexpr double beyond = 1.05;  // the ripple adds to the loss of a current equal to the nominal one
  // The motor's own friction warms the housing; the load's warms the load.
  const design::MotorModel& motor = c.motor;
  const double R_ohm = 2 * motor.machine.R_ohm, nominal_A = motor.nominal_current_A,
               w = std::fabs(kept.speed_rad_s);
  const GoesOn on{.loss = kept,
                  .equal_A = std::sqrt(kept.cold_W / R_ohm),
                  .housing_W = (motor.shaft.B_Nm_s * w + motor.shaft.coulomb_Nm) * w};
  const bool judged = nominal_A > 0.0 && s.control.drive != FirmwareKind::field;
  // Time to the limit from the run's end, by the worse ends; infinite if the loss is withstood.
  const auto limit_s = [&](double cold_W) {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (watch.worse)
      return design::permissible_seconds(watch.worse->model, on.heating(s, cold_W), watch.worse->now)
          .value_or(never);
    return judged && std::sqrt(cold_W / R_ohm) > beyond * nominal_A ? 0.0 : never;
  };
  const double more_s = limit_s(kept.cold_W), run_up = run_up_s(s, on, motor);
  if (!std::isfinite(more_s)) return std::string();
  if (std::isfinite(run_up) && (!watch.worse || run_up < more_s) &&
      !std::isfinite(limit_s(cold_W_after_run_up(on, c))))
    return std::nullopt;
  std::string text = loss_words(on, s, judged ? nominal_A : 0.0);
  if (!watch.worse)
    return text +
           "; the sheet has no thermal values that say how long the winding withstands this current; lower the load or the current, or keep it for a short time only";
  const auto by_values =
      design::permissible_seconds(watch.values->model, on.heating(s, kept.cold_W), watch.values->now);
  text += std::string(": ") + (s.heat.motor ? "the winding" : "by the sheet's thermal values it") +
          " reaches " + degC(watch.values->highest_degC) + " in the run, and if this current goes on, " +
          (by_values ? "its limit of " : "") + limit_words(*watch.values, s.duration_s, by_values);
  if (watch.has_worse_ends)
    text += ";" + std::string(by_ends) + " " + degC(watch.worse->highest_degC) + ", and " +
            limit_words(*watch.worse, s.duration_s, more_s);
  return text + "; lower the load or the current, or end it before that time";
}

}  // namespace

std::string withstood(const design::WithstandTimes& times, double start_degC) {
  const auto duration = [](const std::optional<double>& t) {
    return t ? "for " + few_digits(*t) + " s" : std::string("without end");
  };
  return ": by the sheet's thermal values the winding withstands this current " + duration(times.by_values) +
         " from " + degC(start_degC) +
         (times.differ() ? std::string(", and") + by_ends + " " + duration(times.by_worse_ends) : "");
}

std::string on_cold_winding(const Scenario& s, const WindingWatch& watch) {
  if (s.heat.motor || !watch.worse || !watch.worse->passed_s) return {};
  const bool by_values = watch.values->passed_s.has_value();
  const auto words = [](const Course& of) {
    return "its limit of " + degC(of.model.max_winding_degC) + " at " + at(*of.passed_s) + " and " +
           degC(of.highest_degC) + " at " + at(of.highest_s);
  };
  return "the copper loss of the run heats the winding, from " + degC(s.heat.ambient_degC) + " on, to " +
         (by_values ? words(*watch.values) + ", by the sheet's thermal values" : "") +
         (by_values && watch.has_worse_ends ? "; to " : "") +
         (watch.has_worse_ends ? words(*watch.worse) + "," + by_ends : "") +
         "; set heat.motor = true to simulate the temperatures";
}

std::string on_kept_current(const Scenario& s, const WindingWatch& watch, const Compiled& c) {
  const std::optional<EndWatch::Kept> kept = watch.end.kept();
  if (!kept) return {};
  // A sine is steady for a while at each of its peaks, a square between its steps: neither goes on so.
  const bool returns = s.reference.shape == Shape::sine || s.reference.shape == Shape::square;
  const std::optional<EndWatch::Kept> last = returns ? std::nullopt : watch.end.kept_briefly();
  if (last && last->cold_W > kept->cold_W)
    if (const std::optional<std::string> text = on_loss(*last, s, watch, c)) return *text;
  return on_loss(*kept, s, watch, c).value_or("");
}

}  // namespace sixstep::study
