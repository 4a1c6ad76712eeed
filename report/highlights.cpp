// SPDX-License-Identifier: Apache-2.0
#include "report/highlights.hpp"

#include <algorithm>
#include <cmath>

#include "report/windows.hpp"
#include "sixstep/study/check/product.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace report {
namespace {

using sixstep::control::Mode;
using sixstep::study::Scenario;
using sixstep::study::Trace;

constexpr double near = 0.1;  ///< a signal is near its goal if it differs by at most this fraction of the
                              ///< step; most ripple is smaller
constexpr double degrees_per_rad = 180.0 / 3.14159265358979323846;

/// The reference and the measured signal in one unit: signal = column * factor.
struct Loop {
  const char *of, *unit, *reference, *signal;
  double factor;
};
constexpr Loop current_loop{"current", "A", "i_ref_A", "i_m_A", 1.0};
constexpr Loop across_loop{"current", "A", "i_q_ref_A", "i_q_A", 1.0};
constexpr Loop speed_loop{"speed", "rad/s", "speed_ref_rad_s", "speed_rad_s", 1.0};
constexpr Loop position_loop{"position", "deg", "position_ref_deg", "angle_rad", degrees_per_rad};

const Loop* loop_of(const Scenario& s) {
  const Mode mode = s.control.mode;
  if (mode == Mode::current)
    return s.control.drive == sixstep::study::FirmwareKind::field ? &across_loop : &current_loop;
  if (mode == Mode::speed) return &speed_loop;
  return mode == Mode::position ? &position_loop : nullptr;
}

using Values = std::vector<double>;

struct Change {
  std::size_t row = 0;
  double from = 0.0, to = 0.0;
  double size() const { return std::abs(to - from); }
};

std::vector<Change> changes_of(const Values& reference, double start) {
  std::vector<Change> out;
  double last = start;
  for (std::size_t n = 0; n < reference.size(); ++n) {
    if (!std::isfinite(reference[n]) || (n > 0 && reference[n] == last)) continue;
    out.push_back({n, last, reference[n]});
    last = reference[n];
  }
  return out;
}

/// Whether a six-step drive starts its rotor open-loop with a given current. The speed reference is then 0
/// until the speed loop starts, and again after the drive has lost the rotor.
bool starts_blindly(const Scenario& s) {
  return s.control.mode == Mode::speed && s.control.drive == sixstep::study::FirmwareKind::sensorless &&
         s.control.sensorless.commutates != sixstep::study::Commutates::hall;
}

/// Whether a field-oriented drive starts its rotor open-loop and then follows an observer. When its speed
/// loop starts, the reference steps from the rotor's present speed.
bool takes_over_turning(const Scenario& s) {
  return s.control.mode == Mode::speed && s.control.drive == sixstep::study::FirmwareKind::field &&
         s.control.field.angle == sixstep::study::FieldAngle::observer;
}

/// The size of a step of the reference. In a blind start, a change from or to 0 does not count as a step: its
/// size is 0.
double step_size(const Change& change, bool blind_start) {
  return blind_start && (change.from == 0.0 || change.to == 0.0) ? 0.0 : change.size();
}

/// The row of the first Hall edge after the current is near its goal; without such an edge, the last row.
/// After this edge, changes of the current are commutations, not the step.
std::size_t end_of_current_step(const Values* hall, const Values& signal, const Change& step,
                                std::size_t last) {
  if (!hall) return last;
  std::size_t n = step.row;
  while (n < last && std::abs(signal[n] - step.to) > near * step.size()) ++n;
  while (n < last && (*hall)[n + 1] == (*hall)[n]) ++n;
  return n;
}

/// Angle in degrees by which the shaft is ahead of the drive's count at the run's end. An encoder without a
/// reference counts from its index, and the shaft may have made any number of turns before.
double ahead_of_count(const Scenario& s, double shaft_deg, double asked_deg) {
  const bool from_index = s.control.mode == Mode::position && !s.sensors.encoder.referenced &&
                          s.sensors.rotor == sixstep::study::RotorSensing::encoder;
  return from_index ? 360.0 * std::round((shaft_deg - asked_deg) / 360.0) : 0.0;
}

/// The whole run as one step, for a run without a setpoint.
Step from_start(const Values& time, const Scenario& scenario) {
  return {.of = "start",
          .unit = "",
          .at_s = time.front(),
          .next_s = time.back(),
          .held = held_by(scenario),
          .window = {time.front(), time.back()}};
}

}  // namespace

std::optional<double> last_setpoint_s(const Trace& trace, const Scenario& scenario) {
  const auto* time = find_column(trace, "t_s");
  const Loop* loop = loop_of(scenario);
  const bool duty = scenario.control.mode == Mode::duty;
  const Values* reference = loop   ? find_column(trace, loop->reference)
                            : duty ? find_column(trace, "duty")
                                   : nullptr;
  if (!time || !reference) return std::nullopt;
  const std::vector<Change> changes = changes_of(*reference, 0.0);
  return changes.empty() ? time->front() : (*time)[changes.back().row];
}

