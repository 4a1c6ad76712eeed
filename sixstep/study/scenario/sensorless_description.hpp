// SPDX-License-Identifier: Apache-2.0
// The keys of [control.sensorless]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/sensorless.hpp"

namespace sixstep::study {

inline constexpr base::Choice<Commutates> commutates_choices[] = {
    {"back-emf", Commutates::back_emf, "the zero crossings of the floating terminal"},
    {"hall", Commutates::hall, "the Hall probes; the crossings are watched"},
};

inline constexpr base::Choice<control::Follow> follow_choices[] = {
    {"crossings", control::Follow::crossings, "the floating terminal's own zero crossing"},
    {"luenberger", control::Follow::luenberger, "the crossing of a Luenberger observer's back-EMF"},
    {"sliding-mode", control::Follow::sliding_mode, "that of a sliding-mode observer"},
    {"flux-linkage", control::Follow::flux, "the flux linkage since the crossing: it says when to commutate"},
    {"comparators", control::Follow::comparators,
     "the terminal's crossing by the captured edges of sensors.comparators"},
};

inline constexpr base::Choice<StartsBy> starts_by_choices[] = {
    {"alignment", StartsBy::alignment, "two pairs in turn pull it to a known place"},
    {"pulses", StartsBy::pulses,
     "six short pulses ask how it stands, where saliency and saturation show it; else it is aligned"},
};

inline void describe(base::Visitor& v, Sensorless& s) {
  using base::above;
  using base::between;
  v.value("greatest_load", s.greatest_load,
          {.meaning = "load that it must start against, as a part of the nominal torque",
           .range = between(0, 10)});
  v.value("overload", s.overload,
          {.meaning = "current of alignment and ramp, in nominal ones",
           .range = base::Range{0, 10, false, true}});
  v.value("lowest_part", s.lowest_part,
          {.meaning = "speed at which the ramp hands over, as a part of the no-load speed; more, where the "
                      "converter needs it",
           .range = base::Range{0, 0.5, false, true}});
  v.value("advance_deg", s.advance_deg,
          {.meaning = "electrical angle by which the pair changes before the middle between two crossings",
           .unit = "deg",
           .range = between(0, 30)});
  v.value(
      "blanking_s", s.blanking_s,
      {.meaning = "time after the freewheel's end in which no crossing counts: that of the dividers' filters",
       .unit = "s",
       .range = base::from(0)});
  v.value(
      "mismatch", s.mismatch,
      {.meaning = "how unlike the three terminals' dividers may be, as a part: what crossings are told from",
       .range = base::Range{0, 0.2, true, false}});
  v.choice(
      "follows", s.follows, follow_choices,
      {.meaning =
           "what of the back-EMF is followed; an observer averages the converters' noise, and takes its own lag off"});
  v.value("catches_spin", s.catches_spin,
          {.meaning = "whether a rotor that turns already is listened for before it is aligned"});
  v.choice("starts_by", s.starts_by, starts_by_choices,
           {.meaning = "how a rotor at rest is found; pulses needs sensors.currents = \"phases\""});
  v.choice("commutates", s.commutates, commutates_choices,
           {.meaning = "what the pairs are commutated by; hall needs sensors.rotor = \"hall\""});
  v.value("falls_back", s.falls_back,
          {.meaning = "whether the crossings take over where a Hall line dies; else the drive stops"});
}

}  // namespace sixstep::study
