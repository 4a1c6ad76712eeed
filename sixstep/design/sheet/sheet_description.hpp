// SPDX-License-Identifier: Apache-2.0
// The keys of a motor file: the only place of their names, units, frames and meanings.
#pragma once
#include "sixstep/base/describe.hpp"
#include "sixstep/design/sheet/sheet.hpp"
#include "sixstep/design/sheet/sheet_spellings.hpp"

namespace sixstep::design {

/// The ring motors of telescopes have a hundred pole pairs.
inline constexpr int most_pole_pairs = 500, most_turns = 100'000;

/// Of the back-EMF; what lies above is noise of a measurement.
inline constexpr int highest_order = 23;

inline constexpr base::Choice<BackEmfShape> back_emf_choices[] = {
    {"trapezoid", BackEmfShape::trapezoid, "flat top of width flat_deg, linear ramps between"},
    {"sine", BackEmfShape::sine, "one sine per electrical turn"},
};

inline constexpr base::Choice<WindingConnection> connection_choices[] = {
    {"star", WindingConnection::star, "the phases meet in a point that is not led out"},
    {"delta", WindingConnection::delta, "the phases lie between the terminals, and a current may run round"},
};

template <class Visitor>
void describe_words(Visitor& v, Sheet& s) {
  v.value("name", s.name, {.meaning = "what the motor is called", .required = true});
  v.value("maker", s.maker, {.meaning = "who makes it"});
  v.value("notes", s.notes, {.meaning = "what a reader should know about the values"});
  v.value("simulatable", s.simulatable,
          {.meaning = "whether the values are enough for a model and can be trusted for one"});
  v.value("not_simulatable_because", s.not_simulatable_because,
          {.meaning = "what is missing or in doubt, where simulatable = false"});
  v.value("known_deviation", s.known_deviation,
          {.meaning = "relations between its values that this sheet is known to break"});
}

template <class Visitor>
void describe_winding(Visitor& v, Sheet& s) {
  v.value("pole_pairs", s.pole_pairs,
          {.meaning = "electrical turns per turn of the shaft: half the number of magnet poles",
           .range = base::between(1, most_pole_pairs),
           .also = spellings::pole_pairs});
  v.value("poles", s.poles,
          {.meaning = "number of magnet poles, instead of pole_pairs",
           .range = base::between(2, 2 * most_pole_pairs)});
  v.value("winding", s.winding, {.meaning = "teeth and magnet poles as 12N14P, instead of pole_pairs"});
  v.choice("back_emf", s.back_emf, back_emf_choices,
           {.meaning = "shape of the back-EMF over the electrical angle"});
  v.value("flat_deg", s.flat_deg,
          {.meaning = "width of the trapezoid's flat top, electrical",
           .unit = "deg",
           .range = base::strictly_between(0, 180),
           .cure = "an ideal six-step motor has 120"});
  v.value(
      "harmonic_orders", s.harmonic_orders,
      {.meaning =
           "odd harmonics of the back-EMF beside the sine, 3 to 23, with harmonic_sizes; back_emf = \"sine\""});
  v.value("harmonic_sizes", s.harmonic_sizes,
          {.meaning = "their amplitudes as parts of the sine's, cos n (theta - 60 deg)",
           .range = base::between(-1, 1)});
  v.choice("connection", s.connection, connection_choices, {.meaning = "how the three phases are connected"});
  v.value("mutual_inductance_mH", s.mutual_inductance_mH,
          {.meaning = "delta: mutual inductance of two branches, negative as a rule",
           .unit = "mH",
           .range = base::between(-1e3, 1e3)});
  v.value("phase_resistance_deviation", s.phase_resistance_deviation,
          {.meaning = "star: by how much the resistances of phases a, b, c stray, as parts of the mean",
           .range = base::strictly_between(-1, 1)});
  v.value("phase_back_emf_deviation", s.phase_back_emf_deviation,
          {.meaning = "star: by how much the back-EMF constants of a, b, c stray, as parts of the mean",
           .range = base::strictly_between(-1, 1)});
  v.value("cogging_orders", s.cogging_orders,
          {.meaning =
               "periods of the cogging torque per turn of the shaft: the least common multiple of slots and "
               "poles, and its multiples"});
  v.value("cogging_mNm", s.cogging_mNm, {.meaning = "amplitudes of the cogging torque", .unit = "mNm"});
  v.value("cogging_phase_deg", s.cogging_phase_deg,
          {.meaning = "their phases, sin(order theta + phase); without it 0", .unit = "deg"});
  v.quantity("nominal_voltage_V", s.nominal_voltage_V,
             {.meaning = "voltage the sheet's other values belong to",
              .unit = "V",
              .frame = "terminal",
              .range = base::above(0),
              .also = spellings::nominal_voltage});
  v.quantity("resistance_ohm", s.resistance_ohm,
             {.meaning = "winding resistance, between two terminals or of one phase of the star",
              .unit = "ohm",
              .frame = "terminal|phase",
              .range = base::above(0),
              .also = spellings::resistance});
  v.quantity("inductance_mH", s.inductance_mH,
             {.meaning = "winding inductance, between two terminals or of one phase of the star (L - M)",
              .unit = "mH",
              .frame = "terminal|phase",
              .range = base::above(0),
              .also = spellings::inductance});
  v.quantity("d_axis_inductance_mH", s.d_axis_inductance_mH,
             {.meaning = "inductance of one phase along the magnets, L_d; with q_axis_inductance_mH instead "
                         "of inductance_mH",
              .unit = "mH",
              .frame = "phase",
              .range = base::above(0),
              .also = spellings::d_axis_inductance});
  v.quantity("q_axis_inductance_mH", s.q_axis_inductance_mH,
             {.meaning = "inductance of one phase across the magnets, L_q",
              .unit = "mH",
              .frame = "phase",
              .range = base::above(0),
              .also = spellings::q_axis_inductance});
}

template <class Visitor>
void describe_torque_constant(Visitor& v, Sheet& s) {
  v.quantity("torque_constant_mNm_A", s.torque_constant_mNm_A,
             {.meaning = "torque per ampere through the driven pair, mean over a sector",
              .unit = "mNm/A",
              .frame = "terminal",
              .range = base::above(0),
              .also = spellings::torque_constant});
  v.quantity("back_emf_mV_s", s.back_emf_mV_s,
             {.meaning = "peak of one phase's back-EMF per mechanical rad/s, instead of the torque constant",
              .unit = "mV s",
              .frame = "phase",
              .range = base::above(0)});
  v.quantity("torque_constant_Nm_A", s.torque_constant_Nm_A,
             {.meaning = "torque per ampere: through the driven pair (terminal), of the q axis (peak), or of "
                         "a sine in each phase (rms)",
              .unit = "Nm/A",
              .frame = "terminal|peak|rms",
              .range = base::above(0)});
  v.quantity("back_emf_constant_V_krpm", s.back_emf_constant_V_krpm,
             {.meaning = "back-EMF per 1000 rpm, between two terminals or of one phase, peak or rms",
              .unit = "V/krpm",
              .frame = "line-peak|line-rms|phase-peak|phase-rms",
              .range = base::above(0)});
  v.quantity("flux_linkage_mWb", s.flux_linkage_mWb,
             {.meaning = "flux of the magnets through one phase, peak of its fundamental, as a drive's "
                         "set-up identifies it",
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

template <class Visitor>
void describe_mechanics(Visitor& v, Sheet& s) {
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
  v.quantity("viscous_friction_Nm_s", s.viscous_friction_Nm_s,
             {.meaning = "friction torque per rad/s; without it all of the no-load loss is taken as viscous",
              .unit = "N m s",
              .range = base::from(0)});
  v.quantity(
      "coulomb_friction_mNm", s.coulomb_friction_mNm,
      {.meaning = "friction torque that does not depend on speed", .unit = "mNm", .range = base::from(0)});
}

template <class Visitor>
void describe_no_load(Visitor& v, Sheet& s) {
  v.quantity("no_load_voltage_V", s.no_load_voltage_V,
             {.meaning = "voltage of the no-load point, where it is not the nominal one",
              .unit = "V",
              .frame = "terminal",
              .range = base::above(0),
              .also = spellings::no_load_voltage});
  v.quantity("no_load_speed_rpm", s.no_load_speed_rpm,
             {.meaning = "speed without load, at no_load_voltage_V or else at the nominal voltage",
              .unit = "rpm",
              .range = base::above(0),
              .also = spellings::no_load_speed});
  v.quantity("no_load_current_mA", s.no_load_current_mA,
             {.meaning = "current drawn without load, at the same voltage",
              .unit = "mA",
              .frame = "terminal",
              .range = base::from(0),
              .also = spellings::no_load_current});
  v.quantity(
      "second_no_load_voltage_V", s.second_no_load_voltage_V,
      {.meaning =
           "voltage of a second no-load point, which splits friction into its viscous and its Coulomb part",
       .unit = "V",
       .frame = "terminal",
       .range = base::above(0)});
  v.quantity("second_no_load_speed_rpm", s.second_no_load_speed_rpm,
             {.meaning = "speed without load at the second voltage", .unit = "rpm", .range = base::above(0)});
  v.quantity("second_no_load_current_mA", s.second_no_load_current_mA,
             {.meaning = "current drawn without load at the second voltage",
              .unit = "mA",
              .frame = "terminal",
              .range = base::from(0)});
}

template <class Visitor>
void describe_ratings(Visitor& v, Sheet& s) {
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
           "greatest continuous current: through the driven pair (terminal), or rms of a sine in each phase",
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
             {.meaning = "speed lost per torque at constant voltage",
              .unit = "rpm/mNm",
              .range = base::above(0),
              .also = spellings::speed_torque_gradient});
  v.quantity("mechanical_time_constant_ms", s.mechanical_time_constant_ms,
             {.meaning = "of the run-up at constant voltage",
              .unit = "ms",
              .range = base::above(0),
              .also = spellings::mechanical_time_constant});
  v.quantity("max_speed_rpm", s.max_speed_rpm,
             {.meaning = "speed the mechanics allow",
              .unit = "rpm",
              .range = base::above(0),
              .also = spellings::max_speed});
}

template <class Visitor>
void describe_thermal(Visitor& v, Sheet& s) {
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
             {.meaning = "of the winding against the housing",
              .unit = "s",
              .range = base::above(0),
              .also = spellings::winding_time});
  v.quantity("thermal_time_constant_motor_s", s.thermal_time_constant_motor_s,
             {.meaning = "of the housing against the air",
              .unit = "s",
              .range = base::above(0),
              .also = spellings::motor_time});
  v.quantity("max_winding_temperature_degC", s.max_winding_temperature_degC,
             {.meaning = "greatest temperature of the winding",
              .unit = "degC",
              .range = base::above(0),
              .also = spellings::winding_temperature});
}

template <class Visitor>
void describe(Visitor& v, Sheet& s) {
  describe_words(v, s);
  describe_winding(v, s);
  describe_torque_constant(v, s);
  describe_mechanics(v, s);
  describe_no_load(v, s);
  describe_ratings(v, s);
  describe_thermal(v, s);
}

}  // namespace sixstep::design
