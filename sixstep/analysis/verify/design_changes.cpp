// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/design_changes.hpp"

#include <algorithm>

#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/analysis/verify/scenario_spec.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/design_warnings.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::analysis {
namespace {

using control::Chopping;
using control::Mode;
using design::DesignSpec;
using design::DriveDesign;

/// Shortest tried period, s: no drive has a faster timer.
constexpr double shortest_period_s = 1e-6;

double plain(double x, base::Towards towards) { return base::shortened(x, 2, towards); }

/// Periods shorter than the specified period. They give a low ripple, a usable ripple, and a phase margin of
/// 45 degrees at one period of delay.
std::vector<double> shorter_periods(const DesignSpec& w, const DriveDesign& d) {
  if (w.rotor.shaft.kind == design::ShaftSensorKind::resolver)
    return {};  // the resolver's excitation depends on the period
  std::vector<double> out;
  for (const double part : {design::greatest_ripple, usable_ripple}) {
    const double ripple = period_for_ripple_s(d.motor, d.bus_V, w.chopping, part * d.nominal_current_A);
    const double period = plain(std::min(ripple, d.longest_period_s), base::Towards::down);
    if (period < w.period_s && period >= shortest_period_s && (out.empty() || out.back() < period))
      out.push_back(period);
  }
  return out;
}

void take_period(DesignSpec& w, double period_s) {
  w.period_s = period_s;
  w.rotor.shaft.period_s = period_s;
}

bool has_speed_loop(const DesignSpec& w) { return w.mode != Mode::current; }

/// An encoder on the order's board, or on a usual board.
design::RotorSensing encoder(const DesignOrder& order, double period_s) {
  study::Scenario board = order.subject.board.value_or(study::Scenario{});
  board.pwm.period_s = period_s;
  board.sensors = with_rotor(board.sensors, study::RotorSensing::encoder, period_s);
  board.control.drive = study::FirmwareKind::lean;
  design::RotorSensing rotor = rotor_sensing_of(board);
  if (!order.subject.board) rotor.shaft.capture_Hz = design::usual_encoder_capture_Hz;
  return rotor;
}

/// Clock of the timer that captures the sensor's edges; null if the sensor has no edges.
double* capture_of(design::RotorSensing& rotor) {
  if (rotor.shaft.kind == design::ShaftSensorKind::encoder) return &rotor.shaft.capture_Hz;
  return rotor.hall ? &rotor.capture_Hz : nullptr;
}

/// Adds a faster capture timer, which reduces the steps of the measured speed.
void add_finer(const DesignSpec& w, const DriveDesign& d, std::vector<DesignSpec>& out) {
  if (!design::is_grainy(d)) return;
  DesignSpec next = w;
  double* const capture = capture_of(next.rotor);
  if (!capture || !(*capture > 0.0 && *capture < design::usual_encoder_capture_Hz)) return;
  *capture = design::usual_encoder_capture_Hz;
  out.push_back(next);
}

void slow_down(DesignSpec& w, const DriveDesign& d, double times) {
  if (w.bandwidth_rad_s) {
    w.bandwidth_rad_s = plain(*w.bandwidth_rad_s / times, base::Towards::down);
    return;
  }
  const auto& inner = d.loops.front().placed;
  const double current = inner ? inner->settle_s : design::usual_current_settle_s;
  const double usual = has_speed_loop(w) ? design::usual_speed_settle_s : current;
  w.settle_s = plain(times * d.spec.settle_s.value_or(usual), base::Towards::up);
}

/// Adds a settling time that torque limit and inertia allow. In a faster loop, the limit would act during
/// every step.
void add_what_torque_allows(const DesignSpec& w, const DriveDesign& d, std::vector<DesignSpec>& out) {
  if (!has_speed_loop(w) || !d.spec.settle_s || !(d.settle_by_torque_s > *d.spec.settle_s)) return;
  DesignSpec next = w;
  next.settle_s = plain(d.settle_by_torque_s, base::Towards::up);
  out.push_back(next);
}

void add_slower(const DesignSpec& w, const DriveDesign& d, std::vector<DesignSpec>& out) {
  const auto with = [&](auto change) {
    DesignSpec next = w;
    change(next);
    out.push_back(next);
  };
  for (const design::SettlingLimit& limit : d.limits)
    if (limit.sensing.edges == w.rotor.edges && limit.lowest_speed_rad_s == d.lowest_speed_rad_s &&
        limit.settle_s && d.spec.settle_s && *limit.settle_s > *d.spec.settle_s)
      with([&](DesignSpec& n) { n.settle_s = plain(*limit.settle_s, base::Towards::up); });
  with([&](DesignSpec& n) { slow_down(n, d, 2.0); });
  with([&](DesignSpec& n) { slow_down(n, d, 4.0); });
  if (!has_speed_loop(w)) return;
  const auto& inner = d.loops.front().placed;
  if (inner)
    for (const double times : {0.5, 2.0})
      with([&](DesignSpec& n) { n.current_settle_s = plain(times * inner->settle_s, base::Towards::up); });
  if (w.rotor.lags() && w.mode == Mode::speed)
    with([&](DesignSpec& n) { n.lowest_speed_rad_s = plain(2 * d.lowest_speed_rad_s, base::Towards::up); });
}

/// Adds slower loops. A slower current loop alone would be too close to the speed loop, so that both loops
/// are slower.
void add_slower_together(const DesignSpec& w, const DriveDesign& d, std::vector<DesignSpec>& out) {
  const auto& inner = d.loops.front().placed;
  if (!has_speed_loop(w) || !inner) return;
  for (const double times : {2.0, 4.0}) {
    DesignSpec next = w;
    slow_down(next, d, times);
    next.current_settle_s = plain(times * inner->settle_s, base::Towards::up);
    out.push_back(next);
  }
}

void add_torque(const DriveDesign& d, const DesignSpec& w, std::vector<DesignSpec>& out) {
  if (!has_speed_loop(w)) return;
  for (const double amperes : {3.0 * d.nominal_current_A, d.nominal_current_A})
    if (amperes < d.current_at_full_torque_A) {
      DesignSpec next = w;
      next.torque_limit_Nm = plain(amperes * d.motor.K_t_Nm_A, base::Towards::down);
      out.push_back(next);
    }
}

void add_voltage(const DriveDesign& d, const DesignSpec& w, std::vector<DesignSpec>& out) {
  const double first_V = d.loops.front().gains.d1 * d.nominal_current_A;
  const double held_V = 1.25 * 2 * d.motor.machine.R_ohm * d.nominal_current_A;
  const double least = std::max(first_V, held_V);
  if (!(least > d.bus_V)) return;
  DesignSpec next = w;
  next.voltage_V = plain(least, base::Towards::up);
  out.push_back(next);
}

}  // namespace

