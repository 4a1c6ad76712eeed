// SPDX-License-Identifier: Apache-2.0
// The keys of a motor file for poles and windings. This file is the only definition of their names, units,
// frames and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/design/sheet/sheet.hpp"
#include "sixstep/design/sheet/sheet_spellings.hpp"

namespace sixstep::design {

/// Bounds of the keys; the ring motors of telescopes have a hundred pole pairs.
inline constexpr int most_pole_pairs = 500, most_turns = 100'000;

/// Highest order of a harmonic of the back-EMF; higher orders are noise of a measurement.
inline constexpr int highest_order = 23;

/// Bounds of a back-EMF table: the number of its points; their smallest distance; its mean over a turn
/// relative to the peak-to-peak value; and the least torque of the sectors' pairs relative to the line's peak
/// (0.955 for a sine).
inline constexpr std::size_t most_shape_points = 1000;
inline constexpr double least_shape_step_deg = 0.01, most_shape_mean = 1e-3, least_shape_torque = 0.2;

inline constexpr base::Choice<BackEmfShape> back_emf_choices[] = {
    {"trapezoid", BackEmfShape::trapezoid, "flat top of width flat_deg, linear ramps between"},
    {"sine", BackEmfShape::sine, "one sine per electrical turn"},
    {"table", BackEmfShape::table,
     "straight lines between the points of back_emf_angle_deg and back_emf_shape, or of back_emf_file"},
};

inline constexpr base::Choice<MotorKind> kind_choices[] = {
    {"rotary", MotorKind::rotary, "it turns"},
    {"linear", MotorKind::linear,
     "the motor moves along a line: give pole_pitch_mm instead of pole_pairs, and the keys in N and m"},
};

inline constexpr base::Choice<RotorPlace> rotor_choices[] = {
    {"inner", RotorPlace::inner, "a cylinder inside the stator; hollow if rotor_inner_radius_mm is given"},
    {"outer", RotorPlace::outer, "a ring around the stator"},
};

inline constexpr base::Choice<WindingConnection> connection_choices[] = {
    {"star", WindingConnection::star, "the phases meet in a star point without a terminal"},
    {"delta", WindingConnection::delta, "each phase lies between two terminals, and a current may circulate"},
};

inline void describe_winding(base::Visitor& v, Sheet& s) {
  v.choice("kind", s.kind, kind_choices, {.meaning = "whether the motor turns or moves along a line"});
  v.quantity(
      "pole_pitch_mm", s.pole_pitch_mm,
      {.meaning =
           "linear: distance from one pole to the next, half an electrical turn, instead of pole_pairs",
       .unit = "mm",
       .range = base::above(0)});
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
           "odd harmonics of the back-EMF in addition to the sine, 3 to 23, with harmonic_sizes; back_emf = \"sine\""});
  v.value("harmonic_sizes", s.harmonic_sizes,
          {.meaning = "amplitudes of the harmonics, relative to the sine's amplitude; cos n (theta - 60 deg)",
           .range = base::between(-1, 1)});
  v.value("back_emf_angle_deg", s.back_emf_angle_deg,
          {.meaning =
               "table: electrical angles of back_emf_shape, rising; phase b has the same shape 120 degrees "
               "later",
           .unit = "deg",
           .range = {0, 360, true, false}});
  v.value(
      "back_emf_shape", s.back_emf_shape,
      {.meaning =
           "table: phase a's back-EMF at these angles, without normalization; the back-EMF constant multiplies these values. Their mean over the turn must be zero",
       .range = base::between(-1e6, 1e6)});
  v.value(
      "back_emf_file", s.back_emf_file,
      {.meaning =
           "table: a CSV file with a line of headings and rows of angle and value, instead of the two lists; its path is relative to this file"});
  v.choice("connection", s.connection, connection_choices, {.meaning = "connection of the three phases"});
  v.value("mutual_inductance_mH", s.mutual_inductance_mH,
          {.meaning = "delta: mutual inductance of two branches, negative as a rule",
           .unit = "mH",
           .range = base::between(-1e3, 1e3)});
  v.value(
      "phase_resistance_deviation", s.phase_resistance_deviation,
      {.meaning =
           "star: relative deviations of the resistances of phases a, b, c from the motor's value; 0.05 is 5 % more",
       .range = base::strictly_between(-1, 1)});
  v.value(
      "phase_back_emf_deviation", s.phase_back_emf_deviation,
      {.meaning =
           "star: relative deviations of the back-EMF constants of phases a, b, c from the motor's value; 0.05 is 5 % more",
       .range = base::strictly_between(-1, 1)});
  v.value("cogging_orders", s.cogging_orders,
          {.meaning =
               "periods of the cogging torque per turn of the shaft: the least common multiple of slots and "
               "poles, and its multiples; linear: per two pole pitches"});
  v.value("cogging_mNm", s.cogging_mNm,
          {.meaning = "amplitudes of the cogging torque", .unit = "mNm", .also = spellings::cogging});
  v.value("cogging_phase_deg", s.cogging_phase_deg,
          {.meaning = "phases of the cogging torque, sin(order theta + phase). Default: 0", .unit = "deg"});
  v.quantity("nominal_voltage_V", s.nominal_voltage_V,
             {.meaning = "voltage at which the sheet's other values hold",
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
  v.quantity(
      "d_axis_inductance_mH", s.d_axis_inductance_mH,
      {.meaning =
           "inductance of one phase along the magnets, L_d; together with q_axis_inductance_mH it replaces inductance_mH",
       .unit = "mH",
       .frame = "phase",
       .range = base::above(0),
       .also = spellings::d_axis_inductance});
  v.quantity(
      "q_axis_inductance_mH", s.q_axis_inductance_mH,
      {.meaning =
           "inductance of one phase across the magnets, L_q; together with d_axis_inductance_mH it replaces inductance_mH",
       .unit = "mH",
       .frame = "phase",
       .range = base::above(0),
       .also = spellings::q_axis_inductance});
  v.quantity(
      "saturation_current_A", s.saturation_current_A,
      {.meaning =
           "I_sat of lambda_d = L_d i_d (1 - i_d/(2 I_sat)), i_d along the magnets. The drive's pulses distinguish north from south by this saturation; valid for |i_d| < I_sat/2",
       .unit = "A",
       .range = base::above(0)});
}

}  // namespace sixstep::design
