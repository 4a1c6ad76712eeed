// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/sheet_description.hpp"

#include "sixstep/design/sheet/sheet_spellings.hpp"
#include "sixstep/design/sheet/winding_description.hpp"

namespace sixstep::design {

void describe_words(base::Visitor& v, Sheet& s) {
  v.value("name", s.name, {.meaning = "name of the motor", .required = true});
  v.value("maker", s.maker, {.meaning = "maker of the motor"});
  v.value("notes", s.notes, {.meaning = "notes on the values"});
  v.value("simulatable", s.simulatable,
          {.meaning = "whether the values of this file are complete and reliable enough for a model"});
  v.value("not_simulatable_because", s.not_simulatable_because,
          {.meaning = "reason for simulatable = false: the missing or doubtful values"});
  v.value(
      "known_deviation", s.known_deviation,
      {.meaning =
           "names of the relations between values that this sheet breaks although the file has the maker's values"});
}

void describe_torque_constant(base::Visitor& v, Sheet& s) {
  v.quantity("torque_constant_mNm_A", s.torque_constant_mNm_A,
             {.meaning = "torque per ampere through the driven pair, mean over a sector",
              .unit = "mNm/A",
              .frame = "terminal",
              .range = base::above(0),
              .also = spellings::torque_constant});
  v.quantity(
      "back_emf_mV_s", s.back_emf_mV_s,
      {.meaning =
           "peak of one phase's back-EMF per mechanical rad/s, instead of the torque constant; with back_emf = \"table\", the factor of the table's values",
       .unit = "mV s",
       .frame = "phase",
       .range = base::above(0)});
  v.quantity("torque_constant_Nm_A", s.torque_constant_Nm_A,
             {.meaning = "torque per ampere: through the driven pair (terminal), of the q axis (peak), or of "
                         "a sine in each phase (rms)",
              .unit = "Nm/A",
              .frame = "terminal|peak|rms",
              .range = base::above(0),
              .also = spellings::torque_per_A});
  v.quantity(
      "back_emf_constant_V_krpm", s.back_emf_constant_V_krpm,
      {.meaning = "back-EMF per 1000 rpm, between two terminals or of one phase, peak or rms; or between the "
                  "driven pair, mean over a sector (six-step)",
       .unit = "V/krpm",
       .frame = "line-peak|line-rms|phase-peak|phase-rms|six-step",
       .range = base::above(0),
       .also = spellings::back_emf_per_speed});
  v.quantity(
      "flux_linkage_mWb", s.flux_linkage_mWb,
      {.meaning =
           "flux linkage of the magnets with one phase, peak of the fundamental, as a drive's set-up identifies",
       .unit = "mWb",
       .frame = "phase",
       .range = base::above(0),
       .also = spellings::flux_linkage});
  v.quantity("speed_constant_rpm_V", s.speed_constant_rpm_V,
             {.meaning = "speed per volt, KV: of the mean voltage in six-step operation, or of the peak "
                         "between two terminals",
              .unit = "rpm/V",
              .frame = "six-step|line-peak",
              .range = base::above(0),
              .also = spellings::speed_constant});
  v.quantity(
      "flux_density_T", s.flux_density_T,
      {.meaning =
           "flux density B in the air gap over the conductors; with length, radius and turns K_t = 2 B l r N",
       .unit = "T",
       .range = base::above(0)});
  v.quantity("active_length_mm", s.active_length_mm,
             {.meaning = "length l of a conductor in the field", .unit = "mm", .range = base::above(0)});
  v.quantity("air_gap_radius_mm", s.air_gap_radius_mm,
             {.meaning = "radius r of the conductors", .unit = "mm", .range = base::above(0)});
  v.value("turns_in_series", s.turns_in_series,
          {.meaning = "turns N in series between two terminals", .range = base::between(1, most_turns)});
}

void describe_mechanics(base::Visitor& v, Sheet& s) {
  v.quantity("inertia_gcm2", s.inertia_gcm2,
             {.meaning = "moment of inertia of the rotor",
              .unit = "g cm2",
              .range = base::above(0),
              .also = spellings::inertia});
  v.quantity("inertia_with_brake_gcm2", s.inertia_with_brake_gcm2,
             {.meaning = "moment of inertia of the rotor with its holding brake",
              .unit = "g cm2",
              .range = base::above(0),
              .also = spellings::inertia_with_brake});
  v.value("with_brake", s.with_brake,
          {.meaning = "whether the motor carries the holding brake, so that inertia_with_brake_gcm2 counts"});
  v.choice("rotor", s.rotor, rotor_choices,
           {.meaning = "rotating part, for an inertia from its dimensions: J = pi/2 rho l (r^4 - r_i^4)"});
  v.quantity(
      "rotor_radius_mm", s.rotor_radius_mm,
      {.meaning =
           "outer radius r of the rotating part; with rotor_length_mm it determines the inertia if the sheet prints no inertia",
       .unit = "mm",
       .range = base::above(0)});
  v.quantity("rotor_inner_radius_mm", s.rotor_inner_radius_mm,
             {.meaning = "inner radius r_i of the rotating part: of an outer rotor or a hollow inner rotor",
              .unit = "mm",
              .range = base::above(0)});
  v.quantity(
      "rotor_length_mm", s.rotor_length_mm,
      {.meaning = "length l of the rotating part, along the shaft", .unit = "mm", .range = base::above(0)});
  v.quantity("rotor_density_kg_m3", s.rotor_density_kg_m3,
             {.meaning = "density rho of the rotating part. Default: 7850, as of steel",
              .unit = "kg/m3",
              .range = base::above(0)});
  v.quantity("viscous_friction_Nm_s", s.viscous_friction_Nm_s,
             {.meaning = "viscous friction: torque per rad/s. Default: the whole no-load loss is viscous",
              .unit = "N m s",
              .range = base::from(0),
              .also = spellings::viscous});
  v.quantity("coulomb_friction_mNm", s.coulomb_friction_mNm,
             {.meaning = "Coulomb friction: torque that does not depend on speed",
              .unit = "mNm",
              .range = base::from(0),
              .also = spellings::coulomb});
  v.quantity(
      "iron_viscous_Nm_s", s.iron_viscous_Nm_s,
      {.meaning =
           "drag of the iron by eddy currents per rad/s, in addition to the bearings' viscous_friction_Nm_s",
       .unit = "N m s",
       .range = base::from(0),
       .also = spellings::iron_viscous});
  v.quantity(
      "iron_coulomb_mNm", s.iron_coulomb_mNm,
      {.meaning =
           "drag of the iron by hysteresis, which does not depend on speed, in addition to the bearings' "
           "coulomb_friction_mNm",
       .unit = "mNm",
       .range = base::from(0),
       .also = spellings::iron_coulomb});
}

void describe_no_load(base::Visitor& v, Sheet& s) {
  v.quantity("no_load_voltage_V", s.no_load_voltage_V,
             {.meaning = "voltage of the no-load point. Default: the nominal voltage",
              .unit = "V",
              .frame = "terminal",
              .range = base::above(0),
              .also = spellings::no_load_voltage});
  v.quantity("no_load_speed_rpm", s.no_load_speed_rpm,
             {.meaning = "speed without load at no_load_voltage_V, which is by default the nominal voltage",
              .unit = "rpm",
              .range = base::above(0),
              .also = spellings::no_load_speed});
  v.quantity("no_load_current_mA", s.no_load_current_mA,
             {.meaning = "current without load, at the voltage of the no-load speed",
              .unit = "mA",
              .frame = "terminal",
              .range = base::from(0),
              .also = spellings::no_load_current});
  v.quantity(
      "second_no_load_voltage_V", s.second_no_load_voltage_V,
      {.meaning = "voltage of a second no-load point; the two points separate viscous from Coulomb friction",
       .unit = "V",
       .frame = "terminal",
       .range = base::above(0)});
  v.quantity("second_no_load_speed_rpm", s.second_no_load_speed_rpm,
             {.meaning = "speed without load at the second voltage",
              .unit = "rpm",
              .range = base::above(0),
              .also = spellings::second_no_load_speed});
  v.quantity("second_no_load_current_mA", s.second_no_load_current_mA,
             {.meaning = "current drawn without load at the second voltage",
              .unit = "mA",
              .frame = "terminal",
              .range = base::from(0)});
}

void describe_ratings(base::Visitor& v, Sheet& s) {
  v.quantity("nominal_speed_rpm", s.nominal_speed_rpm,
             {.meaning = "speed at nominal voltage and torque",
              .unit = "rpm",
              .range = base::above(0),
              .also = spellings::nominal_speed});
  v.quantity("nominal_torque_mNm", s.nominal_torque_mNm,
             {.meaning = "greatest continuous torque",
              .unit = "mNm",
              .range = base::above(0),
              .also = spellings::nominal_torque});
  v.quantity(
      "nominal_current_A", s.nominal_current_A,
      {.meaning =
           "greatest continuous current: direct current through the driven pair (terminal), or rms value "
           "of a sine in each phase (rms)",
       .unit = "A",
       .frame = "terminal|rms",
       .range = base::above(0),
       .also = spellings::nominal_current});
  v.quantity("stall_torque_mNm", s.stall_torque_mNm,
             {.meaning = "torque of the held rotor at nominal voltage",
              .unit = "mNm",
              .range = base::above(0),
              .also = spellings::stall_torque});
  v.quantity("stall_current_A", s.stall_current_A,
             {.meaning = "current of the held rotor at nominal voltage",
              .unit = "A",
              .frame = "terminal",
              .range = base::above(0),
              .also = spellings::stall_current});
  v.quantity("max_efficiency_percent", s.max_efficiency_percent,
             {.meaning = "greatest efficiency at nominal voltage",
              .unit = "percent",
              .range = {0, 100, false, false},
              .also = spellings::max_efficiency});
  v.quantity("speed_torque_gradient_rpm_mNm", s.speed_torque_gradient_rpm_mNm,
             {.meaning = "speed lost per torque at constant voltage, the slope of the speed-torque line",
              .unit = "rpm/mNm",
              .range = base::above(0),
              .also = spellings::speed_torque_gradient});
  v.quantity("mechanical_time_constant_ms", s.mechanical_time_constant_ms,
             {.meaning = "mechanical time constant: time constant of the run-up at constant voltage",
              .unit = "ms",
              .range = base::above(0),
              .also = spellings::mechanical_time_constant});
  v.quantity("electrical_time_constant_ms", s.electrical_time_constant_ms,
             {.meaning = "electrical time constant: time constant of the winding, L/R",
              .unit = "ms",
              .range = base::above(0)});
  v.quantity("max_speed_rpm", s.max_speed_rpm,
             {.meaning = "highest speed that the mechanics allow",
              .unit = "rpm",
              .range = base::above(0),
              .also = spellings::max_speed});
}

void describe_thermal(base::Visitor& v, Sheet& s) {
  v.quantity("thermal_resistance_winding_housing_K_W", s.thermal_resistance_winding_housing_K_W,
             {.meaning = "temperature of the winding above the housing, per watt of its loss",
              .unit = "K/W",
              .range = base::above(0),
              .also = spellings::winding_housing});
  v.quantity("thermal_resistance_housing_ambient_K_W", s.thermal_resistance_housing_ambient_K_W,
             {.meaning = "temperature of the housing above the air, per watt of loss",
              .unit = "K/W",
              .range = base::above(0),
              .also = spellings::housing_ambient});
  v.quantity("thermal_time_constant_winding_s", s.thermal_time_constant_winding_s,
             {.meaning = "thermal time constant of the winding against the housing",
              .unit = "s",
              .range = base::above(0),
              .also = spellings::winding_time});
  v.quantity("thermal_time_constant_motor_s", s.thermal_time_constant_motor_s,
             {.meaning = "thermal time constant of the housing against the air",
              .unit = "s",
              .range = base::above(0),
              .also = spellings::motor_time});
  v.quantity("max_winding_temperature_degC", s.max_winding_temperature_degC,
             {.meaning = "highest permissible temperature of the winding",
              .unit = "degC",
              .range = base::above(0),
              .also = spellings::winding_temperature});
  v.value(
      "magnet_loss_percent_K", s.magnet_loss_percent_K,
      {.meaning =
           "part of the back-EMF lost per kelvin of the magnets above 25 degC: NdFeB 0.12, SmCo 0.04, ferrite 0.2",
       .unit = "percent/K",
       .range = base::between(0, 1)});
}

void describe(base::Visitor& v, Sheet& s) {
  describe_words(v, s);
  describe_winding(v, s);
  describe_torque_constant(v, s);
  describe_mechanics(v, s);
  describe_no_load(v, s);
  describe_ratings(v, s);
  describe_thermal(v, s);
}

}  // namespace sixstep::design
