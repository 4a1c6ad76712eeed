// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/thermal_remarks.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/study/run/limit_remarks.hpp"
#include "sixstep/study/scenario/supply_voltages.hpp"

namespace sixstep::study {

std::string withstood(const design::WithstandTimes& times, double ambient_degC) {
  const auto duration = [](const std::optional<double>& t) {
    return t ? "for " + few_digits(*t) + " s" : std::string("without end");
  };
  return ": by the sheet's thermal values the winding withstands this current " + duration(times.by_values) +
         " from " + few_digits(ambient_degC) + " degC" +
         (times.differ() ? ", and by the worse ends of the thermal ranges " + duration(times.by_worse_ends)
                         : "");
}

std::string on_cold_winding(const Scenario& s, const Outcome& out) {
  if (s.heat.motor || !out.energy || !(out.simulated_s > 0.0)) return {};
  const double mean_W = out.energy->copper / out.simulated_s;
  const auto times =
      design::withstand_times(s.sheet, {.copper_W = mean_W, .ambient_degC = s.heat.ambient_degC});
  if (!times || !times->by_worse_ends || !(*times->by_worse_ends < out.simulated_s)) return {};
  const bool by_values = times->by_values && *times->by_values < out.simulated_s;
  return "the copper loss of " + few_digits(mean_W) + " W on average heats the winding above its limit of " +
         few_digits(by_values ? times->limit_degC : times->worse_limit_degC) + " degC within " +
         few_digits(by_values ? *times->by_values : *times->by_worse_ends) + " s by " +
         (by_values ? "the sheet's thermal values" : "the worse ends of the sheet's thermal ranges") +
         ", and the run lasts " + few_digits(out.simulated_s) +
         " s; set heat.motor = true to simulate the temperatures";
}

std::string on_kept_current(const Scenario& s, const EndWatch& watch, double winding_degC,
                            const design::MotorModel& motor) {
  constexpr double beyond = 1.05;  // the ripple adds to the loss of a current equal to the nominal one
  const auto kept = watch.kept(1e-3 * highest_open_V(s) / motor.K_t_Nm_A);
  if (!kept) return {};
  const double copper_W =
      kept->copper_W / (s.heat.motor ? design::on_R({winding_degC, design::sheet_degC}) : 1.0);
  const double equal_A = std::sqrt(copper_W / (2 * motor.machine.R_ohm)), nominal_A = motor.nominal_current_A;
  // The motor's own friction warms the housing; the load's friction warms the load.
  const double w = std::fabs(kept->speed_rad_s),
               friction_W = motor.shaft.B_Nm_s * w * w + motor.shaft.coulomb_Nm * w;
  const auto times = design::withstand_times(
      s.sheet, {.copper_W = copper_W, .housing_W = friction_W, .ambient_degC = s.heat.ambient_degC});
  const bool judged = nominal_A > 0.0 && s.control.drive != FirmwareKind::field;
  if (times ? !times->by_values && !times->by_worse_ends : !judged || !(equal_A > beyond * nominal_A))
    return {};
  const std::string multiple = judged ? ", " + few_digits(equal_A / nominal_A) +
                                            " times the nominal current of " + few_digits(nominal_A) + " A"
                                      : "";
  return "from t = " + few_digits(kept->since_s) + " s to the end the winding loses a steady " +
         few_digits(copper_W) + " W, as with " + few_digits(equal_A) + " A through two phases" + multiple +
         (times ? withstood(*times, s.heat.ambient_degC)
                : "; the sheet has no thermal values that say how long the winding withstands this current") +
         "; lower the load or the current, or keep the current for " +
         (times ? "less than this time" : "a short time only");
}

}  // namespace sixstep::study
