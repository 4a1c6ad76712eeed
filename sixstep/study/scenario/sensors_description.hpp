// SPDX-License-Identifier: Apache-2.0
// The keys of [sensors]: names, units, ranges and meanings.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/comparators_description.hpp"
#include "sixstep/study/scenario/sensors.hpp"
#include "sixstep/study/scenario/shaft_sensors_description.hpp"

namespace sixstep::study {

inline constexpr base::Choice<rig::CurrentMeasurement> current_sensing_choices[] = {
    {"ideal", rig::CurrentMeasurement::ideal, "the exact phase currents"},
    {"phases", rig::CurrentMeasurement::phases, "an amplifier and a converter per phase"},
    {"dc-link", rig::CurrentMeasurement::dc_link,
     "one shunt or Hall transducer in the DC link, or in the bus's return, which shows the motor current "
     "only within the on-time"},
    {"low-side", rig::CurrentMeasurement::low_side,
     "shunts below the lower switches of the legs that shunts names, each of which shows its leg's current while "
     "the lower switch or its diode conducts"},
};
inline constexpr base::Choice<ShuntLegs> shunt_choices[] = {
    {"abc", ShuntLegs::abc, "all three legs"},
    {"ab", ShuntLegs::ab, "two legs; the third current is the negative sum"},
    {"ac", ShuntLegs::ac, "two legs"},
    {"bc", ShuntLegs::bc, "two legs"},
    {"a", ShuntLegs::a, "one leg, of a driven pair only"},
    {"b", ShuntLegs::b, "one leg"},
    {"c", ShuntLegs::c, "one leg"},
};
inline constexpr base::Choice<BusSensing> bus_sensing_choices[] = {
    {"ideal", BusSensing::ideal, "the exact bus voltage"},
    {"adc", BusSensing::adc, "through the converter, from 0 to bus_range_V"},
};
inline constexpr base::Choice<RotorSensing> rotor_sensing_choices[] = {
    {"ideal", RotorSensing::ideal, "exact speed and position; for the sensorless drive: no probes"},
    {"hall", RotorSensing::hall, "from the times of the Hall edges, by the controller's own blocks"},
    {"encoder", RotorSensing::encoder,
     "from an incremental encoder; an encoder on the motor's shaft also commutates"},
    {"absolute", RotorSensing::absolute,
     "from an absolute encoder in Gray code; an encoder on the motor's shaft also commutates"},
    {"resolver", RotorSensing::resolver,
     "from a resolver and a tracking loop; a resolver on the motor's shaft also commutates"},
};
inline constexpr base::Choice<rig::HallAngleFrom> hall_angle_choices[] = {
    {"sectors", rig::HallAngleFrom::sectors, "in sectors of 60 degrees, counted at the Hall edges"},
    {"interpolated", rig::HallAngleFrom::angle,
     "by an angle that is interpolated between edges, minus the effect of the probes' known delay and hysteresis; with pwm.commutation = \"sample\" this angle also commutates"},
    {"calibrated", rig::HallAngleFrom::learned_edges,
     "as interpolated, with the angles of the edges measured in the first steady turns; the common offset of the edges is not measured"},
};
inline constexpr base::Choice<SensorShaft> sensor_shaft_choices[] = {
    {"motor", SensorShaft::motor, "the motor's shaft: the sensor commutates"},
    {"load", SensorShaft::load,
     "the load's shaft, behind gear and coupling: the Hall probes commutate; speed and position are "
     "multiplied by the gear ratio"},
};
inline constexpr base::Choice<Level01> level_choices[] = {
    {"low", Level01::low, "0, as a line that is shorted to ground"},
    {"high", Level01::high, "1, as a line that is cut before its pull-up"},
};

inline constexpr base::Choice<rig::WireOrder> hall_order_choices[] = {
    {"123", rig::WireOrder::abc, "each probe at its own pin"},
    {"231", rig::WireOrder::bca, "probes 2, 3, 1 at H1, H2, H3: all three are moved forward"},
    {"312", rig::WireOrder::cab, "probes 3, 1, 2: all three are moved back"},
    {"132", rig::WireOrder::acb, "probes 2 and 3 swapped"},
    {"321", rig::WireOrder::cba, "probes 1 and 3 swapped"},
    {"213", rig::WireOrder::bac, "probes 1 and 2 swapped"},
};
inline constexpr base::Choice<HallLines> hall_inverted_choices[] = {
    {"none", HallLines::none, "no pin reads its probe inverted"},
    {"1", HallLines::line_1, "H1 reads its probe inverted"},
    {"2", HallLines::line_2, "H2 reads its probe inverted"},
    {"3", HallLines::line_3, "H3 reads its probe inverted"},
    {"12", HallLines::lines_12, "H1 and H2"},
    {"13", HallLines::lines_13, "H1 and H3"},
    {"23", HallLines::lines_23, "H2 and H3"},
    {"123", HallLines::all, "all three pins read inverted: the code of the opposite sector"},
};

inline constexpr base::Choice<control::HallArrangement> hall_spacing_choices[] = {
    {"120", control::HallArrangement::degrees_120, "codes 000 and 111 are impossible"},
    {"60", control::HallArrangement::degrees_60, "codes 010 and 101 are impossible"},
};

inline void describe(base::Visitor& v, HallBreak& s) {
  using base::between;
  v.value("at_s", s.at_s,
          {.meaning = "time at which a Hall line sticks. Default: none sticks",
           .unit = "s",
           .range = base::from(0)});
  v.value("line", s.line, {.meaning = "number of the Hall line: 1, 2 or 3", .range = between(1, 3)});
  v.choice("level", s.level, level_choices, {.meaning = "level at which the line sticks"});
}

inline void describe_currents(base::Visitor& v, Sensors& s) {
  v.choice("currents", s.currents, current_sensing_choices,
           {.meaning = "how the controller's currents are measured"});
  v.value("adc_bits", s.adc_bits,
          {.meaning = "bits of the converters of currents and bus voltage", .range = base::between(4, 16)});
  v.value(
      "current_range_A", s.current_range_A,
      {.meaning =
           "current at the converter's full scale: the converter measures from minus this value to plus this value",
       .unit = "A",
       .range = base::above(0)});
  v.value("current_offset_A", s.current_offset_A,
          {.meaning = "offset of the amplifiers: reading at zero current", .unit = "A"});
  v.value("current_gain_error", s.current_gain_error,
          {.meaning = "relative gain error of the current; 0.05 reads 5 % too large",
           .range = base::Range{-1, 1, false, true}});
  v.value("current_noise_A", s.current_noise_A,
          {.meaning = "root mean square of the noise of a sample", .unit = "A", .range = base::from(0)});
  v.value(
      "current_bandwidth_Hz", s.current_bandwidth_Hz,
      {.meaning =
           "bandwidth of each current amplifier in front of the converter, a first-order lag. Default: no lag",
       .unit = "Hz",
       .range = base::between(1, 1e9)});
  v.value(
      "current_delay_s", s.current_delay_s,
      {.meaning = "age of the current that a sample shows, in addition to the lag of current_bandwidth_Hz",
       .unit = "s",
       .range = base::from(0)});
  v.value("calibrated", s.calibrated,
          {.meaning = "whether the controller measured the offset before the run, in 64 noisy samples"});
  v.value("shunt_settle_s", s.shunt_settle_s,
          {.meaning =
               "dc-link, low-side: least on-time of a switch before a sample that counts; with complementary "
               "chopping the switch turns on bridge.dead_time_s later",
           .unit = "s",
           .range = base::from(0)});
  v.choice("shunts", s.shunts, shunt_choices, {.meaning = "low-side: legs that have a shunt"});
  v.value("shunt_least_on_s", s.shunt_least_on_s,
          {.meaning =
               "low-side: least on-time of a lower switch in a period whose sample counts, such as twice the "
               "converter's sampling time",
           .unit = "s",
           .range = base::from(0)});
  v.value(
      "commutation_samples", s.commutation_samples,
      {.meaning = "dc-link: number of samples after a Hall edge that count as the incoming phase's current",
       .range = base::between(0, 255)});
}

/// Mounting of the probes, in electrical degrees of the motor's angle.
inline void describe_probes(base::Visitor& v, Sensors& s) {
  v.choice("hall_spacing", s.hall_spacing, hall_spacing_choices,
           {.meaning = "electrical angle between two Hall probes, degrees"});
  v.value("hall_offset_deg", s.hall_offset_deg,
          {.meaning = "electrical angle by which all Hall edges come late",
           .unit = "deg",
           .range = base::between(-180, 180)});
  v.value("hall_edges_deg", s.hall_edges_deg,
          {.meaning = "additional angle by which each Hall edge comes late, the edge at 0 degrees first. 6 "
                      "values: one electrical turn; 6 per pole pair: one mechanical turn, for magnets that "
                      "differ",
           .unit = "deg",
           .range = base::between(-60, 60)});
  v.value(
      "hall_hysteresis_deg", s.hall_hysteresis_deg,
      {.meaning =
           "hysteresis of the probes: angle between a Hall edge in forward rotation and in backward rotation",
       .unit = "deg",
       .range = base::between(0, 59)});
  v.value(
      "hall_delay_s", s.hall_delay_s,
      {.meaning =
           "delay of a Hall line, such as a filter's: from the rotor's passing of the edge angle to the edge at the pin",
       .unit = "s",
       .range = base::between(0, 2e-4)});
  v.value("hall_glitches_Hz", s.hall_glitches_Hz,
          {.meaning = "mean rate of glitches on each Hall line, at random instants drawn with seed",
           .unit = "Hz",
           .range = base::from(0)});
  v.value("hall_glitch_s", s.hall_glitch_s,
          {.meaning = "duration of a glitch", .unit = "s", .range = base::between(1e-9, 1e-3)});
}

inline void describe(base::Visitor& v, Sensors& s) {
  describe_currents(v, s);
  v.choice("bus", s.bus, bus_sensing_choices, {.meaning = "how the controller's bus voltage is measured"});
  v.value("bus_range_V", s.bus_range_V,
          {.meaning = "bus voltage at the converter's full scale", .unit = "V", .range = base::above(0)});
  v.value("bus_offset_V", s.bus_offset_V,
          {.meaning = "offset of the converter: reading at zero voltage", .unit = "V"});
  v.value("bus_gain_error", s.bus_gain_error,
          {.meaning = "relative gain error of the voltage; 0.05 reads 5 % too large",
           .range = base::Range{-1, 1, false, true}});
  v.value("bus_noise_V", s.bus_noise_V,
          {.meaning = "root mean square of the noise of a sample", .unit = "V", .range = base::from(0)});
  v.value(
      "bus_bandwidth_Hz", s.bus_bandwidth_Hz,
      {.meaning =
           "bandwidth of the divider and its capacitor in front of the converter, a first-order lag; also for the terminals' dividers. Default: no lag",
       .unit = "Hz",
       .range = base::between(1, 1e9)});
  v.value("terminal_gain_error", s.terminal_gain_error,
          {.meaning =
               "relative gain errors of the dividers of terminals a, b, c: 3 values; the drive is designed "
               "for control.sensorless.mismatch",
           .range = base::between(-0.5, 0.5)});
  v.choice("rotor", s.rotor, rotor_sensing_choices,
           {.meaning = "sensor from which the controller gets speed and position"});
  v.value("capture_Hz", s.capture_Hz,
          {.meaning = "clock of the timer that captures edges of Hall probes, incremental encoder or "
                      "comparators. One tick of the averaging time is the resolution of the speed",
           .unit = "Hz",
           .range = base::between(1, 1e9)});
  v.value(
      "speed_edges", s.speed_edges,
      {.meaning =
           "number of Hall edges over which a speed is averaged. With 6, one electrical turn, "
           "probe errors cancel, and the speed is 3.5 sectors old. 0: 6 if the averaging costs the speed loop at most 22.5 degrees of phase, else 1",
       .range = base::between(0, 6)});
  v.choice("hall_angle", s.hall_angle, hall_angle_choices,
           {.meaning = "method for speed and position between Hall edges, where rotor is \"hall\""});
  v.value(
      "hall_calibration_turns", s.hall_calibration_turns,
      {.meaning = "calibrated: number of electrical turns, each as long as the first to 1/64, in which the "
                  "edges are measured; a multiple of the pole pairs if the magnets differ",
       .range = base::between(1, 1024)});
  v.value("timeout_s", s.timeout_s,
          {.meaning = "time without a Hall edge that counts as standstill",
           .unit = "s",
           .range = base::above(0)});
  v.value("hall_stable_samples", s.hall_stable_samples,
          {.meaning = "product drive: number N of consecutive samples with the same Hall code before the "
                      "code counts. Above 1, an edge takes effect at a control tick, N - 1 samples late, "
                      "not in the interrupt",
           .range = base::between(1, 255)});
  v.value("seed", s.seed,
          {.meaning = "seed of the noise; the same seed gives the same run",
           .range = base::between(0, 2147483647)});
  v.choice("hall_lines", s.hall_lines, hall_order_choices,
           {.meaning = "Hall probes at pins H1, H2, H3 of the board"});
  v.choice("hall_inverted", s.hall_inverted, hall_inverted_choices,
           {.meaning = "pins H1, H2, H3 that read their probe inverted, as with a probe whose output has the "
                       "opposite polarity"});
  describe_probes(v, s);
  v.choice("shaft", s.shaft, sensor_shaft_choices,
           {.meaning = "shaft on which the encoder or the resolver is mounted"});
  v.value("watched", s.watched,
          {.meaning =
               "whether the drive stops if a resolver's amplitude or the count at an encoder's index shows a "
               "faulty sensor; false: the drive continues with the faulty signal"});
  v.table("encoder", s.encoder, {.meaning = "lines A, B and Z, where rotor is \"encoder\""});
  v.table("absolute", s.absolute,
          {.meaning = "a code for every angle of the shaft, where rotor is \"absolute\""});
  v.table("resolver", s.resolver, {.meaning = "two windings at right angles, where rotor is \"resolver\""});
  v.table("comparators", s.comparators,
          {.meaning = "comparators at the terminals, where control.sensorless.follows is \"comparators\""});
  v.table("hall_break", s.hall_break, {.meaning = "a Hall line that breaks during the run"});
}

}  // namespace sixstep::study
