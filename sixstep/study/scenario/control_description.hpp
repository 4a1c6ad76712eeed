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

/// Meanings of a PI's gains, the same in every loop. Units: V/A in a current loop, full output per rad/s in a
/// speed loop.
struct GainMeanings {
  std::string_view d1, d0, kp, ki, ki_per_s;
};
inline constexpr GainMeanings current_gain_meanings{
    "gain on the present error of (d1 z + d0)/(z - 1), V/A, with d0",
    "gain on the previous error of (d1 z + d0)/(z - 1), V/A, with d1",
    "proportional gain, V/A, with ki or ki_per_s: kp = d1",
    "integral gain per sample, V/A, with kp: ki = d1 + d0",
    "integral gain per second, V/A per s, with kp, as other tools give it: ki = ki_per_s times pwm.period_s"};
inline constexpr GainMeanings speed_gain_meanings{
    "gain on the present error of (d1 z + d0)/(z - 1), full output per rad/s, with d0",
    "gain on the previous error of (d1 z + d0)/(z - 1), full output per rad/s, with d1",
    "proportional gain, full output per rad/s, with ki or ki_per_s: kp = d1",
    "integral gain per sample, full output per rad/s, with kp: ki = d1 + d0",
    "integral gain per second, full output per rad, with kp, as other tools give it: ki = ki_per_s times pwm.period_s"};

template <class Loop>
void describe_gains(base::Visitor& v, Loop& s, const GainMeanings& of) {
  v.value(
      "settle_s", s.settle_s,
      {.meaning = "settling time the poles are placed for, with damping", .unit = "s", .range = above(0)});
  v.value(
      "damping", s.damping,
      {.meaning = "damping of the placed pole pair, with settle_s", .range = base::Range{0, 1, false, true}});
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
  v.choice("on", s.on, hysteresis_choices, {.meaning = "hysteresis: which current is watched"});
  v.choice("comparator", s.comparator, comparator_choices,
           {.meaning = "hysteresis: when the band is looked at"});
  v.choice("feedback", s.feedback, current_feedback_choices,
           {.meaning = "which current the controller is told"});
  v.choice("commutation", s.commutation, current_commutation_choices,
           {.meaning = "pi: what happens while a commutation lasts"});
  v.value(
      "correction", s.correction,
      {.meaning =
           "deadbeat: part of what a prediction missed that each sample takes over as a voltage; without it 0.25",
       .range = base::Range{0, 1, false, true}});
  v.value("limit_A", s.limit_A,
          {.meaning = "bound on the current reference that an outer loop asks for; its integral knows of it",
           .unit = "A",
           .range = above(0)});
  v.value("back_emf_feed_forward", s.back_emf_feed_forward,
          {.meaning = "pi: whether the back-EMF at the measured speed is added to the voltage"});
  v.value("measured_bus_from_V", s.measured_bus_from_V,
          {.meaning = "pi: lowest bus voltage for which the duty follows the measured bus; without it the "
                      "duty goes by supply.voltage_V",
           .unit = "V",
           .range = above(0)});
}

inline void describe(base::Visitor& v, SpeedLoop& s) {
  v.choice("output", s.output, speed_output_choices, {.meaning = "what the speed controller sets"});
  v.choice("law", s.law, speed_law_choices,
           {.meaning = "what computes its output; all of them are designed for settle_s"});
  v.choice("form", s.form, speed_form_choices,
           {.meaning = "how its PI is computed; short of the limit both forms are one controller"});
  describe_gains(v, s, speed_gain_meanings);
  v.value("torque_limit_Nm", s.torque_limit_Nm,
          {.meaning = "torque at the speed controller's full output; without it that of 2.5 times the "
                      "sheet's nominal current",
           .unit = "N m",
           .range = above(0),
           .also = words::force_limit});
  v.value(
      "anti_windup", s.anti_windup,
      {.meaning = "positional: part of what the limit cuts off that each sample takes off the integral; 0 "
                  "lets it wind up; without it ki/kp",
       .range = between(0, 1)});
  v.value(
      "derivative_s", s.derivative_s,
      {.meaning = "positional: derivative time; kp times it, times the measured acceleration, is taken off "
                  "the output",
       .unit = "s",
       .range = above(0)});
  v.value("derivative_filter_s", s.derivative_filter_s,
          {.meaning = "time constant that smooths the derivative; without it a tenth of derivative_s",
           .unit = "s",
           .range = from(0)});
  v.value(
      "setpoint_weight", s.setpoint_weight,
      {.meaning =
           "positional: part of the setpoint that the proportional part sees; 0 is an I-P controller, without it 1",
       .range = between(0, 1)});
  v.value(
      "observer_ratio", s.observer_ratio,
      {.meaning =
           "state-feedback, disturbance-rejection, sliding-mode: how many times faster a load is seen, or the "
           "surface reached, than settle_s; without it 5",
       .range = between(1, 20)});
}