std::optional<Step> largest_step(const Trace& trace, const Scenario& scenario) {
  const auto* time = find_column(trace, "t_s");
  if (!time || time->size() < 2) return std::nullopt;
  const Loop* loop = loop_of(scenario);
  const Values* reference = loop ? find_column(trace, loop->reference) : nullptr;
  const Values* signal = loop ? find_column(trace, loop->signal) : nullptr;
  if (!reference || !signal) return from_start(*time, scenario);
  const double ahead = ahead_of_count(scenario, signal->back() * loop->factor, reference->back());
  Values asked = *reference;
  for (double& level : asked) level += ahead;
  std::vector<Change> changes = changes_of(asked, signal->front() * loop->factor);
  for (Change& change : changes)
    if (takes_over_turning(scenario) && change.from == 0.0)
      change.from = (*signal)[change.row] * loop->factor;
  const bool blind = starts_blindly(scenario);
  const auto largest = std::ranges::max_element(
      changes, {}, [blind](const Change& change) { return step_size(change, blind); });
  if (largest == changes.end() || step_size(*largest, blind) == 0.0) return from_start(*time, scenario);
  const std::size_t next = largest + 1 == changes.end() ? time->size() - 1 : (largest + 1)->row;
  const bool of_pair = loop == &current_loop;
  const std::size_t until =
      of_pair ? end_of_current_step(find_column(trace, "hall"), *signal, *largest, next) : next;
  std::size_t outside = largest->row;  // last row at which the signal was not near its goal
  for (std::size_t n = largest->row; n <= until; ++n)
    if (std::abs((*signal)[n] * loop->factor - largest->to) > near * largest->size()) outside = n;
  const double at = (*time)[largest->row], end = (*time)[next];
  // Least time to the next change, in PWM periods. A reference that changes continuously has no visible step.
  constexpr double least_periods = 3.0;
  if (end - at < least_periods * scenario.pwm.period_s && largest + 1 != changes.end())
    return from_start(*time, scenario);
  const double shown =
      std::min(std::max(1.5 * ((*time)[outside] - at), 20.0 * scenario.pwm.period_s), (*time)[until] - at);
  return Step{.of = loop->of,
              .unit = loop->unit,
              .at_s = at,
              .from = largest->from,
              .to = largest->to,
              .index = ahead,
              .next_s = end,
              .held = held_by(scenario),
              .window = {at, std::min(end, at + shown)},
              .done = at + shown < end};
}

namespace {

/// Integrals of y and y^2 over a window, and the lowest and highest y. y is the polyline through the rows.
struct Line {
  double integral = 0.0, square = 0.0, low = INFINITY, high = -INFINITY;
};

Line line_over(const Values& time, const Values& y, const Interval& window) {
  Line out;
  for (std::size_t n = 1; n < time.size(); ++n) {
    const double t0 = time[n - 1], t1 = time[n];
    const double from = std::max(t0, window.from), to = std::min(t1, window.to);
    if (!(from < to)) continue;
    const double slope = (y[n] - y[n - 1]) / (t1 - t0);
    const double a = y[n - 1] + slope * (from - t0), b = y[n - 1] + slope * (to - t0);
    out.integral += (to - from) / 2.0 * (a + b);
    out.square += (to - from) / 3.0 * (a * a + a * b + b * b);
    out.low = std::min({out.low, a, b});
    out.high = std::max({out.high, a, b});
  }
  return out;
}

/// Whether the current reference is ever nonzero. A controller without a current loop writes zeros.
bool names_a_current(const Values& reference) {
  return std::ranges::any_of(reference, [](double ampere) { return ampere != 0.0; });
}

/// Smaller currents are rounding errors.
constexpr double least_A = 1e-9;

/// The row in the window with the largest `measure`; the first such row if several are equal.
template <class Measure>
std::size_t largest_row(const Values& time, const Interval& window, const Measure& measure) {
  std::size_t row = 0;
  double largest = -INFINITY;
  for (std::size_t n = 0; n < time.size(); ++n)
    if (window.holds(time[n]) && measure(n) > largest) largest = measure(n), row = n;
  return row;
}

/// The row of the peak. For a step of the current, the peak is the farthest value in the step's direction,
/// because the old level may be larger. If the reference changes its sign, the phases' magnitudes first fall
/// and then rise; the peak is then searched after the lowest value. For a step of another quantity, the peak
/// is the largest magnitude.
std::size_t peak_row(const Values& time, const Values& y, const Step& step) {
  if (step.of != "current")
    return largest_row(time, step.window, [&](std::size_t n) { return std::abs(y[n]); });
  const bool crosses = step.from * step.to < 0.0;
  if (step.held.of_phases && crosses) {
    const std::size_t lowest = largest_row(time, step.window, [&](std::size_t n) { return -y[n]; });
    return largest_row(time, {time[lowest], step.window.to}, [&](std::size_t n) { return y[n]; });
  }
  const bool up = step.held.of_phases ? std::abs(step.to) > std::abs(step.from) : step.to > step.from;
  return largest_row(time, step.window, [&](std::size_t n) { return up ? y[n] : -y[n]; });
}

}  // namespace

