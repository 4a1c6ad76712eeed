// SPDX-License-Identifier: Apache-2.0
// The keys of [believed]: names, units, ranges and meanings. The motor's values have the keys of a motor file.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/design/sheet/sheet_spellings.hpp"
#include "sixstep/design/sheet/winding_description.hpp"
#include "sixstep/study/scenario/believed.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {

inline void describe_believed_winding(base::Visitor& v, Believed& s) {
  using base::above;
  namespace spellings = design::spellings;
  v.value(
      "pole_pairs", s.pole_pairs,
      {.meaning =
           "pole pairs with which the drive converts edges to speed, and the shaft's angle to the electrical angle",
       .range = base::between(1, design::most_pole_pairs)});
  v.quantity("resistance_ohm", s.resistance_ohm,
             {.meaning = "winding resistance, between two terminals or of one phase of the star",
              .unit = "ohm",
              .frame = "terminal|phase",
              .range = above(0),
              .also = spellings::resistance});
  v.quantity("inductance_mH", s.inductance_mH,
             {.meaning = "winding inductance, between two terminals or of one phase of the star",
              .unit = "mH",
              .frame = "terminal|phase",
              .range = above(0),
              .also = spellings::inductance});
  v.quantity("d_axis_inductance_mH", s.d_axis_inductance_mH,
             {.meaning = "inductance of one phase along the magnets, L_d; needs q_axis_inductance_mH",
              .unit = "mH",
              .frame = "phase",
              .range = above(0),
              .also = spellings::d_axis_inductance});
  v.quantity("q_axis_inductance_mH", s.q_axis_inductance_mH,
             {.meaning = "inductance of one phase across the magnets, L_q; needs d_axis_inductance_mH",
              .unit = "mH",
              .frame = "phase",
              .range = above(0),
              .also = spellings::q_axis_inductance});
}

inline void describe_believed_torque(base::Visitor& v, Believed& s) {
  using base::above;
  namespace spellings = design::spellings;
  v.quantity("torque_constant_mNm_A", s.torque_constant_mNm_A,
             {.meaning = "torque per ampere through the driven pair, mean over a sector",
              .unit = "mNm/A",
              .frame = "terminal",
              .range = above(0),
              .also = spellings::torque_constant});
  v.quantity("back_emf_mV_s", s.back_emf_mV_s,
             {.meaning = "peak of one phase's back-EMF per mechanical rad/s, instead of the torque constant",
              .unit = "mV s",
              .frame = "phase",
              .range = above(0),
              .also = spellings::back_emf_per_speed});
  v.quantity(
      "torque_constant_Nm_A", s.torque_constant_Nm_A,
      {.meaning =
           "instead of torque_constant_mNm_A: torque per ampere through the driven pair (terminal), of the q axis (peak) or of a sine in each phase (rms)",
       .unit = "Nm/A",
       .frame = "terminal|peak|rms",
       .range = above(0),
       .also = spellings::torque_per_A});
  v.quantity("flux_linkage_mWb", s.flux_linkage_mWb,
             {.meaning = "flux of the magnets through one phase, instead of the torque constant",
              .unit = "mWb",
              .frame = "phase",
              .range = above(0),
              .also = spellings::flux_linkage});
  v.quantity("speed_constant_rpm_V", s.speed_constant_rpm_V,
             {.meaning = "speed per volt, KV, instead of the torque constant",
              .unit = "rpm/V",
              .frame = "six-step|line-peak",
              .range = above(0),
              .also = spellings::speed_constant});
  v.quantity("inertia_gcm2", s.inertia_gcm2,
             {.meaning = "moment of inertia of the rotor; the load's inertia does not change",
              .unit = "g cm2",
              .range = above(0),
              .also = spellings::inertia});
}

inline void describe(base::Visitor& v, Believed& s) {
  describe_believed_winding(v, s);
  describe_believed_torque(v, s);
  v.choice(
      "hall_lines", s.hall_lines, hall_order_choices,
      {.meaning =
           "Hall probes that the drive's table assumes at pins H1, H2, H3; correct if equal to sensors.hall_lines"});
  v.value(
      "sensor_offset_deg", s.sensor_offset_deg,
      {.meaning = "electrical angle that the drive subtracts from the angle of encoder, absolute encoder or "
                  "resolver; correct if equal to the sensor's offset_deg",
       .unit = "deg",
       .range = base::between(-360, 360)});
}

}  // namespace sixstep::study
