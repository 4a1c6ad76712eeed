// SPDX-License-Identifier: Apache-2.0
#include "tests/digest/sessions.hpp"

#include "tests/support/product_scenarios.hpp"

namespace sixstep::testing {
namespace {

using namespace study;
using control::Mode;

/// Applies a change at the time `at_s`. If the change were refused, the digest would differ.
void tell(Session& session, double at_s, const At& at) {
  session.advance(at_s);
  (void)session.change(at);
}

LivedCase lived(const char* name, base::Result<Session> session, double until_s) {
  if (!session) return {name, session.problems(), {}};
  session->advance(until_s);
  base::Result<Outcome> outcome = session->close();
  return {name, std::move(outcome), session->scenario()};
}

LivedCase current() {
  base::Result<Session> session = Session::open(current_square());
  if (session) {
    At weak, gains, sine;
    weak.supply.voltage_V = 22.0;
    weak.pwm.chopping = AtChopping::complementary;
    weak.bridge.dead_time_s = 1e-6;
    gains.control.current.settle_s = 0.7e-3;
    sine.reference = Reference{.shape = Shape::sine, .offset = 1.0, .amplitude = 3.0, .frequency_Hz = 250.0};
    tell(*session, 2.3e-3, weak);
    tell(*session, 4.1e-3, gains);
    *session = Session(*session);
    tell(*session, 7.77e-3, sine);
  }
  return lived("session-current", std::move(session), 12.3e-3);
}

LivedCase steady_duty() {
  base::Result<Session> session = Session::open(maxon_scenario(Mode::duty, 1.0));
  if (session) {
    At less, held;
    less.reference = Reference{.value = 0.4};
    held.control.mode = AtMode::current;
    held.control.current.settle_s = 1e-3;
    held.reference = Reference{.value = 2.0};
    tell(*session, 5e-3, less);
    tell(*session, 9e-3, held);
  }
  return lived("session-duty", std::move(session), 20e-3);
}

LivedCase product_q31() {
  Scenario s = product_scenario(Mode::speed, 60.0);
  s.control.arithmetic = Arithmetic::q31;
  s.control.full_scale.current_A = 100.0;
  base::Result<Session> session = Session::open(s);
  if (session) {
    At load, gains, torque;
    load.load.torque_Nm = 0.03;
    gains.control.speed.settle_s = 0.06;
    torque.control.mode = AtMode::current;
    torque.reference = Reference{.value = 3.0};
    tell(*session, 6e-3, load);
    tell(*session, 9e-3, gains);
    tell(*session, 13e-3, torque);
  }
  return lived("session-product-q31", std::move(session), 17e-3);
}

LivedCase on_general() {
  Scenario s = current_square();
  s.load.gear = 2;
  s.load.inertia_kg_m2 = 1e-5;
  s.load.stiffness_Nm_rad = 2;
  base::Result<Session> session = Session::open(s);
  if (session) {
    At crossed, broken;
    crossed.bridge.phases = AtOrder::bac;
    crossed.sensors.hall_lines = AtOrder::acb;
    broken.motor.broken_wire = Wire::b;
    tell(*session, 2.3e-3, crossed);
    *session = Session(*session);
    tell(*session, 7.77e-3, broken);
  }
  return lived("session-on-general", std::move(session), 12.3e-3);
}

}  // namespace

std::vector<LivedCase> lived_cases() { return {current(), steady_duty(), product_q31(), on_general()}; }

}  // namespace sixstep::testing
