// SPDX-License-Identifier: Apache-2.0
// Designs the loops of a scenario's controller: gains as given, or by pole placement for motor and load.
#include "sixstep/study/compile/loops.hpp"

#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/deadbeat.hpp"
#include "sixstep/design/loops/operating_limits.hpp"

namespace sixstep::study {

namespace {

/// Returns the loop's gains as given, else by pole placement. For given gains the exact design is also
/// computed, for comparison.
template <class Loop>
base::Result<LoopGains> loop_gains(const Loop& loop, const std::string& name, const design::ZohPlant& plant,
                                   double usual_settle_s, double period_s) {
  LoopGains out;
  out.loop = name;
  const double settle = loop.settle_s.value_or(usual_settle_s),
               damping = loop.damping.value_or(design::usual_damping);
  base::Result<design::PolePlacement> placed = design::place_poles(plant, settle, damping, period_s);
  const GivenGains given = given_gains(loop, period_s, "control." + name);
  if (!given.problems.empty()) return given.problems;
  if (!placed && !given.gains) return placed.problems();
  if (placed) out.derivation = *placed;
  out.d1 = given.gains ? given.gains->d1 : placed->gains.d1;
  out.d0 = given.gains ? given.gains->d0 : placed->gains.d0;
  out.origin = given.gains ? given.origin : "pole placement from settle_s and damping";
  return out;
}

control::Watch watch_of(const CurrentLoop& loop) {
  if (loop.comparator == Comparator::sampled) return control::Watch::none;
  return loop.on == HysteresisOn::motor ? control::Watch::motor : control::Watch::phase;
}

/// The chopping for which the current loop is designed. Smooth chopping alternates between two kinds of
/// chopping that apply the same voltage to the pair.
control::Chopping loop_chopping(const Scenario& s) {
  return s.control.smooth_chopping.on ? control::Chopping::complementary : s.pwm.chopping;
}

/// Control periods from a sample to the instant at which the output computed from it takes effect
/// (rig/board_config.hpp).
double wait_periods(const Pwm& pwm) {
  return pwm.delay_periods + (pwm.sample == SampleAt::middle ? 0.5 : 0.0);
}

base::Problems add_deadbeat(const Scenario& s, const Basis& basis, Tuned& out) {
  const design::LoopWinding winding = winding_of(s, basis.motor);
  const auto made =
      design::deadbeat({.R_ohm = winding.R_ohm,
                        .L_H = winding.L_H,
                        .K_t_Nm_A = winding.back_emf_V_s,
                        .period_s = s.pwm.period_s,
                        .wait_periods = wait_periods(s.pwm),
                        .correction = s.control.current.correction.value_or(design::usual_correction),
                        .limit_V = basis.bus_V});
  if (!made)
    return {{"control.current.type", "\"deadbeat\"",
             "predicts over one period, but the answer comes one and a half periods after the sample",
             "set pwm.sample = \"start\", or pwm.delay_periods = 0"}};
  const control::DeadbeatConfig<double>& c = made->config;
  out.drive.extras.on = out.drive.extras.predicts_current = true;
  out.drive.extras.deadbeat = c;
  out.gains.push_back({"current", c.V_per_A, 0.0, "deadbeat, on the sheet's R and L and the control period",
                       std::nullopt, made->steps});
  design::tell_chopping(loop_chopping(s), out.gains.back().steps);
  return {};
}

base::Problems add_current_loop(const Scenario& s, const Basis& basis, Tuned& out) {
  if (s.control.current.type == CurrentLoopType::deadbeat) return add_deadbeat(s, basis, out);
  if (s.control.current.type != CurrentLoopType::pi) return {};
  const design::ZohPlant plant = design::current_plant(winding_of(s, basis.motor), s.pwm.period_s);
  base::Result<LoopGains> gains =
      loop_gains(s.control.current, "current", plant, design::usual_current_settle_s, s.pwm.period_s);
  if (!gains) return gains.problems();
  if (gains->derivation) design::tell_chopping(loop_chopping(s), gains->derivation->steps);
  out.drive.current = {gains->d1, gains->d0, basis.bus_V};
  out.gains.push_back(*gains);
  return {};
}

/// The speed's response to the speed controller's output: torque at full output, and viscous friction. The
/// output is a torque, which acts at once, or a duty d of the bus voltage U. For a duty the winding's
/// inductance is neglected, because its time constant is short (thesis 6.2.2): J dw/dt = K_t (d U - K_t w)/R
/// - B w, with inertia J, speed w, torque constant K_t, resistance R and friction B.
struct SpeedPlant {
  double full_Nm, B_Nm_s;
};
SpeedPlant speed_plant_of(const Scenario& s, const Basis& basis, double torque_limit_Nm) {
  if (s.control.speed.output == SpeedOutput::current) return {torque_limit_Nm, basis.shaft.B_Nm_s};
  const design::LoopWinding winding = winding_of(s, basis.motor);
  const double per_V = winding.torque_Nm_A / winding.R_ohm;
  return {per_V * basis.bus_V, basis.shaft.B_Nm_s + per_V * winding.back_emf_V_s};
}

base::Problems add_speed_loop(const Scenario& s, const Basis& basis, Tuned& out) {
  const double torque_limit =
      s.control.speed.torque_limit_Nm.value_or(design::usual_torque_limit_Nm(basis.motor, basis.bus_V));
  const double J = basis.shaft.J_kg_m2;
  const SpeedPlant plant = speed_plant_of(s, basis, torque_limit);
  base::Result<LoopGains> gains = loop_gains(
      s.control.speed, "speed", design::speed_plant(plant.full_Nm, J, plant.B_Nm_s, s.pwm.period_s),
      design::usual_speed_settle_s, s.pwm.period_s);
  if (!gains) return gains.problems();
  out.drive.speed = {gains->d1, gains->d0, 1.0};
  out.gains.push_back(*gains);
  if (s.control.speed.output == SpeedOutput::duty) {
    out.drive.speed_control = control::SpeedControl::duty;
    return add_speed_law(s, basis, plant.full_Nm / J, plant.B_Nm_s / J, out);
  }
  out.drive.current_at_full_torque_A = torque_limit / torque_per_A(s, basis);
  out.drive.current_limit_A = s.control.current.limit_A.value_or(out.drive.current_at_full_torque_A);
  // The PI's output limit includes the current limit. A limit after the PI, unknown to the PI, would cause
  // integral windup.
  if (out.drive.current_limit_A < out.drive.current_at_full_torque_A)
    out.drive.speed.limit = out.drive.current_limit_A / out.drive.current_at_full_torque_A;
  return add_speed_law(s, basis, plant.full_Nm / J, plant.B_Nm_s / J, out);
}

base::Problems add_loops(const Scenario& s, const Basis& basis, Tuned& out) {
  const control::Mode mode = s.control.mode;
  // A start without a rotor sensor controls a current, in every mode of control.
  const bool starts_blindly = s.control.drive == FirmwareKind::sensorless;
  if (mode == control::Mode::off || (mode == control::Mode::duty && !starts_blindly)) return {};
  const bool in_the_field = s.control.drive == FirmwareKind::field;  // the field-oriented drive has its own
                                                                     // current loops
  const bool has_current_loop = mode == control::Mode::current || mode == control::Mode::duty ||
                                starts_blindly || s.control.speed.output == SpeedOutput::current;
  if (has_current_loop && !in_the_field)
    if (base::Problems problems = add_current_loop(s, basis, out); !problems.empty()) return problems;
  if (mode == control::Mode::current || mode == control::Mode::duty) return {};
  if (base::Problems problems = add_speed_loop(s, basis, out); !problems.empty()) return problems;
  if (mode == control::Mode::speed) return {};
  out.drive.position_gain = s.control.position.gain_rad_s_per_deg;
  const std::optional<double>& limit = s.control.position.speed_limit_rad_s;
  out.drive.speed_limit_rad_s = limit.value_or(basis.bus_V / basis.motor.K_t_Nm_A);
  const bool linear = s.sheet.kind == design::MotorKind::linear;
  out.gains.push_back(
      {"position",
       out.drive.position_gain,
       0.0,
       (linear ? "given as gain_m_s_per_mm, for at most " : "given as gain_rad_s_per_deg, for at most ") +
           base::rounded(out.drive.speed_limit_rad_s, 4) + (linear ? " m/s, " : " rad/s, ") +
           (limit ? "as given" : "the bus voltage divided by K_t"),
       std::nullopt,
       {}});
  return {};
}

}  // namespace

base::Result<Tuned> tuned(const Scenario& s, const Basis& basis) {
  Tuned out;
  out.drive.mode = s.control.mode;
  out.drive.chopping = s.pwm.chopping;
  out.drive.nominal_bus_V = basis.bus_V;
  out.drive.current_control = s.control.current.type == CurrentLoopType::hysteresis
                                  ? control::CurrentControl::hysteresis
                                  : control::CurrentControl::pi;
  out.drive.hysteresis = {s.control.current.band_A, watch_of(s.control.current)};
  if (base::Problems problems = add_loops(s, basis, out); !problems.empty()) return problems;
  add_extras(s, basis, out.drive);
  add_position_profile(s, basis, out);
  // Limits are checked for the drive as designed. A drive of a series with deviating values is simulated
  // without this check.
  if (!s.designed_for) {
    base::Problems problems = check_limits(s, basis, out.drive);
    base::append(problems, check_position_profile(s, basis, out.drive));
    if (!problems.empty()) return problems;
  }
  return out;
}

design::LoopWinding winding_of(const Scenario& s, const design::MotorModel& motor) {
  return design::driven_pair(motor, loop_chopping(s));
}

double current_settling_s(const Scenario& s) {
  return s.control.current.settle_s.value_or(design::usual_current_settle_s);
}

template <class Loop>
GivenGains given_gains(const Loop& loop, double period_s, const std::string& where) {
  GivenGains out;
  const bool d = loop.d1 || loop.d0, k = loop.kp || loop.ki || loop.ki_per_s,
             rule = loop.settle_s || loop.damping;
  const auto wrong = [&](const char* key, const char* limit, const char* cure) {
    out.problems.push_back({where + "." + key, "", limit, cure});
  };
  const char* const integral = loop.ki ? "ki" : "ki_per_s";
  const char* const keep =
      "remove all forms of the gains except one: d1 and d0, kp with ki or ki_per_s, or settle_s and damping";
  if (d && (k || rule))
    wrong(loop.d1 ? "d1" : "d0",
          k ? "contradicts kp and ki or ki_per_s, which give the same gains"
            : "contradicts settle_s and damping, which compute the gains",
          keep);
  else if (k && rule)
    wrong(loop.kp ? "kp" : integral, "contradicts settle_s and damping, which compute the gains", keep);
  else if (d && !(loop.d1 && loop.d0))
    wrong(loop.d1 ? "d1" : "d0", "is only one of the two gains", loop.d1 ? "add d0" : "add d1");
  else if (loop.ki && loop.ki_per_s)
    wrong("ki_per_s", "contradicts ki: both keys give the integral gain", "remove ki or ki_per_s");
  else if (k && !(loop.kp && (loop.ki || loop.ki_per_s)))
    wrong(loop.kp ? "kp" : integral, "is only one of the two gains",
          loop.kp ? "add ki or ki_per_s" : "add kp");
  else if (d)
    out = {design::PiGains{*loop.d1, *loop.d0}, "given as d1, d0", {}};
  else if (loop.ki)
    out = {design::PiGains{*loop.kp, *loop.ki - *loop.kp}, "given as kp, ki", {}};
  else if (k)
    out = {design::PiGains{*loop.kp, *loop.ki_per_s * period_s - *loop.kp}, "given as kp, ki_per_s", {}};
  return out;
}
template GivenGains given_gains<CurrentLoop>(const CurrentLoop&, double, const std::string&);
template GivenGains given_gains<SpeedLoop>(const SpeedLoop&, double, const std::string&);

}  // namespace sixstep::study
