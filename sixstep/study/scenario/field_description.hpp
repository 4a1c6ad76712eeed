// SPDX-License-Identifier: Apache-2.0
// The keys of [control.field]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/field.hpp"

namespace sixstep::study {

inline constexpr base::Choice<control::VoltageLimit> voltage_limit_choices[] = {
    {"circle", control::VoltageLimit::circle,
     "the voltage vector is limited to the measured bus voltage divided by sqrt 3; its component along the magnet, which weakens the field, has priority"},
    {"axes", control::VoltageLimit::axes,
     "the voltage of each axis is limited to half the nominal bus voltage"},
};

inline constexpr base::Choice<FieldAngle> field_angle_choices[] = {
    {"sensors", FieldAngle::sensors, "the rotor position sensor in sensors.rotor"},
    {"injection", FieldAngle::injection,
     "injection of voltage pulses along the magnet's axis: works from standstill on, with a salient rotor "
     "whose iron saturates"},
    {"observer", FieldAngle::observer,
     "observer of the magnet's flux in the winding; a current turns the rotor until the flux is large enough"},
    {"injection-observer", FieldAngle::injection_observer,
     "injection at rest and low speed, observer above observer_from_rad_s"},
};

inline constexpr base::Choice<FieldLaw> field_law_choices[] = {
    {"pi", FieldLaw::pi, "a PI controller for each axis; PWM generates the voltage"},
    {"finite-set", FieldLaw::finite_set,
     "no PWM: the three legs keep one of their eight states for a whole period, the state whose predicted current is nearest to its reference"},
};

inline void describe(base::Visitor& v, Field& s) {
  using base::above;
  v.choice("law", s.law, field_law_choices, {.meaning = "controller of the currents"});
  v.value("bandwidth_Hz", s.bandwidth_Hz,
          {.meaning =
               "bandwidth of the current loops, whose zero cancels the winding's pole. Default without gains "
               "in control.current: a twentieth of the control frequency",
           .unit = "Hz",
           .range = above(0)});
  v.choice("voltage_limit", s.voltage_limit, voltage_limit_choices,
           {.meaning = "limit of the voltages of both axes"});
  v.value(
      "decoupling", s.decoupling,
      {.meaning =
           "whether the controller adds the voltages that rotation induces in the two axes, by the other axis's current and by the magnet"});
  v.value(
      "torque_per_ampere", s.torque_per_ampere,
      {.meaning =
           "whether a salient rotor gets the current along the magnet that gives the largest torque per ampere"});
  v.value(
      "weakening_A", s.weakening_A,
      {.meaning =
           "largest reference of the current against the magnet (field weakening) where the back-EMF needs "
           "more than the bus. Default: no weakening; a current through the diodes may still flow",
       .unit = "A",
       .range = above(0)});
  v.value(
      "advance_periods", s.advance_periods,
      {.meaning =
           "number of control periods over which the angle is extrapolated until a command acts. Default: "
           "up to the middle of the period in which the command is applied",
       .range = base::between(0, 10)});
  v.choice("angle", s.angle, field_angle_choices,
           {.meaning = "method by which the drive determines the magnet's angle"});
  v.value("angle_bandwidth_Hz", s.angle_bandwidth_Hz,
          {.meaning = "bandwidth of the loop that tracks the estimated angle. Default: a hundredth of the "
                      "control frequency, more if the angle would lag by 5 degrees at full torque",
           .unit = "Hz",
           .range = above(0)});
  v.value(
      "injection_V", s.injection_V,
      {.meaning = "injected phase voltage. Default: a quarter of the largest voltage of three legs, or the "
                  "voltage that changes the current by a fifth of its limit",
       .unit = "V",
       .range = above(0)});
  v.value("observer_from_rad_s", s.observer_from_rad_s,
          {.meaning = "speed above which only the observer determines the angle. Default: speed at which the "
                      "back-EMF is a tenth of the largest voltage of three legs",
           .unit = "rad/s",
           .range = above(0)});
  v.value(
      "start_current_A", s.start_current_A,
      {.meaning = "current amplitude that turns the rotor until the observer follows the rotor. Default: the "
                  "limit or the nominal current",
       .unit = "A",
       .range = above(0)});
  v.value(
      "harmonic_current", s.harmonic_current,
      {.meaning =
           "whether the current follows the shape of a non-sinusoidal back-EMF, so that its torque is the "
           "same at every angle. The drive uses the smallest current with this torque"});
  v.value(
      "switching_weight_A", s.switching_weight_A,
      {.meaning =
           "finite-set: weight of one switching of a leg, as a current; its square is added to the squared distance of the current from its reference",
       .unit = "A",
       .range = base::from(0)});
  v.value(
      "peak_A", s.peak_A,
      {.meaning =
           "finite-set: limit of the current amplitude; a state that exceeds this limit is chosen only if all states exceed the limit",
       .unit = "A",
       .range = above(0)});
  v.value(
      "delay_compensation", s.delay_compensation,
      {.meaning =
           "finite-set: whether the controller predicts the current in the period in which its answer acts, if the answer acts one period late"});
}

}  // namespace sixstep::study
