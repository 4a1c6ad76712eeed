// SPDX-License-Identifier: Apache-2.0
// The keys of [sensors.comparators]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/sensors.hpp"

namespace sixstep::study {

inline constexpr base::Choice<rig::CrossingReference> crossing_reference_choices[] = {
    {"virtual-star", rig::CrossingReference::virtual_star,
     "the mean of the three filtered terminal voltages, as formed by three equal resistors"},
    {"half-bus", rig::CrossingReference::half_bus,
     "half the bus voltage, with the same filter: valid while the driven pair is on, so the filter must settle within half a pulse"},
};

inline void describe(base::Visitor& v, Comparators& s) {
  v.value(
      "bandwidth_Hz", s.bandwidth_Hz,
      {.meaning =
           "bandwidth of the first-order low-pass in front of each comparator; a comparator needs a low-pass",
       .unit = "Hz",
       .range = base::between(1, 1e6)});
  v.choice("against", s.against, crossing_reference_choices,
           {.meaning = "voltage that each terminal is compared with"});
  v.value("offset_V", s.offset_V,
          {.meaning = "offsets of the comparators of terminals a, b, c, referred to the terminal: 3 "
                      "values; the drive is designed for the largest",
           .unit = "V",
           .range = base::between(-1000, 1000)});
  v.value("hysteresis_V", s.hysteresis_V,
          {.meaning = "hysteresis: difference between the levels of a rising and a falling edge, referred "
                      "to the terminal",
           .unit = "V",
           .range = base::between(0, 1000)});
}

}  // namespace sixstep::study