DesignSpec unhurried(DesignSpec w, const design::MotorModel& motor) {
  take_period(w, unhurried_period_s);
  const double winding_s = 8 * motor.machine.L_H / motor.machine.R_ohm;
  if (has_speed_loop(w) && !w.current_settle_s)
    w.current_settle_s =
        plain(std::max(10 * w.period_s, std::min(40 * w.period_s, winding_s)), base::Towards::down);
  return w;
}

DesignSpec on_encoder(const DesignOrder& order, double period_s) {
  DesignSpec w = order.spec;
  w.chopping = Chopping::complementary;
  w.period_s = period_s;
  w.rotor = encoder(order, period_s);
  return w;
}

std::vector<DesignSpec> on_encoders(const DesignOrder& order, const DriveDesign& d) {
  if (!order.spec.rotor.hall || !decodes_encoders(order.subject.board)) return {};
  std::vector<DesignSpec> out{on_encoder(order, order.spec.period_s)};
  const std::vector<double> periods = shorter_periods(out.front(), d);
  for (std::size_t n = periods.size(); n-- > 0;) out.push_back(on_encoder(order, periods[n]));
  return out;
}

std::optional<DesignSpec> longer_of_periods(const DesignSpec& w, const DriveDesign& d) {
  if (shorter_periods(w, d).empty()) return std::nullopt;
  const double ripple = design::period_for_ripple_s(d.motor, d.bus_V, w.chopping,
                                                    design::greatest_ripple * d.nominal_current_A);
  const double period_s = plain(std::max(ripple, d.longest_period_s), base::Towards::down);
  if (!(period_s < w.period_s)) return std::nullopt;
  DesignSpec next = w;
  take_period(next, period_s);
  return next;
}

