// SPDX-License-Identifier: Apache-2.0
// The keys of [control.field]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/field.hpp"

namespace sixstep::study {

inline constexpr base::Choice<control::VoltageLimit> voltage_limit_choices[] = {
    {"circle", control::VoltageLimit::circle,
     "the vector within the measured bus over sqrt 3; what weakens the field comes first"},
    {"axes", control::VoltageLimit::axes, "each axis within half the nominal bus"},
};

inline constexpr base::Choice<FieldAngle> field_angle_choices[] = {
    {"sensors", FieldAngle::sensors, "what [sensors] says of the rotor"},
    {"injection", FieldAngle::injection,
     "a voltage that pulses along the magnet's axis: from standstill on, of a salient rotor that saturates"},
    {"observer", FieldAngle::observer,
     "the flux that the magnet makes in the winding; a current turns the rotor until it is seen"},
    {"injection-observer", FieldAngle::injection_observer, "the one at rest, the other at speed"},
};

inline constexpr base::Choice<FieldLaw> field_law_choices[] = {
    {"pi", FieldLaw::pi, "a PI for each axis, whose voltage is made of pulses"},
    {"finite-set", FieldLaw::finite_set,
     "no pulses: three legs keep one of their eight states for a whole period, the one whose predicted current is "
     "nearest to its reference"},
};

inline void describe(base::Visitor& v, Field& s) {
  using base::above;
  v.choice("law", s.law, field_law_choices, {.meaning = "what holds the currents"});
  v.value(
      "bandwidth_Hz", s.bandwidth_Hz,
      {.meaning =
           "of the current loops, whose zero is put on the winding's pole; without it and without gains in "
           "control.current a twentieth of the control frequency",
       .unit = "Hz",
       .range = above(0)});
  v.choice("voltage_limit", s.voltage_limit, voltage_limit_choices,
           {.meaning = "what the voltages of both axes are kept within"});
  v.value(
      "decoupling", s.decoupling,
      {.meaning =
           "whether the voltages that turning makes in the axes are added: of the other axis's current and of "
           "the magnet"});
  v.value(
      "torque_per_ampere", s.torque_per_ampere,
      {.meaning =
           "whether a salient rotor gets the current along the magnet that makes most torque per ampere"});
  v.value(
      "weakening_A", s.weakening_A,
      {.meaning =
           "most current against the magnet that is asked for where the bus is short of the back-EMF; without it "
           "none is, but for what flows beyond the bus whatever is asked for",
       .unit = "A",
       .range = above(0)});
  v.value(
      "advance_periods", s.advance_periods,
      {.meaning =
           "control periods by which the rotor turns on before an answer acts; without it those up to the middle "
           "of the period that it fills",
       .range = base::between(0, 10)});
  v.choice("angle", s.angle, field_angle_choices, {.meaning = "what tells where the magnet points"});
  v.value("angle_bandwidth_Hz", s.angle_bandwidth_Hz,
          {.meaning = "of the loop that follows an angle that no sensor tells; without it a hundredth of the "
                      "control frequency, and more where full torque would leave the angle 5 degrees behind",
           .unit = "Hz",
           .range = above(0)});
  v.value("injection_V", s.injection_V,
          {.meaning =
               "voltage of a phase that is injected; without it a quarter of what three legs make, or what "
               "changes the current by a fifth of its limit",
           .unit = "V",
           .range = above(0)});
  v.value("observer_from_rad_s", s.observer_from_rad_s,
          {.meaning = "speed above which the observer alone tells the angle; without it that at which the "
                      "back-EMF is a tenth of what three legs make",
           .unit = "rad/s",
           .range = above(0)});
  v.value(
      "start_current_A", s.start_current_A,
      {.meaning = "amplitude that turns the rotor until the observer sees it; without it the limit or the "
                  "nominal current",
       .unit = "A",
       .range = above(0)});
  v.value(
      "harmonic_current", s.harmonic_current,
      {.meaning =
           "whether the current follows the shape of a back-EMF that is no sine, so that its torque is the same "
           "at every angle: the least current that makes it, along the magnet and across it"});
  v.value(
      "switching_weight_A", s.switching_weight_A,
      {.meaning =
           "finite-set: the distance from its reference that a current may have beside a better one for each leg "
           "that need not switch: squares are added",
       .unit = "A",
       .range = base::from(0)});
  v.value(
      "peak_A", s.peak_A,
      {.meaning = "finite-set: amplitude of the currents beyond which a state is taken only where all are",
       .unit = "A",
       .range = above(0)});
  v.value(
      "delay_compensation", s.delay_compensation,
      {.meaning =
           "finite-set: whether the current is predicted for the period in which an answer acts, where that is a "
           "period late"});
}

}  // namespace sixstep::study
