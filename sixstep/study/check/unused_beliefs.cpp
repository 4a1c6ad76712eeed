// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/idle_beliefs.hpp"
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

/// True if a field-oriented drive computes with inertia or torque beyond its loops.
bool field_estimates(const Scenario& s) {
  const Control& c = s.control;
  return c.field.angle != FieldAngle::sensors || c.limits.torque_Nm || c.limits.speed_rad_s || !s.at.empty();
}

constexpr std::string_view no_speed = "control.mode has no speed loop";

std::string_view idle_of_loops(const Scenario& s, Belief belief) {
  const bool speed = comes_into(s, Mode::speed) || comes_into(s, Mode::position);
  if (s.control.drive == FirmwareKind::field)
    return belief == Belief::inertia && !speed && !field_estimates(s) ? no_speed : "";
  if (computes_with_motor(s)) return "";
  const bool by_itself = s.sensors.rotor == RotorSensing::ideal || s.sensors.shaft == SensorShaft::load;
  if (belief == Belief::pole_pairs)
    return by_itself && s.pwm.pattern == control::PwmPattern::upper ? "the drive computes nothing by them"
                                                                    : "";
  if (belief == Belief::winding) return leaves_winding(s) ? "no current loop is designed by it" : "";
  return speed ? "" : no_speed;
}

}  // namespace

std::string_view idle_belief(const Scenario& s, Belief belief) {
  if (belief == Belief::sensor_offset)
    return follows_shaft(s) ? "" : "no encoder, absolute encoder or resolver gives the motor's angle";
  if (belief == Belief::hall_lines) return reads_hall(s) ? "" : "the drive does not read Hall probes";
  return idle_of_loops(s, belief);
}

void unused_beliefs(const Scenario& s, Unused& out) {
  const Believed& b = s.believed;
  const auto add = [&](Belief belief, const char* key, const auto& given, const auto& usual) {
    if (const std::string_view why = idle_belief(s, belief); !why.empty())
      out.add(std::string("believed.") + key, given, usual, std::string(why));
  };
  add(Belief::sensor_offset, "sensor_offset_deg", b.sensor_offset_deg, 0.0);
  add(Belief::hall_lines, "hall_lines", b.hall_lines, rig::WireOrder::abc);
  add(Belief::pole_pairs, "pole_pairs", b.pole_pairs, std::optional<int>());
  const auto quantity = [&](Belief belief, const char* key, const std::optional<base::Quantity>& given) {
    add(belief, given && !given->key.empty() ? given->key.c_str() : key, given.has_value(), false);
  };
  quantity(Belief::inertia, "inertia_gcm2", b.inertia_gcm2);
  quantity(Belief::torque_constant, "torque_constant_mNm_A", b.torque_constant_mNm_A);
  quantity(Belief::torque_constant, "back_emf_mV_s", b.back_emf_mV_s);
  quantity(Belief::torque_constant, "torque_constant_Nm_A", b.torque_constant_Nm_A);
  quantity(Belief::torque_constant, "flux_linkage_mWb", b.flux_linkage_mWb);
  quantity(Belief::torque_constant, "speed_constant_rpm_V", b.speed_constant_rpm_V);
  quantity(Belief::winding, "resistance_ohm", b.resistance_ohm);
  quantity(Belief::winding, "inductance_mH", b.inductance_mH);
  quantity(Belief::winding, "d_axis_inductance_mH", b.d_axis_inductance_mH);
  quantity(Belief::winding, "q_axis_inductance_mH", b.q_axis_inductance_mH);
}

}  // namespace sixstep::study