inline void describe(base::Visitor& v, PositionProfile& s) {
  v.value("on", s.on,
          {.meaning = "whether the setpoint moves within limits of speed, acceleration and jerk"});
  v.value("speed_rad_s", s.speed_rad_s,
          {.meaning = "fastest speed of a move; without it nine tenths of what the bus still drives the "
                      "acceleration at, or of speed_limit_rad_s where that is less",
           .unit = "rad/s",
           .range = above(0),
           .also = words::speed});
  v.value("acceleration_rad_s2", s.acceleration_rad_s2,
          {.meaning = "largest acceleration; without it that of four fifths of the torque limit",
           .unit = "rad/s2",
           .range = above(0),
           .also = words::acceleration});
  v.value("jerk_rad_s3", s.jerk_rad_s3,
          {.meaning = "fastest change of the acceleration; smoothing_s says the same as a time",
           .unit = "rad/s3",
           .range = above(0),
           .also = words::jerk});
  v.value(
      "smoothing_s", s.smoothing_s,
      {.meaning = "time in which the acceleration rises, acceleration over jerk; without both speed.settle_s",
       .unit = "s",
       .range = from(0)});
  v.value(
      "feed_forward", s.feed_forward,
      {.meaning =
           "whether the profile's speed is added to what the position loop asks for, and the torque of its "
           "acceleration and the sheet's friction to what the speed loop does"});
}

inline void describe(base::Visitor& v, PositionLoop& s) {
  v.value("gain_rad_s_per_deg", s.gain_rad_s_per_deg,
          {.meaning = "speed asked for per degree of position error",
           .unit = "rad/s/deg",
           .range = above(0),
           .also = words::position_gain});
  v.value("speed_limit_rad_s", s.speed_limit_rad_s,
          {.meaning = "bound on the speed that the position loop asks for; without it supply.voltage_V over "
                      "K_t, which the motor could not pass",
           .unit = "rad/s",
           .range = above(0),
           .also = words::speed_limit});
  v.table(
      "profile", s.profile,
      {.meaning = "a setpoint that moves within limits of speed, acceleration and jerk, and lands exactly"});
}

inline void describe(base::Visitor& v, FullScale& s) {
  v.value("current_A", s.current_A,
          {.meaning = "largest current and difference of currents that a number holds; without it three "
                      "times the largest reference or limit, or what the bus can drive on top of one",
           .unit = "A",
           .range = above(0)});
  v.value("voltage_V", s.voltage_V,
          {.meaning = "largest voltage; without it supply.voltage_V", .unit = "V", .range = above(0)});
  v.value(
      "speed_rad_s", s.speed_rad_s,
      {.meaning = "largest speed and difference of speeds; without it that of no load and no loss, and the "
                  "largest reference",
       .unit = "rad/s",
       .range = above(0),
       .also = words::speed});
  v.value("position_deg", s.position_deg,
          {.meaning = "largest position and difference of positions; without it twice the largest reference",
           .unit = "deg",
           .range = above(0),
           .also = words::full_position});
}

inline void describe(base::Visitor& v, Regeneration& s) {
  v.value(
      "limit_V", s.limit_V,
      {.meaning = "bus voltage above which the drive feeds nothing back: all gates are off, unless it drives",
       .unit = "V",
       .range = above(0)});
  v.value(
      "gain_A_per_V", s.gain_A_per_V,
      {.meaning = "braking current per volt below limit_V; without it a tenth of supply.capacitance_F over "
                  "pwm.period_s",
       .unit = "A/V",
       .range = above(0)});
}

