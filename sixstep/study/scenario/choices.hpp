// SPDX-License-Identifier: Apache-2.0
// The words for enumerations in a scenario file, and their meanings.
#pragma once
#include "sixstep/base/describe.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

using base::Choice;

inline constexpr Choice<Device> device_choices[] = {
    {"mosfet", Device::mosfet,
     "a channel that is on conducts in both directions; its diode carries no current"},
    {"igbt", Device::igbt, "a transistor that is on conducts in one direction, its diode in the other"},
};
inline constexpr Choice<SourceKind> source_choices[] = {
    {"steady", SourceKind::steady, "a voltage behind resistance_ohm"},
    {"battery", SourceKind::battery,
     "a battery: a voltage that depends on the charge, and a part of the voltage that recovers slowly after a load"},
    {"single-phase", SourceKind::single_phase, "mains of one phase behind a bridge of four diodes"},
    {"three-phase", SourceKind::three_phase, "mains of three phases behind a bridge of six diodes"},
};
inline constexpr Choice<Between> between_choices[] = {
    {"steps", Between::steps, "each value applies until the next value"},
    {"lines", Between::lines, "along a line"},
};
inline constexpr Choice<rig::WireOrder> phase_order_choices[] = {
    {"abc", rig::WireOrder::abc, "each phase at its own leg"},
    {"bca", rig::WireOrder::bca, "phases b, c, a at legs a, b, c: all three are moved forward"},
    {"cab", rig::WireOrder::cab, "phases c, a, b at legs a, b, c: all three are moved back"},
    {"acb", rig::WireOrder::acb, "phases b and c swapped"},
    {"cba", rig::WireOrder::cba, "phases a and c swapped"},
    {"bac", rig::WireOrder::bac, "phases a and b swapped"},
};
inline constexpr Choice<Alignment> alignment_choices[] = {
    {"edge", Alignment::edge, "on-time starts with the period"},
    {"centre", Alignment::centre, "on-time lies in the middle of the period"},
};
inline constexpr Choice<control::Chopping> chopping_choices[] = {
    {"soft", control::Chopping::soft, "only the source phase's upper switch is chopped"},
    {"hard", control::Chopping::hard, "both switches of the driven pair are chopped together"},
    {"complementary", control::Chopping::complementary,
     "as soft, and the source phase's lower switch is on while its upper switch is off"},
};
inline constexpr Choice<control::PwmPattern> pattern_choices[] = {
    {"upper", control::PwmPattern::upper, "the upper switch; the lower switch stays on (H_PWM-L_ON)"},
    {"lower", control::PwmPattern::lower, "the lower switch; the upper switch stays on (H_ON-L_PWM)"},
    {"pwm-on", control::PwmPattern::pwm_on,
     "the entering leg's switch; this leg has conducted since the last commutation"},
    {"on-pwm", control::PwmPattern::on_pwm,
     "the staying leg's switch; this leg already conducted before the last commutation"},
    {"pwm-on-pwm", control::PwmPattern::pwm_on_pwm,
     "the entering leg's switch in the first half of a sector, the staying leg's in the second: the free "
     "phase conducts in at most one off-time per sector"},
};
static_assert(std::size(pattern_choices) == control::pwm_patterns);
inline constexpr Choice<CommutationAt> commutation_choices[] = {
    {"hall-edge", CommutationAt::hall_edge, "the pair changes at the Hall edge itself"},
    {"sample", CommutationAt::sample, "the pair changes at the next control sample"},
};
inline constexpr Choice<SampleAt> sample_choices[] = {
    {"start", SampleAt::start, "at the start of the period, before the switches change at this instant"},
    {"middle", SampleAt::middle,
     "in the middle of the period; the answer takes effect at the start of the next period"},
};
inline constexpr Choice<FirmwareKind> drive_choices[] = {
    {"lean", FirmwareKind::lean, "only the control loops; their measurements are ideal, or as in [sensors]"},
    {"product", FirmwareKind::product,
     "the complete firmware: offset calibration, Hall decoding, fault monitor and state machine around the "
     "loops. Needs converters in [sensors] and thresholds in [protection]"},
    {"sensorless", FirmwareKind::sensorless,
     "the loops without a rotor position sensor: open-loop start, then back-EMF, as in "
     "[control.sensorless]. Needs pwm.alignment = \"centre\" and pwm.sample = \"middle\""},
    {"field-oriented", FirmwareKind::field,
     "sine currents on three legs, controlled along the magnet and across the magnet, as in [control.field]. The controlled current is the amplitude i_q. Needs pwm.alignment = \"centre\""},
    {"own", FirmwareKind::own,
     "the user's controller, compiled into a shared object that [control.own] names"},
};
inline constexpr Choice<control::Mode> mode_choices[] = {
    {"off", control::Mode::off, "all six gates off"},
    {"duty", control::Mode::duty, "the reference is the signed duty, -1 to 1"},
    {"current", control::Mode::current, "the reference is the motor current in A"},
    {"speed", control::Mode::speed, "the reference is the speed in rad/s"},
    {"position", control::Mode::position, "the reference is the position in deg, counted over turns"},
};
inline constexpr Choice<Arithmetic> arithmetic_choices[] = {
    {"double", Arithmetic::float64, "the controller computes with 64-bit floating point"},
    {"float", Arithmetic::float32, "the controller computes with 32-bit floating point, as on the chip"},
    {"q15", Arithmetic::q15, "16-bit fixed point, -1 to 1 - 2^-15: the largest duty is one digit below 1"},
    {"q14", Arithmetic::q14, "16-bit fixed point, -2 to 2 - 2^-14: has the duty 1, and half the resolution"},
    {"q31", Arithmetic::q31, "32-bit fixed point, -1 to 1 - 2^-31"},
    {"q30", Arithmetic::q30, "32-bit fixed point, -2 to 2 - 2^-30: has the duty 1"},
};
inline constexpr Choice<CurrentLoopType> current_loop_choices[] = {
    {"pi", CurrentLoopType::pi, "discrete PI with clamped output, one step per control period"},
    {"hysteresis", CurrentLoopType::hysteresis,
     "on-off control: the switch turns on below the band and off above the band"},
    {"deadbeat", CurrentLoopType::deadbeat,
     "deadbeat: the voltage that brings the current of a winding with the sheet's R and L to its reference one period after the command acts"},
};
inline constexpr Choice<CurrentFeedback> current_feedback_choices[] = {
    {"mean", CurrentFeedback::mean, "half the difference of the driven pair's currents"},
    {"staying-phase", CurrentFeedback::staying_phase,
     "the current of the phase that conducts before and after a commutation: the loop reacts later than with the mean, and the torque dips deeper"},
};
inline constexpr Choice<CurrentCommutation> current_commutation_choices[] = {
    {"plain", CurrentCommutation::plain, "the loop continues unchanged"},
    {"duty-step", CurrentCommutation::duty_step,
     "the loop pauses; the duty keeps the staying phase's current constant while the current moves between "
     "the other two. Best with pwm.pattern = \"pwm-on\" or \"pwm-on-pwm\"; other patterns do not remove the current's peak"},
    {"overlap", CurrentCommutation::overlap,
     "as duty-step; where even duty 1 is too small, the leaving phase's leg supplies the missing voltage"},
};
inline constexpr Choice<SpeedOutput> speed_output_choices[] = {
    {"current", SpeedOutput::current,
     "a part of the full torque, which the inner current loop receives as its reference"},
    {"duty", SpeedOutput::duty, "the duty: no current is measured or limited (thesis 6.2.2)"},
};
inline constexpr Choice<SpeedLaw> speed_law_choices[] = {
    {"pi", SpeedLaw::pi,
     "proportional and integral part of the error, in one of the forms of control.speed.form"},
    {"state-feedback", SpeedLaw::state_feedback,
     "linear-quadratic, on speed and torque, with an observer for the load; its model has inertia, "
     "friction and the torque's delay"},
    {"disturbance-rejection", SpeedLaw::disturbance_rejection,
     "active disturbance rejection: an observer estimates all accelerations except the full torque's, and "
     "the controller compensates them"},
    {"sliding-mode", SpeedLaw::sliding_mode,
     "sliding mode: the full torque against each deviation from the motion of a drive without load; in a boundary layer, torque in proportion to the deviation"},
};
inline constexpr Choice<SpeedForm> speed_form_choices[] = {
    {"incremental", SpeedForm::incremental,
     "velocity form: each sample adds to the last output, which is kept within its limit, so that nothing can wind up"},
    {"positional", SpeedForm::positional,
     "kp times the error, plus the integral, minus a derivative; anti_windup sets how the integral follows the limit"},
};
inline constexpr Choice<HysteresisOn> hysteresis_choices[] = {
    {"motor", HysteresisOn::motor, "one comparator on the motor current (i_p - i_n)/2"},
    {"phase", HysteresisOn::phase, "comparators on the currents of the driven phases"},
};
inline constexpr Choice<Comparator> comparator_choices[] = {
    {"event", Comparator::event, "acts at the instant at which the current leaves the band"},
    {"sampled", Comparator::sampled, "compares the current with the band once per control period"},
};
inline constexpr Choice<Shape> shape_choices[] = {
    {"constant", Shape::constant, "value throughout"},
    {"steps", Shape::steps, "values[n] applies from times_s[n] on"},
    {"square", Shape::square, "the value high in the first half of each period, low in the second half"},
    {"ramp", Shape::ramp, "a straight line from start to end, from begin_s until end_s or at the rate slope"},
    {"sine", Shape::sine, "offset + amplitude sin(360 deg frequency_Hz t + phase_deg)"},
    {"trapezoid", Shape::trapezoid,
     "from start to end at a rate that rises with acceleration, stays at slope and falls again: the usual "
     "profile of a move"},
    {"csv", Shape::csv, "through the rows of a file, or through times_s and values"},
};
inline constexpr Choice<Interpolation> interpolation_choices[] = {
    {"linear", Interpolation::linear, "linear between two rows"},
    {"hold", Interpolation::hold, "each value applies until the next row"},
};
inline constexpr Choice<DriveRequest> request_choices[] = {
    {"none", DriveRequest::none, "nothing new"},
    {"off", DriveRequest::off, "ends the request to run: the drive brakes, then turns off"},
    {"on", DriveRequest::on, "raises the request to run"},
    {"clear", DriveRequest::clear, "clears a fault if its cause has ended"},
};
inline constexpr Choice<Distribution> distribution_choices[] = {
    {"uniform", Distribution::uniform, "all values within the half width are equally likely"},
    {"normal", Distribution::normal, "bell curve, cut off at cut_sigma standard deviations"},
};

/// Unit of a reference; the control mode alone determines it. Empty for a mode without a reference.
constexpr std::string_view reference_unit(control::Mode mode) {
  switch (mode) {
    case control::Mode::off:
      return "";
    case control::Mode::duty:
      return "1";
    case control::Mode::current:
      return "A";
    case control::Mode::speed:
      return "rad/s";
    case control::Mode::position:
      return "deg";
  }
  return "";
}

}  // namespace sixstep::study