std::optional<StepCurrent> step_current(const Trace& trace, const Step& step) {
  const auto* time = find_column(trace, "t_s");
  const std::optional<Values> current = held_values(trace, step.held);
  if (!time || !current) return std::nullopt;
  const double shown = step.window.to - step.window.from, rest = step.next_s - step.window.to;
  if (!(shown > 0.0) || !is_whole(trace, step.window)) return std::nullopt;
  const std::size_t peak = peak_row(*time, *current, step);
  StepCurrent out{.peak_A = (*current)[peak],
                  .peak_after_s = (*time)[peak] - step.at_s,
                  .rms_A = std::sqrt(line_over(*time, *current, step.window).square / shown)};
  if (step.done && rest > 0.0 && is_whole(trace, {step.window.to, step.next_s})) {
    const Line then = line_over(*time, *current, {step.window.to, step.next_s});
    out.then_mean_A = then.integral / rest;
    out.then_low_A = then.low;
    out.then_high_A = then.high;
  }
  const std::optional<Values> asked = asked_values(trace, step.held);
  if (asked && names_a_current(*asked) && std::isfinite((*asked)[peak])) out.asked_A = (*asked)[peak];
  for (double* ampere : {&out.peak_A, &out.rms_A, &out.then_low_A, &out.then_high_A})
    if (std::abs(*ampere) < least_A) *ampere = 0.0;
  for (std::optional<double>* ampere : {&out.then_mean_A, &out.asked_A})
    if (*ampere && std::abs(**ampere) < least_A) *ampere = 0.0;
  return out;
}

namespace {

/// Time in s during which the magnitude of a value was at the bound or above it. The value is constant
/// between rows.
double seconds_at(const Values& time, const Values& held, double bound, double from_s) {
  double sum = 0.0;
  for (std::size_t n = 1; n < time.size(); ++n)
    if (time[n - 1] >= from_s && std::abs(held[n - 1]) >= bound && std::abs(held[n]) >= bound)
      sum += time[n] - time[n - 1];
  return sum;
}

/// The used fraction of the bus voltage. For a driven pair, it is the duty. For three legs, it is the length
/// of the voltage vector, relative to the circle that the legs reach at every angle: bus/sqrt(3).
std::optional<Values> part_of_bus(const Trace& trace, const Scenario& scenario) {
  const Values *d = find_column(trace, "v_d_V"), *q = find_column(trace, "v_q_V"),
               *bus = find_column(trace, "bus_V"), *duty = find_column(trace, "duty");
  if (scenario.control.drive != sixstep::study::FirmwareKind::field)
    return duty ? std::optional(*duty) : std::nullopt;
  // A state of a finite set uses the whole bus or none of it, so a fraction has no meaning.
  if (!d || !q || !bus || scenario.control.field.law == sixstep::study::FieldLaw::finite_set)
    return std::nullopt;
  Values part(d->size());
  for (std::size_t n = 0; n < part.size(); ++n)
    part[n] = (*bus)[n] > 0.0 ? std::sqrt(3.0) * std::hypot((*d)[n], (*q)[n]) / (*bus)[n] : 0.0;
  return part;
}

}  // namespace

std::optional<Held> held_back(const Trace& trace, const Scenario& scenario) {
  const auto* time = find_column(trace, "t_s");
  const std::optional<Values> duty = part_of_bus(trace, scenario);
  const bool compares = scenario.control.current.type == sixstep::study::CurrentLoopType::hysteresis &&
                        scenario.control.mode >= Mode::current;
  if (!time || !duty || compares || scenario.control.mode == Mode::off) return std::nullopt;
  const double from_s = whole_from_s(trace);
  // The length of a vector has a rounding error; a duty does not.
  const double whole = scenario.control.drive == sixstep::study::FirmwareKind::field ? 1.0 - 1e-6 : 1.0;
  Held out{.seen_s = time->back() - from_s,
           .bus_s = seconds_at(*time, *duty, whole, from_s),
           .limit_A = sixstep::study::current_limit_A(scenario)};
  for (const double d : *duty) out.largest_duty = std::max(out.largest_duty, std::abs(d));
  const auto* reference = find_column(trace, "i_ref_A");
  if (scenario.control.drive == sixstep::study::FirmwareKind::own &&
      !(reference && names_a_current(*reference)))
    out.limit_A.reset();  // a user's controller may have no current reference
  // The reference may be in float or fixed point. The comparison allows a deviation of 2^-13, twice the
  // coarsest step.
  if (reference && out.limit_A)
    out.limit_s = seconds_at(*time, *reference, *out.limit_A * (1.0 - 1.0 / 8192), from_s);
  return out;
}

}  // namespace report
