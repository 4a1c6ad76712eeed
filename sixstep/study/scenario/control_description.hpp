// SPDX-License-Identifier: Apache-2.0
// The keys of [control]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/control.hpp"
#include "sixstep/study/scenario/field_description.hpp"
#include "sixstep/study/scenario/linear_words.hpp"
#include "sixstep/study/scenario/own_description.hpp"
#include "sixstep/study/scenario/sensorless_description.hpp"

namespace sixstep::study {

using base::above;
using base::between;
using base::from;

/// Meanings of a PI's gains. They differ between the loops in the unit only: V/A in a current loop, full
/// output per rad/s in a speed loop.
struct GainMeanings {
  std::string_view d1, d0, kp, ki, ki_per_s;
};
inline constexpr GainMeanings current_gain_meanings{
    "gain on the present error of (d1 z + d0)/(z - 1), V/A, with d0",
    "gain on the previous error of (d1 z + d0)/(z - 1), V/A, with d1",
    "proportional gain, V/A, given with ki or ki_per_s; equal to d1",
    "integral gain per sample, V/A, given with kp; equal to d1 + d0",
    "integral gain per second, V/A per s, given with kp, as in other tools; ki = ki_per_s times pwm.period_s"};
inline constexpr GainMeanings speed_gain_meanings{
    "gain on the present error of (d1 z + d0)/(z - 1), full output per rad/s, with d0",
    "gain on the previous error of (d1 z + d0)/(z - 1), full output per rad/s, with d1",
    "proportional gain, full output per rad/s, given with ki or ki_per_s; equal to d1",
    "integral gain per sample, full output per rad/s, given with kp; equal to d1 + d0",
    "integral gain per second, full output per rad, given with kp, as in other tools; ki = ki_per_s times pwm.period_s"};

template <class Loop>
void describe_gains(base::Visitor& v, Loop& s, const GainMeanings& of) {
  v.value("settle_s", s.settle_s,
          {.meaning = "settling time for which the poles are placed, given with damping",
           .unit = "s",
           .range = above(0)});
  v.value("damping", s.damping,
          {.meaning = "damping of the placed pole pair, given with settle_s",
           .range = base::Range{0, 1, false, true}});
  v.value("d1", s.d1, {.meaning = of.d1});
  v.value("d0", s.d0, {.meaning = of.d0});
  v.value("kp", s.kp, {.meaning = of.kp});
  v.value("ki", s.ki, {.meaning = of.ki});
  v.value("ki_per_s", s.ki_per_s, {.meaning = of.ki_per_s});
}

inline void describe(base::Visitor& v, CurrentLoop& s) {
  v.choice("type", s.type, current_loop_choices, {.meaning = "kind of the current controller"});
  describe_gains(v, s, current_gain_meanings);
  v.value(
      "band_A", s.band_A,
      {.meaning = "hysteresis: half width of the band around the reference", .unit = "A", .range = above(0)});
  v.choice("on", s.on, hysteresis_choices,
           {.meaning = "hysteresis: which current is compared with the band"});
  v.choice("comparator", s.comparator, comparator_choices,
           {.meaning = "hysteresis: when the current is compared with the band"});
  v.choice("feedback", s.feedback, current_feedback_choices,
           {.meaning = "which current the PI or deadbeat controller reads"});
  v.choice("commutation", s.commutation, current_commutation_choices,
           {.meaning = "pi: how the loop acts during a commutation"});
  v.value(
      "correction", s.correction,
      {.meaning =
           "deadbeat: fraction of the prediction error that each sample corrects by a voltage. Default: 0.25",
       .range = base::Range{0, 1, false, true}});
  v.value(
      "limit_A", s.limit_A,
      {.meaning = "bound on an outer loop's current reference; the outer loop's integral stops at this bound",
       .unit = "A",
       .range = above(0)});
  v.value("back_emf_feed_forward", s.back_emf_feed_forward,
          {.meaning = "pi: whether the back-EMF at the measured speed is added to the voltage"});
  v.value("measured_bus_from_V", s.measured_bus_from_V,
          {.meaning = "pi: lowest bus voltage for which the duty follows the measured bus. Default: the "
                      "duty uses supply.voltage_V",
           .unit = "V",
           .range = above(0)});
}

inline void describe(base::Visitor& v, SpeedLoop& s) {
  v.choice("output", s.output, speed_output_choices,
           {.meaning = "quantity that the speed controller commands"});
  v.choice("law", s.law, speed_law_choices,
           {.meaning = "algorithm of the speed controller; each algorithm is designed for settle_s"});
  v.choice("form", s.form, speed_form_choices,
           {.meaning = "form of the speed controller's PI; below the limit both forms are equal"});
  describe_gains(v, s, speed_gain_meanings);
  v.value("torque_limit_Nm", s.torque_limit_Nm,
          {.meaning = "torque at the speed controller's full output. Default: torque of 2.5 times the "
                      "sheet's nominal current",
           .unit = "N m",
           .range = above(0),
           .also = words::force_limit});
  v.value("anti_windup", s.anti_windup,
          {.meaning = "positional: fraction of the clamped excess that each sample subtracts from the "
                      "integral. 0: the integral winds up. Default: ki/kp",
           .range = between(0, 1)});
  v.value(
      "derivative_s", s.derivative_s,
      {.meaning =
           "positional: derivative time; kp times this time, times the measured acceleration, is subtracted from the output",
       .unit = "s",
       .range = above(0)});
  v.value("derivative_filter_s", s.derivative_filter_s,
          {.meaning = "time constant that smooths the derivative. Default: a tenth of derivative_s",
           .unit = "s",
           .range = from(0)});
  v.value("setpoint_weight", s.setpoint_weight,
          {.meaning =
               "positional: fraction of the setpoint in the proportional part; 0: I-P controller. Default: 1",
           .range = between(0, 1)});
  v.value(
      "observer_ratio", s.observer_ratio,
      {.meaning =
           "state-feedback, disturbance-rejection, sliding-mode: ratio of settle_s to the time in which a "
           "load is estimated, or the surface reached. Default: 5",
       .range = between(1, 20)});
}

inline void describe(base::Visitor& v, PositionProfile& s) {
  v.value("on", s.on,
          {.meaning = "whether the setpoint moves within limits of speed, acceleration and jerk"});
  v.value("speed_rad_s", s.speed_rad_s,
          {.meaning = "fastest speed of a move. Default: nine tenths of the highest speed at which the bus "
                      "can still drive the acceleration, or of speed_limit_rad_s if that is lower",
           .unit = "rad/s",
           .range = above(0),
           .also = words::speed});
  v.value("acceleration_rad_s2", s.acceleration_rad_s2,
          {.meaning = "largest acceleration. Default: acceleration of four fifths of the torque limit",
           .unit = "rad/s2",
           .range = above(0),
           .also = words::acceleration});
  v.value("jerk_rad_s3", s.jerk_rad_s3,
          {.meaning = "fastest change of the acceleration; smoothing_s gives the same limit as a time",
           .unit = "rad/s3",
           .range = above(0),
           .also = words::jerk});
  v.value("smoothing_s", s.smoothing_s,
          {.meaning =
               "time in which the acceleration rises, acceleration divided by jerk. Default: speed.settle_s",
           .unit = "s",
           .range = from(0)});
  v.value(
      "feed_forward", s.feed_forward,
      {.meaning = "feed-forward: the profile's speed is added to the position loop's output, the torque for "
                  "acceleration and the sheet's friction to the speed loop's output"});
}

inline void describe(base::Visitor& v, PositionLoop& s) {
  v.value("gain_rad_s_per_deg", s.gain_rad_s_per_deg,
          {.meaning = "gain of the position loop: speed reference per degree of position error",
           .unit = "rad/s/deg",
           .range = above(0),
           .also = words::position_gain});
  v.value(
      "speed_limit_rad_s", s.speed_limit_rad_s,
      {.meaning = "bound on the position loop's speed reference. Default: supply.voltage_V divided by K_t, "
                  "the motor's speed without load and loss",
       .unit = "rad/s",
       .range = above(0),
       .also = words::speed_limit});
  v.table(
      "profile", s.profile,
      {.meaning =
           "a setpoint that moves within limits of speed, acceleration and jerk, and reaches its target exactly"});
}

inline void describe(base::Visitor& v, FullScale& s) {
  v.value(
      "current_A", s.current_A,
      {.meaning =
           "largest current and difference of currents that a number represents. Default: three "
           "times the largest reference or limit, or the sum of this value and the current that the bus can drive",
       .unit = "A",
       .range = above(0)});
  v.value("voltage_V", s.voltage_V,
          {.meaning = "largest voltage that a number represents. Default: supply.voltage_V",
           .unit = "V",
           .range = above(0)});
  v.value(
      "speed_rad_s", s.speed_rad_s,
      {.meaning =
           "largest speed and difference of speeds that a number represents. Default: speed without load and loss plus the largest reference",
       .unit = "rad/s",
       .range = above(0),
       .also = words::speed});
  v.value(
      "position_deg", s.position_deg,
      {.meaning =
           "largest position and difference of positions that a number represents. Default: twice the largest reference",
       .unit = "deg",
       .range = above(0),
       .also = words::full_position});
}

inline void describe(base::Visitor& v, Regeneration& s) {
  v.value(
      "limit_V", s.limit_V,
      {.meaning =
           "bus voltage above which the drive feeds no current back: all gates are off, unless the motor drives",
       .unit = "V",
       .range = above(0)});
  v.value("gain_A_per_V", s.gain_A_per_V,
          {.meaning =
               "braking current per volt below limit_V. Default: a tenth of supply.capacitance_F divided by "
               "pwm.period_s",
           .unit = "A/V",
           .range = above(0)});
}

inline void describe(base::Visitor& v, Limits& s) {
  v.value(
      "current_A", s.current_A,
      {.meaning =
           "bound on the current reference in every mode; if a measured phase current exceeds this bound by a quarter, all gates are off until the next sample",
       .unit = "A",
       .range = above(0)});
  v.value(
      "torque_Nm", s.torque_Nm,
      {.meaning =
           "bound on the current reference as a torque, which K_t converts to a current; the lower of the two bounds applies",
       .unit = "N m",
       .range = above(0),
       .also = words::force});
  v.value(
      "speed_rad_s", s.speed_rad_s,
      {.meaning =
           "limit of the speed that the drive's own torque may reach; above this speed all gates are off, unless the drive brakes",
       .unit = "rad/s",
       .range = above(0),
       .also = words::speed});
  v.value(
      "gain_A_s_per_rad", s.gain_A_s_per_rad,
      {.meaning =
           "current per rad/s below limits.speed_rad_s. Default: J/(K_t settling time of the current loop)",
       .unit = "A s/rad",
       .range = above(0),
       .also = words::speed_limit_gain});
}

inline void describe(base::Visitor& v, SmoothChopping& s) {
  v.value("on", s.on,
          {.meaning = "whether the current selects the chopping, soft above and complementary below, "
                      "instead of pwm.chopping; no jump at duty 0"});
  v.value("soft_above_A", s.soft_above_A,
          {.meaning = "driven current above which chopping is soft. Default: twice complementary_below_A",
           .unit = "A",
           .range = from(0)});
  v.value("complementary_below_A", s.complementary_below_A,
          {.meaning = "driven current below which chopping is complementary. Default: half the largest "
                      "ripple, U T/(8 L) at the terminals",
           .unit = "A",
           .range = from(0)});
}

inline void describe(base::Visitor& v, Advance& s) {
  v.value("angle_deg", s.angle_deg,
          {.meaning = "electrical angle before the Hall edge at which the pair changes, at every speed",
           .unit = "deg",
           .range = base::Range{0, 60, true, false}});
  v.value(
      "gain_deg_s_per_rad", s.gain_deg_s_per_rad,
      {.meaning =
           "additional electrical angle per rad/s of the shaft; pole pairs times 180/pi times L/R compensates the current's lag",
       .unit = "deg s/rad",
       .range = from(0)});
  v.value("limit_deg", s.limit_deg,
          {.meaning = "limit of the total advance, electrical angle",
           .unit = "deg",
           .range = base::strictly_between(0, 60)});
}

inline void describe(base::Visitor& v, Control& s) {
  v.choice("drive", s.drive, drive_choices, {.meaning = "firmware that runs on the chip"});
  v.choice("mode", s.mode, mode_choices,
           {.meaning = "controlled quantity, which determines meaning and unit of the reference"});
  v.choice("arithmetic", s.arithmetic, arithmetic_choices,
           {.meaning = "number type in which the controller computes"});
  v.table("full_scale", s.full_scale, {.meaning = "fixed point: physical values at the ends of the range"});
  v.table("current", s.current, {.meaning = "the current controller"});
  v.table("speed", s.speed, {.meaning = "the speed controller around the current controller"});
  v.table("position", s.position, {.meaning = "the position controller around the speed controller"});
  v.value("slew", s.slew,
          {.meaning = "fastest change of the setpoint, in the mode's unit per second. Default: no limit",
           .range = above(0),
           .mode_unit = "*/s"});
  v.table("limits", s.limits, {.meaning = "limits of the current reference"});
  v.table("regeneration", s.regeneration,
          {.meaning = "limit of the current that braking returns to the bus"});
  v.table("smooth_chopping", s.smooth_chopping, {.meaning = "chopping without a jump through duty 0"});
  v.table(
      "advance", s.advance,
      {.meaning =
           "product drive: commutation at a control tick ahead of the Hall edge; without an advance the pair changes at the edge"});
  v.table(
      "sensorless", s.sensorless,
      {.meaning =
           "sensorless drive: start of the rotor, and the signal that the commutation follows; designed from the motor's sheet"});
  v.table(
      "field", s.field,
      {.meaning = "field-oriented drive: control of the currents along the magnet and across the magnet"});
  v.table("own", s.own, {.meaning = "the user's controller: its file and its numbers"});
}

}  // namespace sixstep::study
