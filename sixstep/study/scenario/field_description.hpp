// SPDX-License-Identifier: Apache-2.0
// The keys of [control.field]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/describe.hpp"
#include "sixstep/study/scenario/field.hpp"

namespace sixstep::study {

inline constexpr base::Choice<control::VoltageLimit> voltage_limit_choices[] = {
    {"circle", control::VoltageLimit::circle,
     "the vector within the measured bus over sqrt 3; what weakens the field comes first"},
    {"axes", control::VoltageLimit::axes, "each axis within half the nominal bus"},
};

template <class Visitor>
void describe(Visitor& v, Field& s) {
  using base::above;
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
           "most current against the magnet, that is asked for where the bus is short of the back-EMF; without "
           "it none is",
       .unit = "A",
       .range = above(0)});
  v.value(
      "advance_periods", s.advance_periods,
      {.meaning =
           "control periods by which the rotor turns on before an answer acts; without it those up to the middle "
           "of the period that it fills",
       .range = base::between(0, 10)});
}

}  // namespace sixstep::study
