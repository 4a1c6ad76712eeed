// SPDX-License-Identifier: Apache-2.0
// The keys of [sensors.encoder], [sensors.absolute] and [sensors.resolver]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/sensors.hpp"

namespace sixstep::study {

inline constexpr base::Choice<rig::ResolverReading> resolver_reading_choices[] = {
    {"sampled", rig::ResolverReading::sampled,
     "the drive samples both windings at the excitation's peaks and follows them by itself"},
    {"tracking", rig::ResolverReading::tracking,
     "a converter chip follows them at its own clock, and gives out angle and speed"},
};

}  // namespace sixstep::study

// The structs are the board's, and argument-dependent lookup finds their descriptions only in their namespace.
namespace sixstep::rig {

inline void describe(base::Visitor& v, Encoder& s) {
  v.value("lines", s.lines,
          {.meaning = "of a turn; the timer counts four edges of each", .range = base::between(1, 1000000)});
  v.value(
      "pitch_mm", s.pitch_mm,
      {.meaning =
           "linear motor: a line of the scale, of which two pole pitches are a whole number; one index at 0",
       .unit = "mm",
       .range = base::above(0)});
  v.value(
      "referenced", s.referenced,
      {.meaning = "whether the index was passed before the run; else the Hall probes commutate until it is"});
  v.value(
      "missed_Hz", s.missed_Hz,
      {.meaning = "how often an edge is not counted, in the mean, at instants drawn by seed; the next index "
                  "mends the count",
       .unit = "Hz",
       .range = base::from(0)});
}

inline void describe(base::Visitor& v, AbsoluteEncoder& s) {
  v.value("bits", s.bits, {.meaning = "of its Gray code", .range = base::between(4, 20)});
  v.value("latency_s", s.latency_s,
          {.meaning = "how long before a sample the code that it reads was latched",
           .unit = "s",
           .range = base::from(0)});
  v.value("speed_samples", s.speed_samples,
          {.meaning = "control periods that the speed is taken over", .range = base::between(1, 8)});
}

inline void describe(base::Visitor& v, Resolver& s) {
  v.value("pole_pairs", s.pole_pairs,
          {.meaning = "of the resolver itself; those of the motor are a multiple of them",
           .range = base::between(1, 32)});
  v.value("amplitude_V", s.amplitude_V,
          {.meaning = "peak of either winding at the converter", .unit = "V", .range = base::above(0)});
  v.value("excitation_Hz", s.excitation_Hz,
          {.meaning = "of its excitation; sampled, its half period is a whole number of control periods",
           .unit = "Hz",
           .range = base::between(100, 1e6)});
  v.value("imbalance", s.imbalance,
          {.meaning = "how much larger the sine's winding is, as a part", .range = base::between(-0.5, 0.5)});
  v.value("quadrature_deg", s.quadrature_deg,
          {.meaning = "by how much the windings miss a right angle, of the resolver's own turn",
           .unit = "deg",
           .range = base::between(-45, 45)});
  v.value("phase_deg", s.phase_deg,
          {.meaning = "how far the windings' voltages lead the excitation",
           .unit = "deg",
           .range = base::between(-60, 60)});
  v.value("sine_phase_deg", s.sine_phase_deg,
          {.meaning = "the same of the sine's winding, where it is another",
           .unit = "deg",
           .range = base::between(-60, 60)});
  v.value(
      "calibrated", s.calibrated,
      {.meaning =
           "sampled: the drive knows imbalance, right angle and phases of this resolver, and takes them off"});
  v.value("noise_V", s.noise_V,
          {.meaning = "root mean square of the noise of a sample", .unit = "V", .range = base::from(0)});
  v.value("bandwidth_Hz", s.bandwidth_Hz,
          {.meaning = "of the loop that follows the angle, and so finds the speed",
           .unit = "Hz",
           .range = base::above(0)});
  v.value("damping", s.damping, {.meaning = "of that loop", .range = base::between(0.1, 10)});
  v.value(
      "bits", s.bits,
      {.meaning = "of the angle that it gives out; tracking: at least 10", .range = base::between(8, 16)});
  v.choice("reading", s.reading, study::resolver_reading_choices,
           {.meaning = "who makes an angle of the windings"});
  v.value("converter_Hz", s.converter_Hz,
          {.meaning = "tracking: clock of the chip's loop", .unit = "Hz", .range = base::between(1e3, 1e7)});
  v.value("latency_s", s.latency_s,
          {.meaning = "tracking: how long before a sample the angle that it reads was latched",
           .unit = "s",
           .range = base::from(0)});
}

}  // namespace sixstep::rig
