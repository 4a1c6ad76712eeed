// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/scenario/changes.hpp"

#include <algorithm>

#include "sixstep/sim/instant.hpp"

namespace sixstep::study {

namespace {

using control::Mode;

/// AtMode has `same` first; its other values have the order of control::Mode, each one higher.
Mode mode_of(AtMode mode, Mode before) {
  return mode == AtMode::same ? before : static_cast<Mode>(static_cast<int>(mode) - 1);
}
static_assert(static_cast<int>(AtMode::off) - 1 == static_cast<int>(Mode::off) &&
              static_cast<int>(AtMode::position) - 1 == static_cast<int>(Mode::position));
control::Chopping chopping_of(AtChopping chopping, control::Chopping before) {
  return chopping == AtChopping::same ? before
                                      : static_cast<control::Chopping>(static_cast<int>(chopping) - 1);
}
static_assert(static_cast<int>(AtChopping::soft) - 1 == static_cast<int>(control::Chopping::soft) &&
              static_cast<int>(AtChopping::complementary) - 1 ==
                  static_cast<int>(control::Chopping::complementary));

Commutates commutates_by(AtCommutates given, Commutates before) {
  return given == AtCommutates::same ? before : static_cast<Commutates>(static_cast<int>(given) - 1);
}
static_assert(static_cast<int>(AtCommutates::back_emf) - 1 == static_cast<int>(Commutates::back_emf) &&
              static_cast<int>(AtCommutates::hall) - 1 == static_cast<int>(Commutates::hall));

template <class T>
void take(T& member, const std::optional<double>& given) {
  if (given) member = *given;
}

/// If only settle_s or only damping is given, the other value stays as it was. Explicit gains (d1, d0, kp,
/// ki, ki_per_s) replace both.
template <class Loop>
void take_gains(Loop& loop, const AtGains& given) {
  if (given == AtGains{}) return;
  const bool rule = !given.d1 && !given.d0 && !given.kp && !given.ki && !given.ki_per_s;
  loop.d1 = given.d1;
  loop.d0 = given.d0;
  loop.kp = given.kp;
  loop.ki = given.ki;
  loop.ki_per_s = given.ki_per_s;
  if (!rule) loop.settle_s = loop.damping = std::nullopt;
  if (given.settle_s) loop.settle_s = given.settle_s;
  if (given.damping) loop.damping = given.damping;
}

void take_control(Control& control, const AtControl& given) {
  control.mode = mode_of(given.mode, control.mode);
  take_gains(control.current, given.current);
  take_gains(control.speed, given.speed);
  take(control.current.band_A, given.current.band_A);
  take(control.current.limit_A, given.current.limit_A);
  take(control.speed.torque_limit_Nm, given.speed.torque_limit_Nm);
  take(control.position.gain_rad_s_per_deg, given.position.gain_rad_s_per_deg);
  take(control.position.speed_limit_rad_s, given.position.speed_limit_rad_s);
  take(control.slew, given.slew);
  take(control.limits.current_A, given.limits.current_A);
  take(control.limits.torque_Nm, given.limits.torque_Nm);
  take(control.limits.speed_rad_s, given.limits.speed_rad_s);
  control.sensorless.commutates = commutates_by(given.sensorless.commutates, control.sensorless.commutates);
}

}  // namespace

std::vector<const At*> in_order(const Scenario& s) {
  std::vector<const At*> order;
  order.reserve(s.at.size());
  for (const At& at : s.at) order.push_back(&at);
  const auto earlier = [&s](const At* a, const At* b) { return happens_at_s(s, *a) < happens_at_s(s, *b); };
  // A session appends thousands of events in order.
  if (!std::is_sorted(order.begin(), order.end(), earlier))
    std::stable_sort(order.begin(), order.end(), earlier);
  return order;
}

std::int64_t sample_from_ticks(const Pwm& pwm, std::int64_t ticks) {
  const std::int64_t period = sim::to_instant(pwm.period_s).ticks;
  const std::int64_t first = pwm.sample == SampleAt::middle ? period / 2 : 0;
  return ticks <= first ? first : first + (ticks - first + period - 1) / period * period;
}

double happens_at_s(const Scenario& s, const At& at) {
  if (at.control.mode == AtMode::same) return at.time_s;
  return sim::Instant{sample_from_ticks(s.pwm, sim::to_instant(at.time_s).ticks), 0.0}.seconds();
}

std::vector<Mode> modes_from(const Scenario& s) {
  std::vector<Mode> modes(s.at.size());
  Mode mode = s.control.mode;
  for (const At* at : in_order(s))
    modes[static_cast<std::size_t>(at - s.at.data())] = mode = mode_of(at->control.mode, mode);
  return modes;
}

bool changes_mode(const Scenario& s) {
  return std::any_of(s.at.begin(), s.at.end(), [](const At& at) { return at.control.mode != AtMode::same; });
}

bool comes_into(const Scenario& s, Mode mode) {
  return s.control.mode == mode || std::any_of(s.at.begin(), s.at.end(), [mode](const At& at) {
           return at.control.mode != AtMode::same && mode_of(at.control.mode, mode) == mode;
         });
}

Scenario settled(const Scenario& s, const At* event) {
  const std::vector<const At*> order = in_order(s);
  Scenario out = s;
  out.at.clear();
  bool behind = event == nullptr;
  for (const At* at : order) {
    if (behind) break;
    take_control(out.control, at->control);
    out.pwm.chopping = chopping_of(at->pwm.chopping, out.pwm.chopping);
    if (at->bridge.dead_time_s) out.bridge.dead_time_s = *at->bridge.dead_time_s;
    behind = at == event;
  }
  if (out.control.mode != s.control.mode) out.reference = {};
  Mode mode = s.control.mode;
  for (const At* at : order) {
    const bool other_mode = at->control.mode != AtMode::same;
    mode = mode_of(at->control.mode, mode);
    At kept = *at;
    kept.control = {};
    kept.pwm = {};
    kept.bridge.dead_time_s = std::nullopt;
    // The reference ends when the reference of another mode begins.
    if (mode != out.control.mode && (kept.reference || other_mode)) kept.reference = Reference{};
    if (kept.reference || kept.supply.voltage_V || kept.load.torque_Nm || kept.sensors.hall_break ||
        kept.motor.broken_wire != Wire::none || kept.bridge.open_switch != Switch::none ||
        kept.bridge.shorted_switch != Switch::none)
      out.at.push_back(kept);
  }
  return out;
}

}  // namespace sixstep::study
