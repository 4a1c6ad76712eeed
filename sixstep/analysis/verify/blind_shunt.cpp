// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/blind_shunt.hpp"

#include <cmath>

#include "sixstep/analysis/verify/run_warnings.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/compile/pulse.hpp"
#include "sixstep/study/run/keep_going.hpp"
#include "sixstep/study/run/low_side_limits.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::analysis {
namespace {

/// Peak to peak swing of the speed at the end of the test without its load; empty if the run ended early.
std::optional<double> idle_swing(const DesignOrder& order, const DesignStudy& s) {
  study::Scenario idle = s.scenario;
  idle.load.torque_Nm = 0.0;
  const base::Result<study::Outcome> outcome =
      study::run(idle, {.on_record = {},
                        .on_event = {},
                        .keep_going = study::listening(order.keep_going),
                        .keep_books = false});
  if (order.budget != nullptr) order.budget->takes(idle, 1);
  if (!outcome) return std::nullopt;
  const study::ComparisonResult* swing = figure_of(*outcome, "speed ripple");
  return swing ? std::optional(swing->measured) : std::nullopt;
}

/// The keys whose values prevent a measurement during a short pulse.
std::string hiding(const study::Scenario& s) {
  if (s.pwm.minimum_pulse_s >= study::least_shown_duty(s) * s.pwm.period_s) return "pwm.minimum_pulse_s";
  return std::string("sensors.shunt_settle_s") +
         (s.sensors.current_delay_s > 0.0 ? ", sensors.current_delay_s" : "") +
         (study::pulse_late_s(s) > 0.0 ? ", bridge.dead_time_s" : "");
}

/// Three shunts show the current of a pair at every duty if only upper switches are chopped. Two hide it at large
/// duties, one in a third of the sectors.
void look_at_low_side(DesignStudy& s) {
  const auto legs = static_cast<unsigned>(s.scenario.sensors.shunts);
  const bool below = s.scenario.pwm.chopping == control::Chopping::hard ||
                     s.scenario.pwm.pattern != control::PwmPattern::upper;
  if (legs == 7 && !below) return;
  s.warnings.push_back({.what = study::low_side_limits(s.scenario) +
                                "; a drive keeps the last value of a current that is not shown",
                        .cure =
                            "set sensors.shunts = \"abc\" and pwm.pattern = \"upper\", or measure the phase "
                            "currents",
                        .grave = (legs & (legs - 1)) == 0,
                        .of = design::Concern::shunt});
}

}  // namespace

double unseen_current_A(const design::DriveDesign& d, const study::Scenario& s) {
  if (s.sensors.currents != rig::CurrentMeasurement::dc_link) return 0.0;
  return study::unseen_at_rest_A(s, d.motor.machine.R_ohm);
}

void look_at_blind_shunt(const DesignOrder& order, DesignStudy& s) {
  if (s.scenario.sensors.currents == rig::CurrentMeasurement::low_side) return look_at_low_side(s);
  if (s.scenario.sensors.currents != rig::CurrentMeasurement::dc_link) return;
  const double unseen_A = unseen_current_A(s.design, s.scenario);
  if (unseen_A == 0.0) return;
  const std::string blind = "with the rotor at rest a single shunt measures no current below " +
                            base::three_digits(unseen_A) + " A, because the pulse is too short for a sample";
  design::Warning w{.what = blind + "; smaller currents are not controlled",
                    .cure = "set sensors.currents = \"phases\", or reduce " + hiding(s.scenario),
                    .of = design::Concern::shunt};
  if (s.design.spec.mode == control::Mode::current && std::fabs(s.scenario.reference.value) < unseen_A) {
    w.what = blind + "; the step commands only " + base::three_digits(std::fabs(s.scenario.reference.value)) +
             " A";
    w.grave = true;
  }
  if (s.design.spec.mode == control::Mode::speed && s.allowed_swing_rad_s)
    if (const std::optional<double> swing = idle_swing(order, s); swing && *swing > *s.allowed_swing_rad_s) {
      w.what = "without a load the speed swings by " + base::three_digits(*swing) +
               " rad/s, more than the allowed " + base::three_digits(*s.allowed_swing_rad_s) +
               " rad/s: " + blind;
      w.grave = true;
    }
  s.warnings.push_back(w);
}

}  // namespace sixstep::analysis