std::vector<DesignSpec> single_changes(const DesignOrder& order, const DriveDesign& d) {
  const DesignSpec& w = order.spec;
  std::vector<DesignSpec> out;
  const auto with = [&](auto change) {
    DesignSpec next = w;
    change(next);
    out.push_back(next);
  };
  add_what_torque_allows(w, d, out);
  add_finer(w, d, out);
  if (w.chopping != Chopping::complementary)
    with([](DesignSpec& n) { n.chopping = Chopping::complementary; });
  for (const double period : shorter_periods(w, d)) with([&](DesignSpec& n) { take_period(n, period); });
  if (w.rotor.hall && w.rotor.edges > 1) with([](DesignSpec& n) { n.rotor.edges = 1; });
  if (w.rotor.hall && w.mode == Mode::position && decodes_encoders(order.subject.board))
    with([&](DesignSpec& n) { n.rotor = encoder(order, w.period_s); });
  // A damping that the user chose applies to placed poles only; cancellation is then not tried.
  if (w.method == design::GainMethod::pole_placement && w.mode == Mode::current &&
      w.damping == design::usual_damping)
    with([](DesignSpec& n) { n.method = design::GainMethod::cancellation; });
  add_slower(w, d, out);
  add_torque(d, w, out);
  add_slower_together(w, d, out);
  add_voltage(d, w, out);
  return out;
}

std::vector<DesignSpec> joint_changes(const DesignOrder& order, const DriveDesign& d) {
  std::vector<DesignSpec> out;
  if (order.spec.mode == Mode::position) out = on_encoders(order, d);
  DesignSpec base = order.spec;
  base.chopping = Chopping::complementary;
  const std::vector<double> periods = shorter_periods(base, d);
  if (!periods.empty()) take_period(base, periods.front());
  out.push_back(base);
  if (periods.size() > 1) {
    DesignSpec longer = base;
    take_period(longer, periods.back());
    out.push_back(longer);
    slow_down(longer, d, 2.0);
    out.push_back(longer);
  }
  add_what_torque_allows(base, d, out);
  for (const double times : {2.0, 5.0, 10.0, 20.0}) {
    DesignSpec slower = base;
    slow_down(slower, d, times);
    out.push_back(slower);
    if (base.mode == Mode::speed && base.rotor.lags() && times < 10.0) {
      DesignSpec faster = base;
      faster.lowest_speed_rad_s = plain(times * d.lowest_speed_rad_s, base::Towards::up);
      out.push_back(faster);
    }
  }
  if (base.rotor.hall && base.mode != Mode::current) {
    base.rotor = encoder(order, base.period_s);
    out.push_back(base);
    if (base.rotor.shaft.capture_Hz < design::usual_encoder_capture_Hz) {
      DesignSpec finer = base;
      finer.rotor.shaft.capture_Hz = design::usual_encoder_capture_Hz;
      out.push_back(finer);
    }
    slow_down(base, d, 2.0);
    out.push_back(base);
  }
  return out;
}

std::string words_of_change(const DesignSpec& before, const DesignSpec& after) {
  std::string text;
  const auto say = [&](const char* name, const std::string& value) {
    text += (text.empty() ? "" : " and ") + (name + (" = " + value));
  };
  const auto number = [&](const char* name, const std::optional<double>& was,
                          const std::optional<double>& is) {
    if (is && was != is) say(name, base::written(*is));
  };
  const bool to_encoder = after.rotor.shaft.kind != before.rotor.shaft.kind;
  if (to_encoder)
    say("rotor", before.rotor.hall && before.rotor.edges > 0 ? "encoder without edges" : "encoder");
  const auto clock_of = [](const design::RotorSensing& r) {
    return r.hall ? r.capture_Hz : r.shaft.capture_Hz;
  };
  const double is_Hz = clock_of(after.rotor);
  const double was_Hz = to_encoder ? design::usual_encoder_capture_Hz : clock_of(before.rotor);
  if (is_Hz > 0.0 && is_Hz != was_Hz) say("capture_Hz", base::written(is_Hz));
  if (after.method != before.method) say("method", "cancellation");
  number("period_s", before.period_s, after.period_s);
  if (after.chopping != before.chopping)
    say("chopping", std::string(base::word(study::chopping_choices, after.chopping)));
  if (after.rotor.hall && after.rotor.edges != before.rotor.edges)
    say("edges", std::to_string(after.rotor.edges));
  number("settle_s", before.settle_s, after.settle_s);
  number("bandwidth_rad_s", before.bandwidth_rad_s, after.bandwidth_rad_s);
  number("current_settle_s", before.current_settle_s, after.current_settle_s);
  number("lowest_speed_rad_s", before.lowest_speed_rad_s, after.lowest_speed_rad_s);
  number("torque_limit_Nm", before.torque_limit_Nm, after.torque_limit_Nm);
  number("voltage_V", before.voltage_V, after.voltage_V);
  return text;
}

}  // namespace sixstep::analysis
