// SPDX-License-Identifier: Apache-2.0
// Makes some of the lean drives field-oriented, without the keys of six-step. The keys are drawn last, so
// that the other values of a seed do not change.
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "tests/fuzz/drawn_parts.hpp"

namespace sixstep::testing {

using namespace study;
using control::Mode;

namespace {

/// Sets three legs with centred pulses, and loops that control currents.
void leave_six_step(Draw& draw, Scenario& s, const Scales& of) {
  Control& c = s.control;
  c.arithmetic = draw.chance(0.5) ? Arithmetic::float64 : Arithmetic::float32;
  s.pwm.alignment = Alignment::centre;
  s.pwm.chopping = control::Chopping::soft;
  s.pwm.commutation = CommutationAt::hall_edge;
  if (c.mode == Mode::duty) {
    c.mode = Mode::current;
    c.slew.reset();
    s.reference = drawn_reference(draw, s, of, s.duration_s);
    for (At& at : s.at)
      if (at.reference) at.reference = drawn_reference(draw, s, of, s.duration_s - at.time_s);
  }
  if (c.current.type != CurrentLoopType::pi) c.current = {.limit_A = c.current.limit_A};
  c.current.back_emf_feed_forward = false;
  c.current.measured_bus_from_V.reset();
  c.limits = {};
  c.regeneration = {};
  c.smooth_chopping = {};
  if (c.speed.output == SpeedOutput::duty && (c.mode == Mode::speed || c.mode == Mode::position)) {
    c.speed.output = SpeedOutput::current;
    c.speed.torque_limit_Nm = of.kept_A * of.K_t_Nm_A;
  }
}

void draw_keys(Draw& draw, Scenario& s, const design::MotorModel& motor) {
  Field& f = s.control.field;
  const CurrentLoop& loop = s.control.current;
  const bool has_gains = loop.d1 || loop.d0 || loop.kp || loop.ki || loop.settle_s || loop.damping;
  if (!has_gains && draw.chance(0.6)) f.bandwidth_Hz = draw.decades(2e-3, 0.1) / s.pwm.period_s;
  if (draw.chance(0.2)) f.voltage_limit = control::VoltageLimit::axes;
  f.decoupling = draw.chance(0.7);
  f.torque_per_ampere = draw.chance(0.8);
  if (draw.chance(0.2)) f.advance_periods = draw.between(0, 3);
  if (f.voltage_limit == control::VoltageLimit::circle && draw.chance(0.4))
    f.weakening_A =
        draw.between(0.05, 0.99) * design::most_weakening_A(design::field_machine(motor, s.sheet));
}

/// Makes some drives sensorless. If the rotor is salient and saturates, pulses find its angle. Other rotors
/// are started open-loop until the observer follows them.
void leave_sensors(Draw& draw, Scenario& s, const Scales& of) {
  if (s.sensors.rotor != RotorSensing::ideal || s.control.mode == Mode::position || !draw.chance(0.3)) return;
  Field& f = s.control.field;
  const bool salient = s.sheet.d_axis_inductance_mH &&
                       s.sheet.q_axis_inductance_mH->value > 1.2 * s.sheet.d_axis_inductance_mH->value;
  if (salient && s.pwm.sample == SampleAt::start && draw.chance(0.7)) {
    s.sheet.saturation_current_A = base::Quantity{of.kept_A * draw.between(3.0, 6.0), "", ""};
    f.angle = draw.chance(0.5) ? FieldAngle::injection : FieldAngle::injection_observer;
  } else {
    f.angle = FieldAngle::observer;
    if (draw.chance(0.3)) f.start_current_A = of.kept_A * draw.between(0.3, 1.0);
  }
  if (draw.chance(0.2)) f.angle_bandwidth_Hz = draw.decades(2e-3, 0.05) / s.pwm.period_s;
}

/// Draws harmonic currents and the selection of the legs' states. They are drawn after the keys above, so
/// that a seed gives these keys the same values as before.
void draw_more_keys(Draw& draw, Scenario& s) {
  Field& f = s.control.field;
  if (!design::is_salient(s.sheet) && draw.chance(0.4)) f.harmonic_current = true;
  if (!draw.chance(0.25) || f.angle != FieldAngle::sensors) return;
  f.law = FieldLaw::finite_set;
  f.bandwidth_Hz.reset();
  f.voltage_limit = control::VoltageLimit::circle;
  f.decoupling = true;
  f.weakening_A.reset();
  f.advance_periods.reset();
  s.control.current = {.limit_A = s.control.current.limit_A};
  for (At& at : s.at) static_cast<AtGains&>(at.control.current) = {};
  s.pwm.sample = SampleAt::start;
  if (draw.chance(0.4)) f.switching_weight_A = draw.decades(1e-2, 1);
  if (draw.chance(0.3)) f.peak_A = draw.decades(0.5, 50);
  if (draw.chance(0.2)) f.delay_compensation = false;
}

/// Sets sensors that measure an angle and three currents.
void keep_angles(Draw& draw, Scenario& s) {
  Sensors& x = s.sensors;
  if (x.currents == rig::CurrentMeasurement::dc_link) x.currents = rig::CurrentMeasurement::phases;
  if (x.rotor == RotorSensing::hall && x.hall_angle == rig::HallAngleFrom::sectors)
    x.hall_angle = draw.chance(0.7) ? rig::HallAngleFrom::angle : rig::HallAngleFrom::learned_edges;
  x.encoder.referenced = true;
  x.shaft = SensorShaft::motor;
}

/// Some figures use the signals of the d and q axes.
void ask_of_axes(Draw& draw, Scenario& s) {
  static constexpr Signal signals[] = {Signal::direct_current,
                                       Signal::quadrature_current,
                                       Signal::direct_current_reference,
                                       Signal::quadrature_current_reference,
                                       Signal::direct_voltage,
                                       Signal::quadrature_voltage,
                                       Signal::angle_error};
  if (s.control.mode == Mode::off) return;
  for (Requirement& r : s.require)
    if (r.measure.signal == Signal::phase_a && draw.chance(0.6))
      r.measure.signal = signals[draw.one_of(static_cast<int>(std::size(signals)))];
  if (!s.record.columns.empty()) s.record.columns = {"i_d_A", "i_q_ref_A", "v_q_V"};
}

}  // namespace

void draw_field(Draw& draw, Scenario& s, const Scales& of) {
  if (s.control.drive != FirmwareKind::lean || s.sheet.kind == design::MotorKind::linear) return;
  if (!draw.chance(0.3)) return;
  s.control.drive = FirmwareKind::field;
  leave_six_step(draw, s, of);
  keep_angles(draw, s);
  if (s.sheet.back_emf == design::BackEmfShape::sine && s.sheet.inductance_mH && draw.chance(0.4)) {
    const double L_mH = s.sheet.inductance_mH->value / 2;  // inductance of a phase
    s.sheet.inductance_mH.reset();
    s.sheet.d_axis_inductance_mH = base::Quantity{L_mH * draw.between(0.5, 1.0), "", ""};
    s.sheet.q_axis_inductance_mH = base::Quantity{L_mH * draw.between(1.0, 1.8), "", ""};
  }
  if (const auto motor = design::motor_model(s.sheet)) draw_keys(draw, s, *motor);
  leave_sensors(draw, s, of);
  ask_of_axes(draw, s);
  draw_more_keys(draw, s);
}

}  // namespace sixstep::testing
