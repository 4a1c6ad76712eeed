// SPDX-License-Identifier: Apache-2.0
// The keys of [control.sensorless]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/sensorless.hpp"

namespace sixstep::study {

inline constexpr base::Choice<Commutates> commutates_choices[] = {
    {"back-emf", Commutates::back_emf, "the zero crossings of the free phase's terminal voltage"},
    {"hall", Commutates::hall, "the Hall probes; the drive also measures the crossings"},
};

inline constexpr base::Choice<control::Follow> follow_choices[] = {
    {"crossings", control::Follow::crossings, "the zero crossing of the free phase's terminal voltage"},
    {"luenberger", control::Follow::luenberger, "the crossing of a Luenberger observer's back-EMF"},
    {"sliding-mode", control::Follow::sliding_mode, "the crossing of a sliding-mode observer's back-EMF"},
    {"flux-linkage", control::Follow::flux,
     "the flux linkage since the crossing, which determines the commutation instant"},
    {"comparators", control::Follow::comparators,
     "the terminal's crossing by the captured edges of sensors.comparators"},
};

inline constexpr base::Choice<StartsBy> starts_by_choices[] = {
    {"alignment", StartsBy::alignment,
     "alignment: two driven pairs, one after the other, pull the rotor to a known angle"},
    {"pulses", StartsBy::pulses,
     "six short pulses measure the rotor's angle if saliency and saturation are large enough; else the rotor is aligned"},
};

inline void describe(base::Visitor& v, Sensorless& s) {
  using base::above;
  using base::between;
  v.value("greatest_load", s.greatest_load,
          {.meaning =
               "largest load torque against which the drive must start, as a fraction of the nominal torque",
           .range = between(0, 10)});
  v.value("overload", s.overload,
          {.meaning = "current of alignment and ramp, relative to the nominal current",
           .range = base::Range{0, 10, false, true}});
  v.value(
      "lowest_part", s.lowest_part,
      {.meaning =
           "lowest speed at which the ramp ends and commutation by the back-EMF begins, as a fraction of the no-load speed; the design raises this speed if the converter requires it",
       .range = base::Range{0, 0.5, false, true}});
  v.value("advance_deg", s.advance_deg,
          {.meaning =
               "advance: electrical angle by which the pair changes before the middle between two crossings",
           .unit = "deg",
           .range = between(0, 30)});
  v.value(
      "blanking_s", s.blanking_s,
      {.meaning =
           "time after the end of the freewheeling in which no crossing counts, because the dividers' filters must settle",
       .unit = "s",
       .range = base::from(0)});
  v.value(
      "mismatch", s.mismatch,
      {.meaning =
           "largest relative difference of the three terminals' dividers; the threshold for crossings includes this difference",
       .range = base::Range{0, 0.2, true, false}});
  v.choice(
      "follows", s.follows, follow_choices,
      {.meaning =
           "signal from which the drive finds the zero crossings; an observer averages the converters' noise and compensates the lag of the average"});
  v.value("catches_spin", s.catches_spin,
          {.meaning = "whether the drive checks for a rotor that already turns, before the alignment"});
  v.choice("starts_by", s.starts_by, starts_by_choices,
           {.meaning = "method to find a rotor at rest; pulses needs sensors.currents = \"phases\""});
  v.choice("commutates", s.commutates, commutates_choices,
           {.meaning = "source of the commutation; hall needs sensors.rotor = \"hall\""});
  v.value(
      "falls_back", s.falls_back,
      {.meaning =
           "whether the drive commutates by the crossings after a Hall line fails; otherwise the drive stops"});
}

}  // namespace sixstep::study
