// SPDX-License-Identifier: Apache-2.0
// The keys of a motor file: the only place of their names, units, frames and meanings.
#pragma once
#include "sixstep/base/describe.hpp"
#include "sixstep/design/sheet.hpp"

namespace sixstep::design {

inline constexpr base::Choice<BackEmfShape> back_emf_choices[] = {
    {"trapezoid", BackEmfShape::trapezoid, "flat top of width flat_deg, linear ramps between"},
    {"sine", BackEmfShape::sine, "one sine per electrical turn"},
};

template <class Visitor>
void describe_no_load_and_ratings(Visitor& v, Sheet& s) {
  v.quantity("no_load_speed_rpm", s.no_load_speed_rpm,
             {.meaning = "speed without load at nominal voltage", .unit = "rpm", .range = base::above(0)});
  v.quantity("no_load_current_mA", s.no_load_current_mA,
             {.meaning = "current drawn without load at nominal voltage",
              .unit = "mA",
              .frame = "terminal",
              .range = base::from(0)});
  v.quantity("nominal_speed_rpm", s.nominal_speed_rpm,
             {.meaning = "speed at nominal voltage and torque", .unit = "rpm", .range = base::above(0)});
  v.quantity("nominal_torque_mNm", s.nominal_torque_mNm,
             {.meaning = "greatest continuous torque", .unit = "mNm", .range = base::above(0)});
  v.quantity(
      "nominal_current_A", s.nominal_current_A,
      {.meaning = "greatest continuous current", .unit = "A", .frame = "terminal", .range = base::above(0)});
  v.quantity(
      "stall_torque_mNm", s.stall_torque_mNm,
      {.meaning = "torque of the held rotor at nominal voltage", .unit = "mNm", .range = base::above(0)});
  v.quantity("stall_current_A", s.stall_current_A,
             {.meaning = "current of the held rotor at nominal voltage",
              .unit = "A",
              .frame = "terminal",
              .range = base::above(0)});
  v.quantity("speed_constant_rpm_V", s.speed_constant_rpm_V,
             {.meaning = "speed per volt of back-EMF in six-step operation",
              .unit = "rpm/V",
              .frame = "terminal",
              .range = base::above(0)});
  v.quantity("max_speed_rpm", s.max_speed_rpm,
             {.meaning = "speed the mechanics allow", .unit = "rpm", .range = base::above(0)});
}

template <class Visitor>
void describe_thermal(Visitor& v, Sheet& s) {
  v.quantity("thermal_resistance_winding_housing_K_W", s.thermal_resistance_winding_housing_K_W,
             {.meaning = "temperature of the winding above the housing, per watt of its loss",
              .unit = "K/W",
              .range = base::above(0)});
  v.quantity("thermal_resistance_housing_ambient_K_W", s.thermal_resistance_housing_ambient_K_W,
             {.meaning = "temperature of the housing above the air, per watt of loss",
              .unit = "K/W",
              .range = base::above(0)});
  v.quantity("thermal_time_constant_winding_s", s.thermal_time_constant_winding_s,
             {.meaning = "of the winding against the housing", .unit = "s", .range = base::above(0)});
  v.quantity("thermal_time_constant_motor_s", s.thermal_time_constant_motor_s,
             {.meaning = "of the housing against the air", .unit = "s", .range = base::above(0)});
  v.quantity("max_winding_temperature_degC", s.max_winding_temperature_degC,
             {.meaning = "greatest temperature of the winding", .unit = "degC", .range = base::above(0)});
}

template <class Visitor>
void describe(Visitor& v, Sheet& s) {
  v.value("name", s.name, {.meaning = "what the motor is called", .required = true});
  v.value("maker", s.maker, {.meaning = "who makes it"});
  v.value("notes", s.notes, {.meaning = "what a reader should know about the values"});
  v.value("pole_pairs", s.pole_pairs,
          {.meaning = "electrical turns per turn of the shaft", .range = base::from(1), .required = true});
  v.choice("back_emf", s.back_emf, back_emf_choices,
           {.meaning = "shape of the back-EMF over the electrical angle"});
  v.value("flat_deg", s.flat_deg,
          {.meaning = "width of the trapezoid's flat top, electrical",
           .unit = "deg",
           .range = base::strictly_between(0, 180),
           .cure = "an ideal six-step motor has 120"});
  v.quantity("nominal_voltage_V", s.nominal_voltage_V,
             {.meaning = "voltage the sheet's other values belong to",
              .unit = "V",
              .frame = "terminal",
              .range = base::above(0),
              .required = true});
  v.quantity("resistance_ohm", s.resistance_ohm,
             {.meaning = "winding resistance, between two terminals or of one phase of the star",
              .unit = "ohm",
              .frame = "terminal|phase",
              .range = base::above(0),
              .required = true});
  v.quantity("inductance_mH", s.inductance_mH,
             {.meaning = "winding inductance, between two terminals or of one phase of the star (L - M)",
              .unit = "mH",
              .frame = "terminal|phase",
              .range = base::above(0),
              .required = true});
  v.quantity("torque_constant_mNm_A", s.torque_constant_mNm_A,
             {.meaning = "torque per ampere through the driven pair, mean over a sector",
              .unit = "mNm/A",
              .frame = "terminal",
              .range = base::above(0)});
  v.quantity("back_emf_mV_s", s.back_emf_mV_s,
             {.meaning = "peak of one phase's back-EMF per mechanical rad/s, instead of the torque constant",
              .unit = "mV s",
              .frame = "phase",
              .range = base::above(0)});
  v.quantity("inertia_gcm2", s.inertia_gcm2,
             {.meaning = "moment of inertia of the rotor",
              .unit = "g cm2",
              .range = base::above(0),
              .required = true});
  v.quantity("viscous_friction_Nm_s", s.viscous_friction_Nm_s,
             {.meaning = "friction torque per rad/s; without it all of the no-load loss is taken as viscous",
              .unit = "N m s",
              .range = base::from(0)});
  v.quantity(
      "coulomb_friction_mNm", s.coulomb_friction_mNm,
      {.meaning = "friction torque that does not depend on speed", .unit = "mNm", .range = base::from(0)});
  describe_no_load_and_ratings(v, s);
  describe_thermal(v, s);
}

}  // namespace sixstep::design
