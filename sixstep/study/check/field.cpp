// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/field.hpp"

#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/field_description.hpp"
#include "sixstep/study/scenario/measure_choices.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {

namespace {

constexpr const char* other_drive = "remove this key, or set control.drive = \"lean\"";

/// Requires centred pulses with all three legs complementary.
void check_pwm(const Scenario& s, base::Problems& out) {
  if (s.pwm.alignment != Alignment::centre)
    out.push_back(
        {"pwm.alignment", "\"edge\"",
         "puts the pulses at the start of the period, and the field-oriented drive needs centred pulses",
         "set alignment = \"centre\""});
  if (s.pwm.chopping != control::Chopping::soft)
    out.push_back(
        {"pwm.chopping", std::string(base::word(chopping_choices, s.pwm.chopping)),
         "applies to six-step only: the field-oriented drive switches all three legs complementarily",
         other_drive});
  if (s.pwm.pattern != control::PwmPattern::upper)
    out.push_back({"pwm.pattern", std::string(base::word(pattern_choices, s.pwm.pattern)),
                   "applies to six-step only: the field-oriented drive chops all three legs", other_drive});
  if (s.pwm.commutation != CommutationAt::hall_edge)
    out.push_back({"pwm.commutation", "\"sample\"",
                   "applies to six-step only: the field-oriented drive has no commutation", other_drive});
}

void check_field_loops(const Scenario& s, base::Problems& out) {
  const Control& c = s.control;
  const auto refuse = [&out](bool given, const char* key, const char* limit, const char* cure) {
    if (given) out.push_back({key, "", limit, cure});
  };
  refuse(c.mode == control::Mode::duty, "control.mode",
         "= \"duty\" applies to a driven pair, which the field-oriented drive does not have",
         "set mode = \"current\", \"speed\" or \"position\"");
  if (c.arithmetic != Arithmetic::float64 && c.arithmetic != Arithmetic::float32)
    out.push_back({"control.arithmetic", std::string(base::word(arithmetic_choices, c.arithmetic)),
                   "is fixed point, for which the field-oriented drive has no proven scaling",
                   "set arithmetic = \"float\" or \"double\""});
  refuse(c.current.type == CurrentLoopType::deadbeat, "control.current.type",
         "= \"deadbeat\" predicts for a driven pair, which the field-oriented drive does not have",
         "set type = \"pi\"");
  refuse(c.current.feedback != CurrentFeedback::mean, "control.current.feedback",
         "applies to commutation, which the field-oriented drive does not have", "remove this key");
  refuse(c.current.commutation != CurrentCommutation::plain, "control.current.commutation",
         "applies to commutation, which the field-oriented drive does not have", "remove this key");
  refuse(c.current.type == CurrentLoopType::hysteresis, "control.current.type",
         "= \"hysteresis\" applies to a driven pair, which the field-oriented drive does not have",
         "set type = \"pi\"");
  refuse(c.speed.output == SpeedOutput::duty, "control.speed.output",
         "= \"duty\" applies to a driven pair, which the field-oriented drive does not have",
         "set output = \"current\"");
  const char* const of_pair = "applies to the current loop of six-step only";
  refuse(c.current.back_emf_feed_forward, "control.current.back_emf_feed_forward", of_pair,
         "remove this key: control.field.decoupling adds the induced voltages");
  refuse(c.current.measured_bus_from_V.has_value(), "control.current.measured_bus_from_V", of_pair,
         "remove this key: the field-oriented drive always uses the measured bus voltage");
  const Limits& l = c.limits;
  refuse(l.current_A || l.torque_Nm || l.speed_rad_s, "control.limits", of_pair,
         "remove this key; control.current.limit_A limits the current below a speed or position loop");
  refuse(c.regeneration.limit_V.has_value(), "control.regeneration", of_pair, other_drive);
  refuse(c.smooth_chopping.on, "control.smooth_chopping", of_pair, other_drive);
}

/// Refuses keys that apply to a measured angle, because this drive estimates the angle.
void check_unsensed(const Scenario& s, base::Problems& out) {
  const auto angle = [&s] { return std::string(base::word(field_angle_choices, s.control.field.angle)); };
  if (s.sensors.rotor != RotorSensing::ideal)
    out.push_back({"sensors.rotor", std::string(base::word(rotor_sensing_choices, s.sensors.rotor)),
                   "has no effect where control.field.angle is " + angle(),
                   "remove this key, or set control.field.angle = \"sensors\""});
  if (s.control.field.law == FieldLaw::finite_set)
    out.push_back({"control.field.law", "\"finite-set\"",
                   "makes no PWM pulses, and control.field.angle = " + angle() + " needs PWM pulses",
                   "set law = \"pi\", or control.field.angle = \"sensors\""});
  if (s.control.mode == control::Mode::position)
    out.push_back({"control.mode", "\"position\"",
                   "needs a sensor that counts turns, and an estimated angle does not count turns",
                   "set control.mode = \"speed\" or \"current\", or control.field.angle = \"sensors\""});
  if (s.control.field.angle != FieldAngle::observer && s.pwm.sample == SampleAt::middle)
    out.push_back(
        {"pwm.sample", "\"middle\"",
         "samples at an instant at which the current of the injected pulse is zero and cannot be measured",
         "set sample = \"start\""});
  if (s.sheet.kind == design::MotorKind::linear)
    out.push_back({"control.drive", "\"field-oriented\"",
                   "applies to rotary motors only, and this motor is linear",
                   "set drive = \"lean\" or \"product\""});
}

/// Requires a measurement of the phase currents, and a sensor that gives the angle of the motor's shaft at
/// every sample.
void check_sensing(const Scenario& s, base::Problems& out) {
  const Sensors& x = s.sensors;
  if (x.currents == rig::CurrentMeasurement::dc_link)
    out.push_back(
        {"sensors.currents", "\"dc-link\"",
         "measures only the current of a driven pair, and the field-oriented drive needs all phase currents",
         "set currents = \"phases\", \"low-side\" or \"ideal\""});
  if (s.control.field.angle != FieldAngle::sensors) return check_unsensed(s, out);
  if (x.rotor == RotorSensing::hall && x.hall_angle == rig::HallAngleFrom::sectors)
    out.push_back({"sensors.hall_angle", "\"sectors\"", "gives no angle between two Hall edges",
                   "set hall_angle = \"interpolated\" or \"calibrated\""});
  if (x.rotor == RotorSensing::encoder && !x.encoder.referenced)
    out.push_back({"sensors.encoder.referenced", "false", "gives no angle before the rotor passes the index",
                   "set referenced = true"});
  if (x.shaft == SensorShaft::load && x.rotor != RotorSensing::ideal && x.rotor != RotorSensing::hall)
    out.push_back(
        {"sensors.shaft", "\"load\"", "does not measure the magnet's angle", "set shaft = \"motor\""});
  if (s.sheet.kind == design::MotorKind::linear)
    out.push_back({"control.drive", "\"field-oriented\"",
                   "applies to rotary motors only, and this motor is linear",
                   "set drive = \"lean\" or \"product\""});
}

void check_keys(const Scenario& s, base::Problems& out) {
  const Field& f = s.control.field;
  const CurrentLoop& loop = s.control.current;
  if (f.bandwidth_Hz && (gives_gains(loop)))
    out.push_back(
        {"control.field.bandwidth_Hz", "",
         "contradicts the gains in control.current: the gains are both given and designed from the bandwidth",
         "remove control.field.bandwidth_Hz, or the gains in control.current"});
  const bool injects = f.angle == FieldAngle::injection || f.angle == FieldAngle::injection_observer;
  const bool observes = f.angle == FieldAngle::observer || f.angle == FieldAngle::injection_observer;
  const auto needs = [&out](bool given, bool serves, const char* key, const char* of, const char* cure) {
    if (given && !serves) out.push_back({key, "", of, cure});
  };
  needs(f.angle_bandwidth_Hz.has_value(), injects || observes, "control.field.angle_bandwidth_Hz",
        "applies to an estimated angle only, and this drive measures the angle",
        "remove this key, or set control.field.angle = \"observer\" or \"injection\"");
  needs(f.injection_V.has_value(), injects, "control.field.injection_V",
        "has no effect, because control.field.angle has no injection",
        "remove this key, or set control.field.angle = \"injection\"");
  needs(f.observer_from_rad_s.has_value(), observes, "control.field.observer_from_rad_s",
        "applies to an observer, which the drive does not have",
        "remove this key, or set control.field.angle = \"observer\"");
  needs(f.start_current_A.has_value(), observes && !injects, "control.field.start_current_A",
        "turns a rotor whose angle is unknown at rest, and this drive measures the angle at rest",
        "remove this key, or set control.field.angle = \"observer\"");
  if (f.weakening_A && f.voltage_limit != control::VoltageLimit::circle)
    out.push_back({"control.field.weakening_A", "",
                   "needs control.field.voltage_limit = \"circle\", but the limit is \"axes\"",
                   "set control.field.voltage_limit = \"circle\", or remove this key"});
  if (f.harmonic_current && design::is_salient(s.sheet))
    out.push_back(
        {"control.field.harmonic_current", "true",
         "is computed only for a round rotor, but d_axis_inductance_mH and q_axis_inductance_mH differ",
         "remove this key, or give the motor one inductance_mH"});
}

}  // namespace

void check_pair_figures(const Scenario& s, base::Problems& out) {
  const auto refuse = [&out](const Measure& m, const std::string& where) {
    if (fact_of(m.metric).of == TakenOf::commutations)
      out.push_back({where + ".metric", "",
                     "applies to commutation, which a drive of three legs does not have",
                     "use another metric"});
  };
  for (std::size_t n = 0; n < s.require.size(); ++n)
    refuse(s.require[n].measure, "require[" + std::to_string(n) + "]");
  for (std::size_t n = 0; n < s.compare.size(); ++n)
    refuse(s.compare[n].measure, "compare[" + std::to_string(n) + "]");
}

void check_field(const Scenario& s, base::Problems& out) {
  if (s.control.drive != FirmwareKind::field) {
    if (s.control.field != Field{})
      out.push_back({"control.field", "", "applies to the field-oriented drive only",
                     "set control.drive = \"field-oriented\", or remove this key"});
    return;
  }
  check_pwm(s, out);
  check_field_loops(s, out);
  check_sensing(s, out);
  check_keys(s, out);
  check_finite_set(s, out);
  check_pair_figures(s, out);
}

}  // namespace sixstep::study
