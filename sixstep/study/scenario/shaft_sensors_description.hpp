// SPDX-License-Identifier: Apache-2.0
// The keys of [sensors.encoder], [sensors.absolute] and [sensors.resolver]: names, units, ranges and
// meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/sensors.hpp"

namespace sixstep::study {

inline constexpr base::Choice<rig::ResolverReading> resolver_reading_choices[] = {
    {"sampled", rig::ResolverReading::sampled,
     "the drive samples both windings at the excitation's peaks; a tracking loop of the drive follows the samples"},
    {"tracking", rig::ResolverReading::tracking,
     "a converter chip tracks both windings at its own clock and outputs angle and speed"},
};

}  // namespace sixstep::study

// The structs belong to the board (rig). Argument-dependent lookup finds describe() only in the namespace of
// the structs.
namespace sixstep::rig {

inline void describe(base::Visitor& v, Encoder& s) {
  v.value("lines", s.lines,
          {.meaning = "number of lines per turn; the timer counts four edges of each line",
           .range = base::between(1, 1000000)});
  v.value(
      "pitch_mm", s.pitch_mm,
      {.meaning =
           "linear motor: length of a line of the scale; two pole pitches must be a whole number of lines. The scale has one index, at 0",
       .unit = "mm",
       .range = base::above(0)});
  v.value(
      "referenced", s.referenced,
      {.meaning =
           "whether the rotor passed the index before the run; else the Hall probes commutate until the rotor passes the index"});
  v.value("missed_Hz", s.missed_Hz,
          {.meaning = "mean rate of edges that are not counted, at random instants drawn with seed; the next "
                      "index corrects the count",
           .unit = "Hz",
           .range = base::from(0)});
  v.value(
      "offset_deg", s.offset_deg,
      {.meaning = "mounting: electrical angle that the sensor shows minus the rotor's; the drive subtracts "
                  "believed.sensor_offset_deg",
       .unit = "deg",
       .range = base::between(-360, 360)});
}

inline void describe(base::Visitor& v, AbsoluteEncoder& s) {
  v.value("bits", s.bits, {.meaning = "number of bits of the Gray code", .range = base::between(4, 20)});
  v.value("latency_s", s.latency_s,
          {.meaning = "age of the latched code at a sample", .unit = "s", .range = base::from(0)});
  v.value("speed_samples", s.speed_samples,
          {.meaning = "number of control periods over which the speed is averaged",
           .range = base::between(1, 8)});
  v.value(
      "offset_deg", s.offset_deg,
      {.meaning = "mounting: electrical angle that the sensor shows minus the rotor's; the drive subtracts "
                  "believed.sensor_offset_deg",
       .unit = "deg",
       .range = base::between(-360, 360)});
}

inline void describe(base::Visitor& v, Resolver& s) {
  v.value("pole_pairs", s.pole_pairs,
          {.meaning = "pole pairs of the resolver; the motor's pole pairs must be a multiple of this number",
           .range = base::between(1, 32)});
  v.value("amplitude_V", s.amplitude_V,
          {.meaning = "peak voltage of each winding at the converter", .unit = "V", .range = base::above(0)});
  v.value("excitation_Hz", s.excitation_Hz,
          {.meaning = "frequency of the excitation; if sampled, its half period must be a whole number of "
                      "control periods",
           .unit = "Hz",
           .range = base::between(100, 1e6)});
  v.value("imbalance", s.imbalance,
          {.meaning = "relative amplitude error of the sine winding; 0.05 is 5 % larger",
           .range = base::between(-0.5, 0.5)});
  v.value(
      "quadrature_deg", s.quadrature_deg,
      {.meaning = "deviation of the two windings from a right angle, in the resolver's electrical degrees",
       .unit = "deg",
       .range = base::between(-45, 45)});
  v.value("phase_deg", s.phase_deg,
          {.meaning = "phase angle by which the windings' voltages lead the excitation",
           .unit = "deg",
           .range = base::between(-60, 60)});
  v.value(
      "sine_phase_deg", s.sine_phase_deg,
      {.meaning =
           "phase angle by which the sine winding's voltage leads the excitation, if it differs from the cosine winding's",
       .unit = "deg",
       .range = base::between(-60, 60)});
  v.value(
      "calibrated", s.calibrated,
      {.meaning = "sampled: whether the drive corrects imbalance, angle error and phases of this resolver"});
  v.value("noise_V", s.noise_V,
          {.meaning = "root mean square of the noise of a sample", .unit = "V", .range = base::from(0)});
  v.value("bandwidth_Hz", s.bandwidth_Hz,
          {.meaning = "bandwidth of the tracking loop, which computes angle and speed",
           .unit = "Hz",
           .range = base::above(0)});
  v.value("damping", s.damping, {.meaning = "damping of the tracking loop", .range = base::between(0.1, 10)});
  v.value(
      "bits", s.bits,
      {.meaning = "bits of the tracking loop's angle; tracking: at least 10", .range = base::between(8, 16)});
  v.choice("reading", s.reading, study::resolver_reading_choices,
           {.meaning = "device that computes the angle from the windings"});
  v.value("converter_Hz", s.converter_Hz,
          {.meaning = "tracking: clock of the chip's loop", .unit = "Hz", .range = base::between(1e3, 1e7)});
  v.value("latency_s", s.latency_s,
          {.meaning = "tracking: age of the latched angle at a sample", .unit = "s", .range = base::from(0)});
  v.value(
      "offset_deg", s.offset_deg,
      {.meaning = "mounting: electrical angle that the sensor shows minus the rotor's; the drive subtracts "
                  "believed.sensor_offset_deg",
       .unit = "deg",
       .range = base::between(-360, 360)});
}

}  // namespace sixstep::rig
