// SPDX-License-Identifier: Apache-2.0
// The keys of [[at]]: what may change while a run goes on.
#pragma once
#include "sixstep/study/scenario/reference_description.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {

/// What is told to whoever asks for anything else.
inline constexpr std::string_view what_may_change =
    "during a run change only: reference; supply.voltage_V, supply.sinks; load.torque_Nm, load.locked; "
    "sensors.hall_break; request";

template <class Visitor>
void describe(Visitor& v, AtSupply& s) {
  v.value("voltage_V", s.voltage_V,
          {.meaning = "voltage of the source from then on; a stiff bus follows at once",
           .unit = "V",
           .range = base::above(0)});
  v.value("sinks", s.sinks, {.meaning = "whether the source takes current back from then on"});
}

template <class Visitor>
void describe(Visitor& v, AtLoad& s) {
  v.value("torque_Nm", s.torque_Nm,
          {.meaning = "load torque from then on, until the next of load.times_s", .unit = "N m"});
  v.value("locked", s.locked,
          {.meaning = "true: a clamp stops the rotor at once and holds it; false: it is let go"});
}

inline constexpr base::Choice<PinLevel> pin_level_choices[] = {
    {"low", PinLevel::low, "0, as a line that is shorted to ground"},
    {"high", PinLevel::high, "1, as a line that is cut before its pull-up"},
    {"probe", PinLevel::probe, "what its probe says: the break is over, and was a glitch"},
};

template <class Visitor>
void describe(Visitor& v, AtHallBreak& s) {
  v.value("line", s.line, {.meaning = "which of H1, H2, H3", .range = base::between(1, 3)});
  v.choice("level", s.level, pin_level_choices, {.meaning = "what the pin reads from then on"});
}

template <class Visitor>
void describe(Visitor& v, AtSensors& s) {
  v.table("hall_break", s.hall_break, {.meaning = "a Hall line that breaks then, or is whole again"});
}

template <class Visitor>
void describe(Visitor& v, At& s) {
  v.value("time_s", s.time_s,
          {.meaning = "when", .unit = "s", .range = base::between(0, longest_s), .required = true});
  v.table("reference", s.reference,
          {.meaning = "the reference from then on; its times count from time_s", .cure = what_may_change});
  v.table("supply", s.supply, {.meaning = "the source from then on", .cure = what_may_change});
  v.table("load", s.load, {.meaning = "the load from then on", .cure = what_may_change});
  v.table("sensors", s.sensors, {.meaning = "what happens to the sensors", .cure = what_may_change});
  v.choice("request", s.request, request_choices, {.meaning = "what the product drive is asked for"});
}

}  // namespace sixstep::study
