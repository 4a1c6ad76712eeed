// SPDX-License-Identifier: Apache-2.0
// The keys of [load].
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/linear_words.hpp"

namespace sixstep::study {

using base::above;
using base::between;
using base::from;

inline void describe(base::Visitor& v, Load& s) {
  v.value(
      "torque_Nm", s.torque_Nm,
      {.meaning =
           "constant load torque, positive against forward motion; this torque also turns a shaft that coasts, as a hanging weight does",
       .unit = "N m",
       .also = words::force});
  v.value(
      "times_s", s.times_s,
      {.meaning = "times at which the values of torques_Nm begin, rising", .unit = "s", .range = from(0)});
  v.value("torques_Nm", s.torques_Nm,
          {.meaning = "load torques, each from its time in times_s on, instead of torque_Nm",
           .unit = "N m",
           .also = words::forces});
  v.choice("between", s.between, between_choices,
           {.meaning = "transition from one value of torques_Nm to the next"});
  v.value("at_speeds_rad_s", s.at_speeds_rad_s,
          {.meaning = "speeds of the load at which at_speeds_Nm gives the torques, rising",
           .unit = "rad/s",
           .also = words::at_speeds});
  v.value(
      "at_speeds_Nm", s.at_speeds_Nm,
      {.meaning =
           "load torques at at_speeds_rad_s, added to the other load torques: linear between the points, constant beyond the ends",
       .unit = "N m",
       .also = words::at_speeds_forces});
  v.value("dynamometer_times_s", s.dynamometer_times_s,
          {.meaning = "dynamometer: times of the values of dynamometer_rad_s, beginning with 0, rising",
           .unit = "s",
           .range = from(0)});
  v.value(
      "dynamometer_rad_s", s.dynamometer_rad_s,
      {.meaning =
           "dynamometer: imposed speeds of the load, linear between the points; the load torque is the result",
       .unit = "rad/s",
       .also = words::dynamometer});
  v.value("viscous_Nm_s", s.viscous_Nm_s,
          {.meaning = "friction torque per rad/s, added to the motor's own",
           .unit = "N m s",
           .range = from(0),
           .also = words::viscous});
  v.value("coulomb_Nm", s.coulomb_Nm,
          {.meaning = "friction torque that does not depend on speed, added to the motor's own",
           .unit = "N m",
           .range = from(0),
           .also = words::coulomb});
  v.value(
      "static_Nm", s.static_Nm,
      {.meaning =
           "static friction torque that the rotor must exceed to start; has an effect if larger than the Coulomb friction",
       .unit = "N m",
       .range = from(0),
       .also = words::breakaway});
  v.value("inertia_kg_m2", s.inertia_kg_m2,
          {.meaning = "moment of inertia on the shaft, added to the rotor's",
           .unit = "kg m2",
           .range = from(0),
           .also = words::mass});
  v.value(
      "gear", s.gear,
      {.meaning =
           "gear ratio: motor turns per turn of the load; torque, inertia and friction of the load then refer to the load's shaft",
       .range = between(1e-3, 1e5)});
  v.value("gear_efficiency", s.gear_efficiency,
          {.meaning =
               "efficiency of the gear: fraction of the driving side's torque that reaches the driven side",
           .range = base::Range{0.01, 1, false, true}});
  v.value("stiffness_Nm_rad", s.stiffness_Nm_rad,
          {.meaning = "torsional stiffness of shaft and coupling, referred to the load's shaft; 0: rigid",
           .unit = "N m/rad",
           .range = from(0),
           .also = words::stiffness});
  v.value("damping_Nm_s_rad", s.damping_Nm_s_rad,
          {.meaning = "viscous damping of the elastic shaft",
           .unit = "N m s/rad",
           .range = from(0),
           .also = words::damping});
  v.value("fan_Nm_s2", s.fan_Nm_s2,
          {.meaning = "fan or propeller: torque against the rotation per square of the load's speed",
           .unit = "N m s2",
           .range = from(0),
           .also = words::drag});
  v.value(
      "gravity_Nm", s.gravity_Nm,
      {.meaning =
           "weight on an arm: torque with the arm horizontal; the torque is gravity_Nm sin(load angle - gravity_angle_deg)",
       .unit = "N m"});
  v.value("gravity_angle_deg", s.gravity_angle_deg,
          {.meaning = "load angle at which the weight causes no torque", .unit = "deg"});
  v.value("locked", s.locked, {.meaning = "whether the rotor is held"});
}

}  // namespace sixstep::study
