// SPDX-License-Identifier: Apache-2.0
// The keys of [sensors]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/comparators_description.hpp"
#include "sixstep/study/scenario/sensors.hpp"
#include "sixstep/study/scenario/shaft_sensors_description.hpp"

namespace sixstep::study {

inline constexpr base::Choice<rig::CurrentMeasurement> current_sensing_choices[] = {
    {"ideal", rig::CurrentMeasurement::ideal, "the phase currents as they are"},
    {"phases", rig::CurrentMeasurement::phases, "an amplifier and a converter per phase"},
    {"dc-link", rig::CurrentMeasurement::dc_link,
     "one shunt or Hall transducer in the DC link, which shows the motor current within the on-time only"},
};
inline constexpr base::Choice<BusSensing> bus_sensing_choices[] = {
    {"ideal", BusSensing::ideal, "the bus voltage as it is"},
    {"adc", BusSensing::adc, "through the converter, from 0 to bus_range_V"},
};
inline constexpr base::Choice<RotorSensing> rotor_sensing_choices[] = {
    {"ideal", RotorSensing::ideal, "speed and position as they are; the sensorless drive: no probes"},
    {"hall", RotorSensing::hall, "from the times of the Hall edges, by the controller's own blocks"},
    {"encoder", RotorSensing::encoder,
     "from an incremental encoder on a shaft; on the motor's, commutation too"},
    {"absolute", RotorSensing::absolute,
     "from an absolute encoder in Gray code; on the motor's shaft, commutation too"},
    {"resolver", RotorSensing::resolver,
     "from a resolver and a tracking loop; on the motor's shaft, commutation too"},
};
inline constexpr base::Choice<rig::HallAngleFrom> hall_angle_choices[] = {
    {"sectors", rig::HallAngleFrom::sectors, "by sectors of 60 degrees, as they are passed"},
    {"interpolated", rig::HallAngleFrom::angle,
     "by an angle that runs on between edges, less the probes' known delay and hysteresis; with "
     "pwm.commutation = \"sample\" it commutates, too"},
    {"calibrated", rig::HallAngleFrom::learned_edges,
     "the same by edges whose places are learned from the first steady turns; their common offset is not"},
};
inline constexpr base::Choice<SensorShaft> sensor_shaft_choices[] = {
    {"motor", SensorShaft::motor, "the motor's: it commutates"},
    {"load", SensorShaft::load,
     "the load's, behind gear and coupling: the Hall probes commutate, speed and position count times the gear"},
};
inline constexpr base::Choice<Level01> level_choices[] = {
    {"low", Level01::low, "0, as a line that is shorted to ground"},
    {"high", Level01::high, "1, as a line that is cut before its pull-up"},
};

inline constexpr base::Choice<rig::WireOrder> hall_order_choices[] = {
    {"123", rig::WireOrder::abc, "each probe at its own pin"},
    {"231", rig::WireOrder::bca, "probes 2, 3, 1 at H1, H2, H3: all three have moved on"},
    {"312", rig::WireOrder::cab, "probes 3, 1, 2: all three have moved back"},
    {"132", rig::WireOrder::acb, "probes 2 and 3 swapped"},
    {"321", rig::WireOrder::cba, "probes 1 and 3 swapped"},
    {"213", rig::WireOrder::bac, "probes 1 and 2 swapped"},
};
inline constexpr base::Choice<HallLines> hall_inverted_choices[] = {
    {"none", HallLines::none, "each pin reads its probe as it is"},
    {"1", HallLines::line_1, "H1 reads its probe inverted"},
    {"2", HallLines::line_2, "H2 reads its probe inverted"},
    {"3", HallLines::line_3, "H3 reads its probe inverted"},
    {"12", HallLines::lines_12, "H1 and H2"},
    {"13", HallLines::lines_13, "H1 and H3"},
    {"23", HallLines::lines_23, "H2 and H3"},
    {"123", HallLines::all, "all three: the code of the sector three further on"},
};

inline constexpr base::Choice<control::HallArrangement> hall_spacing_choices[] = {
    {"120", control::HallArrangement::degrees_120, "codes 000 and 111 are impossible"},
    {"60", control::HallArrangement::degrees_60, "codes 010 and 101 are impossible"},
};

inline void describe(base::Visitor& v, HallBreak& s) {
  using base::between;
  v.value("at_s", s.at_s,
          {.meaning = "when a Hall line sticks; without it none does", .unit = "s", .range = base::from(0)});
  v.value("line", s.line, {.meaning = "which of H1 to H3", .range = between(1, 3)});
  v.choice("level", s.level, level_choices, {.meaning = "level it sticks at"});
}

inline void describe_currents(base::Visitor& v, Sensors& s) {
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
  v.value(
      "current_bandwidth_Hz", s.current_bandwidth_Hz,
      {.meaning = "of each amplifier in front of the converter, a first-order lag; without it there is none",
       .unit = "Hz",
       .range = base::between(1, 1e9)});
  v.value("current_delay_s", s.current_delay_s,
          {.meaning = "how long before a sample the current was that it shows, beside that lag",
           .unit = "s",
           .range = base::from(0)});
  v.value("calibrated", s.calibrated,
          {.meaning = "whether the controller measured the offset before the run, in 64 noisy samples"});
  v.value(
      "shunt_settle_s", s.shunt_settle_s,
      {.meaning =
           "dc-link: how long a switch must have been on before its sample counts; with complementary chopping "
           "it turns on bridge.dead_time_s later",
       .unit = "s",
       .range = base::from(0)});
  v.value("commutation_samples", s.commutation_samples,
          {.meaning = "dc-link: samples after a Hall edge that are taken for the incoming phase",
           .range = base::between(0, 255)});
}

/// Mounting of the probes, in electrical degrees of the motor's angle.
inline void describe_probes(base::Visitor& v, Sensors& s) {
  v.choice("hall_spacing", s.hall_spacing, hall_spacing_choices,
           {.meaning = "how many electrical degrees the Hall probes stand apart"});
  v.value("hall_offset_deg", s.hall_offset_deg,
          {.meaning = "how far behind their places all Hall edges lie",
           .unit = "deg",
           .range = base::between(-180, 180)});
  v.value(
      "hall_edges_deg", s.hall_edges_deg,
      {.meaning = "how far each Hall edge lies behind that, the edge at 0 degrees first: 6 values for those "
                  "of an electrical turn, or 6 per pole pair for those of a mechanical one, whose magnets "
                  "stray",
       .unit = "deg",
       .range = base::between(-60, 60)});
  v.value("hall_hysteresis_deg", s.hall_hysteresis_deg,
          {.meaning = "between the places of a Hall edge forward and backward",
           .unit = "deg",
           .range = base::between(0, 59)});
  v.value("hall_delay_s", s.hall_delay_s,
          {.meaning = "from the place of a Hall edge to the edge of its line, as a filter makes it",
           .unit = "s",
           .range = base::between(0, 2e-4)});
  v.value("hall_glitches_Hz", s.hall_glitches_Hz,
          {.meaning = "how often a Hall line turns over for a moment, in the mean, at instants drawn by seed",
           .unit = "Hz",
           .range = base::from(0)});
  v.value("hall_glitch_s", s.hall_glitch_s,
          {.meaning = "how long", .unit = "s", .range = base::between(1e-9, 1e-3)});
}

inline void describe(base::Visitor& v, Sensors& s) {
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
  v.value(
      "bus_bandwidth_Hz", s.bus_bandwidth_Hz,
      {.meaning =
           "of the divider in front of the converter with the capacitor across it, a first-order lag, and of the "
           "terminals' dividers alike; without it there is none",
       .unit = "Hz",
       .range = base::between(1, 1e9)});
  v.value("terminal_gain_error", s.terminal_gain_error,
          {.meaning =
               "how much too large the dividers of terminals a, b, c show them, as parts: 3 values; what the "
               "drive knows of it is control.sensorless.mismatch",
           .range = base::between(-0.5, 0.5)});
  v.choice("rotor", s.rotor, rotor_sensing_choices,
           {.meaning = "how the controller gets speed and position"});
  v.value(
      "capture_Hz", s.capture_Hz,
      {.meaning = "clock of the timer that captures edges: of the Hall probes, of an incremental encoder, "
                  "of the comparators at the terminals; one tick in the time that a speed is taken "
                  "over is a step of that speed",
       .unit = "Hz",
       .range = base::between(1, 1e9)});
  v.value("speed_edges", s.speed_edges,
          {.meaning = "Hall edges that a speed is taken over; 6 are an electrical turn, over which faults of "
                      "the probes cancel, and 3.5 sectors old; 0: 6 where they cost the speed loop at most "
                      "22.5 degrees of phase, else 1",
           .range = base::between(0, 6)});
  v.choice("hall_angle", s.hall_angle, hall_angle_choices,
           {.meaning = "how speed and position between Hall edges are found, where rotor is \"hall\""});
  v.value(
      "hall_calibration_turns", s.hall_calibration_turns,
      {.meaning = "calibrated: electrical turns, each as long as the first to 1/64, that edges are learned "
                  "from; a multiple of the pole pairs where the magnets stray",
       .range = base::between(1, 1024)});
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
  v.choice("hall_lines", s.hall_lines, hall_order_choices,
           {.meaning = "which Hall probe is wired to pins H1, H2, H3 of the board"});
  v.choice(
      "hall_inverted", s.hall_inverted, hall_inverted_choices,
      {.meaning = "which pins H1, H2, H3 read their probe inverted, as where its output is another kind's"});
  describe_probes(v, s);
  v.choice("shaft", s.shaft, sensor_shaft_choices,
           {.meaning = "on which shaft the encoder or the resolver stands"});
  v.value(
      "watched", s.watched,
      {.meaning =
           "whether the drive stops where a resolver's amplitude or the count at an encoder's index is not "
           "that of an intact sensor; false: it goes on with what it has"});
  v.table("encoder", s.encoder, {.meaning = "lines A, B and Z, where rotor is \"encoder\""});
  v.table("absolute", s.absolute,
          {.meaning = "a code for every angle of the shaft, where rotor is \"absolute\""});
  v.table("resolver", s.resolver, {.meaning = "two windings at right angles, where rotor is \"resolver\""});
  v.table("comparators", s.comparators,
          {.meaning = "comparators at the terminals, where control.sensorless.follows is \"comparators\""});
  v.table("hall_break", s.hall_break, {.meaning = "a Hall line that breaks during the run"});
}

}  // namespace sixstep::study
