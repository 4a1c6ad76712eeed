// SPDX-License-Identifier: Apache-2.0
// The keys of [sensors]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/describe.hpp"
#include "sixstep/study/scenario/sensors.hpp"

namespace sixstep::study {

inline constexpr base::Choice<rig::CurrentMeasurement> current_sensing_choices[] = {
    {"ideal", rig::CurrentMeasurement::ideal, "the phase currents as they are"},
    {"phases", rig::CurrentMeasurement::phases, "an amplifier and a converter per phase"},
    {"dc-link", rig::CurrentMeasurement::dc_link,
     "one shunt in the DC link, which shows the motor current within the on-time only"},
};
inline constexpr base::Choice<BusSensing> bus_sensing_choices[] = {
    {"ideal", BusSensing::ideal, "the bus voltage as it is"},
    {"adc", BusSensing::adc, "through the converter, from 0 to bus_range_V"},
};
inline constexpr base::Choice<RotorSensing> rotor_sensing_choices[] = {
    {"ideal", RotorSensing::ideal, "speed and position as they are"},
    {"hall", RotorSensing::hall, "from the times of the Hall edges, by the controller's own blocks"},
};
inline constexpr base::Choice<Level01> level_choices[] = {
    {"low", Level01::low, "0, as a line that is shorted to ground"},
    {"high", Level01::high, "1, as a line that is cut before its pull-up"},
};

template <class Visitor>
void describe(Visitor& v, HallBreak& s) {
  using base::between;
  v.value("at_s", s.at_s,
          {.meaning = "when a Hall line sticks; without it none does", .unit = "s", .range = base::from(0)});
  v.value("line", s.line, {.meaning = "which of H1 to H3", .range = between(1, 3)});
  v.choice("level", s.level, level_choices, {.meaning = "level it sticks at"});
}

template <class Visitor>
void describe_currents(Visitor& v, Sensors& s) {
  v.choice("currents", s.currents, current_sensing_choices,
           {.meaning = "how the controller gets the currents"});
  v.value("adc_bits", s.adc_bits, {.meaning = "bits of the converter", .range = base::between(4, 16)});
  v.value(
      "current_range_A", s.current_range_A,
      {.meaning = "current at the converter's ends, of either sign", .unit = "A", .range = base::above(0)});
  v.value("current_offset_A", s.current_offset_A,
          {.meaning = "what the amplifiers show at no current", .unit = "A"});
  v.value("current_gain_error", s.current_gain_error,
          {.meaning = "how much too large a current reads, as a part of it",
           .range = base::Range{-1, 1, false, true}});
  v.value("current_noise_A", s.current_noise_A,
          {.meaning = "root mean square of the noise of a sample", .unit = "A", .range = base::from(0)});
  v.value("calibrated", s.calibrated,
          {.meaning = "whether the controller measured the offset before the run, in 64 noisy samples"});
  v.value("shunt_settle_s", s.shunt_settle_s,
          {.meaning = "dc-link: how long a pulse must last before its sample counts",
           .unit = "s",
           .range = base::from(0)});
  v.value("commutation_samples", s.commutation_samples,
          {.meaning = "dc-link: samples after a Hall edge that are taken for the incoming phase",
           .range = base::between(0, 255)});
}

template <class Visitor>
void describe(Visitor& v, Sensors& s) {
  describe_currents(v, s);
  v.choice("bus", s.bus, bus_sensing_choices, {.meaning = "how the controller gets the bus voltage"});
  v.value("bus_range_V", s.bus_range_V,
          {.meaning = "voltage at the converter's upper end", .unit = "V", .range = base::above(0)});
  v.value("bus_offset_V", s.bus_offset_V,
          {.meaning = "what the converter shows at no voltage, beyond 0", .unit = "V"});
  v.value("bus_gain_error", s.bus_gain_error,
          {.meaning = "how much too large the voltage reads, as a part of it",
           .range = base::Range{-1, 1, false, true}});
  v.value("bus_noise_V", s.bus_noise_V,
          {.meaning = "root mean square of the noise of a sample", .unit = "V", .range = base::from(0)});
  v.choice("rotor", s.rotor, rotor_sensing_choices,
           {.meaning = "how the controller gets speed and position"});
  v.value("capture_Hz", s.capture_Hz,
          {.meaning = "clock of the timer that captures the Hall edges",
           .unit = "Hz",
           .range = base::between(1, 1e9)});
  v.value("speed_edges", s.speed_edges,
          {.meaning = "Hall edges that a speed is taken over; 6 are an electrical turn, over which faults of "
                      "the probes cancel, and 3.5 sectors old; 0: 6 where they cost the speed loop at most "
                      "22.5 degrees of phase, else 1",
           .range = base::between(0, 6)});
  v.value("timeout_s", s.timeout_s,
          {.meaning = "time without a Hall edge that counts as standstill",
           .unit = "s",
           .range = base::above(0)});
  v.value("hall_stable_samples", s.hall_stable_samples,
          {.meaning = "product drive: samples in a row that a Hall code must stand before it counts, against "
                      "glitches; above 1 an edge counts at a control tick, that many samples less one late, "
                      "and not in the interrupt",
           .range = base::between(1, 255)});
  v.value("seed", s.seed,
          {.meaning = "of the noise: the same seed, the same run", .range = base::between(0, 2147483647)});
  v.table("hall_break", s.hall_break, {.meaning = "a Hall line that breaks during the run"});
}

}  // namespace sixstep::study
