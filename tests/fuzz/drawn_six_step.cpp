// SPDX-License-Identifier: Apache-2.0
// Draws optional parts of a six-step drive: PWM patterns, deadbeat current control, commutation with the
// staying phase's current, and laws of the speed loop. It also draws the profile of any drive's position
// loop. These parts are drawn last, so that the other values of a seed do not change.
#include <algorithm>
#include <iterator>

#include "sixstep/study/scenario/choices.hpp"
#include "tests/fuzz/drawn_parts.hpp"

namespace sixstep::testing {

using namespace study;
using control::Mode;

namespace {

bool runs_speed(const Control& c) { return c.mode == Mode::speed || c.mode == Mode::position; }
bool runs_current(const Control& c) {
  return c.mode == Mode::current || (runs_speed(c) && c.speed.output == SpeedOutput::current);
}
template <class Has>
bool never(const Scenario& s, Has has) {
  return std::none_of(s.at.begin(), s.at.end(), has);
}

/// Returns whether the drive uses hard chopping, from the start or after an event.
bool chops_both(const Scenario& s) {
  const bool hard = s.pwm.chopping == control::Chopping::hard && !s.control.smooth_chopping.on;
  return hard || !never(s, [](const At& at) { return at.pwm.chopping == AtChopping::hard; });
}

void draw_pattern(Draw& draw, Scenario& s) {
  if (s.control.current.type == CurrentLoopType::hysteresis || chops_both(s)) return;
  s.pwm.pattern =
      static_cast<control::PwmPattern>(draw.one_of(static_cast<int>(std::size(study::pattern_choices))));
}

void draw_current(Draw& draw, Scenario& s) {
  CurrentLoop& loop = s.control.current;
  if (!runs_current(s.control) || loop.type != CurrentLoopType::pi) return;
  if (draw.chance(0.3)) loop.feedback = CurrentFeedback::staying_phase;
  if (draw.chance(0.3) && !chops_both(s))
    loop.commutation = static_cast<CurrentCommutation>(1 + draw.one_of(2));
  if (!never(s, [](const At& at) { return !(at.control.current == AtCurrentLoop{}); }) || !draw.chance(0.5))
    return;
  loop = {.type = CurrentLoopType::deadbeat, .limit_A = loop.limit_A, .feedback = loop.feedback};
  if (draw.chance(0.5)) loop.correction = draw.unit();
}

void draw_law(Draw& draw, Scenario& s) {
  const bool floats =
      s.control.arithmetic == Arithmetic::float64 || s.control.arithmetic == Arithmetic::float32;
  if (!runs_speed(s.control) || !floats || !draw.chance(0.5)) return;
  if (!never(s, [](const At& at) { return !(at.control.speed == AtSpeedLoop{}); })) return;
  static constexpr SpeedLaw laws[] = {SpeedLaw::state_feedback, SpeedLaw::disturbance_rejection,
                                      SpeedLaw::sliding_mode};
  SpeedLoop& loop = s.control.speed;
  loop = {.output = loop.output,
          .law = laws[draw.one_of(3)],
          .settle_s = s.pwm.period_s * draw.decades(10.0, 500.0),
          .torque_limit_Nm = loop.torque_limit_Nm};
  if (loop.law != SpeedLaw::sliding_mode && draw.chance(0.4)) loop.observer_ratio = draw.between(1.5, 8.0);
}

}  // namespace

void draw_six_step(Draw& draw, Scenario& s) {
  if (s.control.drive != FirmwareKind::lean && s.control.drive != FirmwareKind::product) return;
  if (s.control.mode == Mode::off || s.sheet.kind == design::MotorKind::linear) return;
  if (!draw.chance(0.4)) return;
  draw_pattern(draw, s);
  draw_current(draw, s);
  draw_law(draw, s);
}

/// Values that are not drawn are computed from the drive. A drawn value could exceed the limit after an event
/// that lowers the torque limit or the speed limit.
void draw_profile(Draw& draw, Scenario& s) {
  Control& c = s.control;
  const bool floats = c.arithmetic == Arithmetic::float64 || c.arithmetic == Arithmetic::float32;
  const bool runs =
      c.drive == FirmwareKind::lean || c.drive == FirmwareKind::product || c.drive == FirmwareKind::field;
  if (c.mode != Mode::position || !floats || !runs || c.slew || !draw.chance(0.6)) return;
  if (!never(s, [](const At& at) { return at.control.slew.has_value(); })) return;
  PositionProfile& p = c.position.profile;
  p.on = true;
  p.feed_forward = c.speed.law == SpeedLaw::pi && draw.chance(0.8);
  const bool steady =
      never(s, [](const At& at) { return at.control.position.speed_limit_rad_s.has_value(); });
  if (c.position.speed_limit_rad_s && steady && draw.chance(0.5))
    p.speed_rad_s = *c.position.speed_limit_rad_s * draw.decades(0.05, 1.0);
  if (draw.chance(0.6)) p.smoothing_s = s.pwm.period_s * draw.decades(0.5, 500.0);
}

}  // namespace sixstep::testing
