// SPDX-License-Identifier: Apache-2.0
// The keys of [sensors.comparators]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/sensors.hpp"

namespace sixstep::study {

inline constexpr base::Choice<rig::CrossingReference> crossing_reference_choices[] = {
    {"virtual-star", rig::CrossingReference::virtual_star,
     "the mean of the three filtered terminals, as three equal resistors make it"},
    {"half-bus", rig::CrossingReference::half_bus,
     "half the bus, filtered alike: it tells while the pair is on, and the filter has to be settled within half a pulse"},
};

inline void describe(base::Visitor& v, Comparators& s) {
  v.value("bandwidth_Hz", s.bandwidth_Hz,
          {.meaning = "of the low-pass in front of each, a first-order lag; comparators need one",
           .unit = "Hz",
           .range = base::between(1, 1e6)});
  v.choice("against", s.against, crossing_reference_choices,
           {.meaning = "what each terminal is held against"});
  v.value("offset_V", s.offset_V,
          {.meaning = "by how much the levels of terminals a, b, c are too high, seen at the terminal: 3 "
                      "values; the drive is designed for the largest",
           .unit = "V",
           .range = base::between(-1000, 1000)});
  v.value("hysteresis_V", s.hysteresis_V,
          {.meaning = "between the levels of a rising and a falling edge, seen at the terminal",
           .unit = "V",
           .range = base::between(0, 1000)});
}

}  // namespace sixstep::study
