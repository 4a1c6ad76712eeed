// SPDX-License-Identifier: Apache-2.0
// The keys of [protection]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/linear_words.hpp"
#include "sixstep/study/scenario/protection.hpp"

namespace sixstep::study {

inline void describe(base::Visitor& v, Align& s) {
  v.value("current_A", s.current_A,
          {.meaning = "current that aligns the rotor before the drive starts. Default: no alignment",
           .unit = "A",
           .range = base::above(0)});
  v.value("longest_s", s.longest_s,
          {.meaning = "longest time for the alignment; a rotor that is not aligned by then is a fault",
           .unit = "s",
           .range = base::above(0)});
  v.value("settled_s", s.settled_s,
          {.meaning = "time for which the rotor must stay aligned", .unit = "s", .range = base::from(0)});
  v.value(
      "sector", s.sector,
      {.meaning =
           "sector whose driven pair aligns the rotor; the rotor moves to the edge between the next two sectors",
       .range = base::between(0, 5)});
}

inline void describe_thresholds(base::Visitor& v, Protection& s) {
  using base::above;
  using base::from;
  v.value(
      "over_current_A", s.over_current_A,
      {.meaning = "a measured phase current above this value is a fault", .unit = "A", .range = above(0)});
  v.value("over_voltage_V", s.over_voltage_V,
          {.meaning = "a bus voltage above this value is a fault", .unit = "V", .range = above(0)});
  v.value("under_voltage_V", s.under_voltage_V,
          {.meaning = "a bus voltage below this value is a fault", .unit = "V", .range = from(0)});
  v.value("over_speed_rad_s", s.over_speed_rad_s,
          {.meaning = "a speed above this value is a fault",
           .unit = "rad/s",
           .range = above(0),
           .also = words::over_speed});
  v.value("voltage_samples", s.voltage_samples,
          {.meaning = "number of consecutive samples of a wrong voltage that make a fault",
           .range = base::between(1, 255)});
  v.value(
      "stall_current_A", s.stall_current_A,
      {.meaning =
           "a phase current above this value without a Hall edge for stall_s is a fault. Default: stalling is not monitored",
       .unit = "A",
       .range = above(0)});
  v.value(
      "stall_s", s.stall_s,
      {.meaning = "longest time without a Hall edge above stall_current_A", .unit = "s", .range = above(0)});
  v.value("offset_tolerance_A", s.offset_tolerance_A,
          {.meaning = "offset beyond which a current amplifier counts as faulty. Default: 2 % of "
                      "sensors.current_range_A",
           .unit = "A",
           .range = above(0)});
}

inline void describe(base::Visitor& v, Protection& s) {
  using base::from;
  describe_thresholds(v, s);
  v.table("align", s.align, {.meaning = "alignment of the rotor before the drive starts"});
  v.value("brake_current_A", s.brake_current_A,
          {.meaning = "braking current after the request to run is removed; 0: the motor coasts",
           .unit = "A",
           .range = from(0)});
  v.value(
      "short_below_rad_s", s.short_below_rad_s,
      {.meaning =
           "speed below which braking shorts the driven windings. Default: the speed at which the short circuit carries brake_current_A",
       .unit = "rad/s",
       .range = from(0),
       .also = words::short_below});
  v.value(
      "standing_rad_s", s.standing_rad_s,
      {.meaning =
           "speed at which braking ends and the bridge turns off; 0: braking ends after sensors.timeout_s without a Hall edge",
       .unit = "rad/s",
       .range = from(0),
       .also = words::standing});
  v.value("off_at_s", s.off_at_s,
          {.meaning = "time at which the request to run is removed. Default: never. The request begins at 0",
           .unit = "s",
           .range = from(0)});
}

}  // namespace sixstep::study
