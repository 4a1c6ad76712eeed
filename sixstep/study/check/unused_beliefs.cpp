// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/unused_list.hpp"
#include "sixstep/study/scenario/changes.hpp"

namespace sixstep::study {
namespace {

using control::Mode;

bool follows_shaft(const Scenario& s) {
  const bool measured = s.sensors.rotor != RotorSensing::ideal && s.sensors.rotor != RotorSensing::hall;
  return measured && s.sensors.shaft == SensorShaft::motor;
}

/// True if the drive computes with the motor's values beyond the design of its loops.
bool computes_with_motor(const Scenario& s) {
  const Control& c = s.control;
  const bool limits = c.limits.torque_Nm || c.limits.speed_rad_s;
  return c.drive != FirmwareKind::lean || c.current.commutation != CurrentCommutation::plain ||
         c.current.back_emf_feed_forward || c.current.type == CurrentLoopType::deadbeat || limits ||
         c.smooth_chopping.on || !s.at.empty();
}

/// True if no loop is designed from R and L: there is no current loop, it is a hysteresis, or its gains are
/// given.
bool leaves_winding(const Scenario& s) {
  const CurrentLoop& loop = s.control.current;
  const Mode mode = s.control.mode;
  if (mode == Mode::off || mode == Mode::duty) return true;
  return mode == Mode::current && (loop.type == CurrentLoopType::hysteresis || loop.d1 || loop.kp);
}

bool reads_hall(const Scenario& s) {
  if (s.control.drive == FirmwareKind::field) return s.sensors.rotor == RotorSensing::hall;
  return !(follows_shaft(s) && (s.sensors.rotor != RotorSensing::encoder || s.sensors.encoder.referenced));
}

}  // namespace

void unused_beliefs(const Scenario& s, Unused& out) {
  const Believed& b = s.believed;
  const auto idle = [&out](const char* key, const std::optional<base::Quantity>& given, const char* reason) {
    const std::string written = given && !given->key.empty() ? given->key : key;
    out.add("believed." + written, given.has_value(), false, reason);
  };
  if (!follows_shaft(s))
    out.add("believed.sensor_offset_deg", b.sensor_offset_deg, 0.0,
            "no encoder, absolute encoder or resolver gives the motor's angle");
  if (!reads_hall(s))
    out.add("believed.hall_lines", b.hall_lines, rig::WireOrder::abc, "the drive does not read Hall probes");
  if (computes_with_motor(s)) return;
  if (s.sensors.rotor == RotorSensing::ideal && s.pwm.pattern == control::PwmPattern::upper)
    out.add("believed.pole_pairs", b.pole_pairs, {}, "the drive does not compute with these values");
  const bool speed = comes_into(s, Mode::speed) || comes_into(s, Mode::position);
  constexpr char no_speed[] = "control.mode has no speed loop";
  if (!speed) idle("inertia_gcm2", b.inertia_gcm2, no_speed);
  if (!speed)
    for (const auto& [key, given] : {std::pair("torque_constant_mNm_A", &b.torque_constant_mNm_A),
                                     std::pair("back_emf_mV_s", &b.back_emf_mV_s),
                                     std::pair("torque_constant_Nm_A", &b.torque_constant_Nm_A),
                                     std::pair("flux_linkage_mWb", &b.flux_linkage_mWb),
                                     std::pair("speed_constant_rpm_V", &b.speed_constant_rpm_V)})
      idle(key, *given, no_speed);
  if (!leaves_winding(s)) return;
  constexpr char no_loop[] = "no current loop is designed with this value";
  idle("resistance_ohm", b.resistance_ohm, no_loop);
  idle("inductance_mH", b.inductance_mH, no_loop);
}

}  // namespace sixstep::study
