// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/course_parts.hpp"
#include "sixstep/analysis/verify/travel.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/measure/figures.hpp"

namespace sixstep::analysis {

using design::DriveDesign;
using design::LoopDesign;

namespace {

/// Largest speed that the loop may request: the speed that the bus allows or, if it is less, 0.8 times the
/// greatest speed of sheet or board. The factor is 0.8 because a speed measured by Hall edges overshoots its
/// reference by a fifth.
double bounded_speed(const DriveDesign& d, const DesignSubject& subject, study::Scenario& s) {
  constexpr double below = 0.8;
  const double reached = d.bus_V / d.motor.K_t_Nm_A;
  std::optional<double>& bound = s.control.position.speed_limit_rad_s;
  double most = allowed_speed_rad_s(subject);
  if (const auto& sheet = subject.sheet.max_speed_rpm)
    most = std::min(most, sheet->value / base::rpm_per_rad_s);
  if (most < reached && !bound) bound = base::shortened(below * most, 3, base::Towards::down);
  return std::min(reached, bound.value_or(reached));
}

}  // namespace

double usual_move(const DriveDesign& d) {
  if (!design::motion_of(d.motor).linear) return 1000.0;
  return plain_number(20 * 1e3 * base::pi / d.motor.machine.pole_pairs);
}

void add_position(const DriveDesign& d, const DesignSubject& subject, study::Scenario& s) {
  const LoopDesign& loop = d.loop("position");
  const base::LinearUnit unit = design::motion_of(d.motor).unit("deg");
  const double step = subject.step.value_or(usual_move(d)) / unit.factor;
  const double height = std::fabs(step) * base::pi / 180;
  const double J = d.motor.shaft.J_kg_m2;
  // Upper bound of the move's duration: full torque over half of the distance, and braking over the other
  // half. The bus ends the acceleration at U/K_t; U: bus voltage, K_t: torque constant. A start that the bus
  // limits soon reaches a third of this speed. Then the P loop's exponential decays to 1e-9 of the step.
  const double forth_and_back = 2 * std::sqrt(height * J / d.most_torque_Nm()),
               top = bounded_speed(d, subject, s);
  const std::string of_top =
      top < d.bus_V / d.motor.K_t_Nm_A ? "control.position.speed_limit_rad_s" : "bus/K_t";
  // The bus may end the acceleration before half of the distance: the speed is then a trapezoid over time.
  const double to_top = top * J / d.most_torque_Nm();
  const double fastest = forth_and_back / 2 > to_top ? height / top + to_top : forth_and_back;
  const double travel = 2 * forth_and_back + 3 * height / top + 4 * start_time(d, top / 2, 0.0);
  const double fade = 21.0 / (loop.gains.d1 * 180 / base::pi), end = plain_time(travel + fade);
  s.title = "Position cascade as designed, one move";
  s.duration_s = end;
  s.reference.value = step;
  s.reference.unit.emplace(unit.linear);
  study::Measure settling = step_measure(study::MetricKind::settling_time, study::Signal::position, 0, end, 0,
                                         step, "settling time");
  const bool counts = d.spec.rotor.lags();  // with steps, the position settles only within some steps of the
                                            // sensor, if at all
  const bool hall = d.spec.rotor.hall;
  const double steps = allowed_overshoot_deg(d, step);
  settling.band = counts ? steps / std::fabs(step) : 0.0005;
  const study::Measure overshoot =
      step_measure(study::MetricKind::overshoot, study::Signal::position, 0, end, 0, step, "overshoot");
  s.compare = {
      {settling, fastest,
       (forth_and_back / 2 > to_top
            ? "full torque up to " + of_top + " and down again"
            : std::string("full torque: accelerating for half of the way, braking for the other half")) +
           std::string(hall     ? "; simulated: to within three Hall steps"
                       : counts ? "; simulated: to within 1 %, or three steps of the sensor"
                                : "; simulated: to within 0.05 %")},
      {overshoot, 0.0, "none wanted"},
      {window_measure(study::MetricKind::maximum, study::Signal::speed, 0, end, "peak speed"), top, of_top},
      {window_measure(study::MetricKind::maximum, study::Signal::current_magnitude, 0, end, "peak current"),
       d.most_current_A(), at_most_current(d) + "; simulated: largest phase current, also while braking"},
  };
  s.require = {{overshoot, std::nullopt, counts ? steps : 1e-9 * std::fabs(step)}};
  if (!counts) return;
  const study::Measure swing = window_measure(study::MetricKind::peak_to_peak, study::Signal::position,
                                              end - 0.2 * (end - travel), end, swing_at_target);
  s.compare.push_back({swing, 0.0, "none wanted"});
  s.require.push_back({swing, std::nullopt, std::max(usual_move(d) / unit.factor, std::fabs(step)) / 10});
}

}  // namespace sixstep::analysis