inline void describe(base::Visitor& v, Limits& s) {
  v.value("current_A", s.current_A,
          {.meaning = "bound on the current reference in every mode; where a measured phase current exceeds "
                      "it by a quarter, all gates are off until the next sample",
           .unit = "A",
           .range = above(0)});
  v.value("torque_Nm", s.torque_Nm,
          {.meaning = "the same as a torque, over K_t; the lower one counts",
           .unit = "N m",
           .range = above(0),
           .also = words::force});
  v.value(
      "speed_rad_s", s.speed_rad_s,
      {.meaning = "speed that the drive's own torque does not pass: above it all gates are off, unless the "
                  "drive brakes",
       .unit = "rad/s",
       .range = above(0),
       .also = words::speed});
  v.value("gain_A_s_per_rad", s.gain_A_s_per_rad,
          {.meaning = "current per rad/s below limits.speed_rad_s; without it J/(K_t settling time of the "
                      "current loop)",
           .unit = "A s/rad",
           .range = above(0),
           .also = words::speed_limit_gain});
}

inline void describe(base::Visitor& v, SmoothChopping& s) {
  v.value("on", s.on,
          {.meaning = "whether chopping goes by the current, soft above and complementary below, instead of "
                      "by pwm.chopping: no jump at duty 0"});
  v.value("soft_above_A", s.soft_above_A,
          {.meaning = "driven current above which it is soft; without it twice complementary_below_A",
           .unit = "A",
           .range = from(0)});
  v.value("complementary_below_A", s.complementary_below_A,
          {.meaning = "driven current below which it is complementary; without it half the largest ripple, "
                      "U T/(8 L) at the terminals",
           .unit = "A",
           .range = from(0)});
}

inline void describe(base::Visitor& v, Advance& s) {
  v.value("angle_deg", s.angle_deg,
          {.meaning = "electrical angle before the Hall edge at which the pair changes, at every speed",
           .unit = "deg",
           .range = base::Range{0, 60, true, false}});
  v.value("gain_deg_s_per_rad", s.gain_deg_s_per_rad,
          {.meaning = "electrical angle more per rad/s of the shaft; pole pairs x 180/pi x L/R makes up for "
                      "the current's lag",
           .unit = "deg s/rad",
           .range = from(0)});
  v.value("limit_deg", s.limit_deg,
          {.meaning = "electrical angle that both together do not pass",
           .unit = "deg",
           .range = base::strictly_between(0, 60)});
}

inline void describe(base::Visitor& v, Control& s) {
  v.choice("drive", s.drive, drive_choices, {.meaning = "what the chip runs"});
  v.choice("mode", s.mode, mode_choices, {.meaning = "what is controlled, and so what the reference means"});
  v.choice("arithmetic", s.arithmetic, arithmetic_choices,
           {.meaning = "number type the controller computes in"});
  v.table("full_scale", s.full_scale, {.meaning = "fixed point: what the ends of the range stand for"});
  v.table("current", s.current, {.meaning = "the current controller"});
  v.table("speed", s.speed, {.meaning = "the speed controller around it"});
  v.table("position", s.position, {.meaning = "the position controller around both"});
  v.value("slew", s.slew,
          {.meaning = "fastest change of the setpoint, in the mode's unit per second; without it it steps",
           .range = above(0),
           .mode_unit = "*/s"});
  v.table("limits", s.limits, {.meaning = "limits of the current reference"});
  v.table("regeneration", s.regeneration,
          {.meaning = "limit of the current that braking returns to the bus"});
  v.table("smooth_chopping", s.smooth_chopping, {.meaning = "chopping without a jump through duty 0"});
  v.table("advance", s.advance,
          {.meaning =
               "product drive: commutation ahead of the Hall edge, at the control tick; 0 is at the edge"});
  v.table(
      "sensorless", s.sensorless,
      {.meaning = "sensorless drive: how it starts and what it follows; designed from the motor's sheet"});
  v.table("field", s.field,
          {.meaning = "field-oriented drive: how the currents along the magnet and across it are held"});
  v.table("own", s.own, {.meaning = "a controller of one's own: where it is, and its numbers"});
}

}  // namespace sixstep::study
