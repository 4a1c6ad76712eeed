// SPDX-License-Identifier: Apache-2.0
// The keys of [[at]].sensors: changes of Hall lines, amplifiers, encoders and resolvers during a run.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/at.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {

/// Message for a key that cannot change during a run.
inline constexpr std::string_view what_may_change =
    "during a run change only: reference; supply.voltage_V, supply.sinks; load.torque_Nm, load.locked; "
    "sensors.hall_break, .hall_lines, .hall_inverted, .current_offset_A, .current_gain_error, .missed_edges, "
    ".encoder_line, .false_index, .bad_track, .broken_winding, .excitation, .broken_divider; request; control.mode, .slew, .current "
    "(its gains, band_A, limit_A), .speed (its "
    "gains, torque_limit_Nm), .position, .limits (current_A, torque_Nm, speed_rad_s), .sensorless.commutates; "
    "pwm.chopping; "
    "bridge.dead_time_s, .phases, .open_switch, .shorted_switch; motor.broken_wire";

inline constexpr base::Choice<PinLevel> pin_level_choices[] = {
    {"low", PinLevel::low, "0, as a line that is shorted to ground"},
    {"high", PinLevel::high, "1, as a line that is cut before its pull-up"},
    {"probe", PinLevel::probe, "the probe's own level: the break ends, as after a glitch"},
};

inline void describe(base::Visitor& v, AtHallBreak& s) {
  v.value("line", s.line, {.meaning = "number of the Hall line: 1, 2 or 3", .range = base::between(1, 3)});
  v.choice("level", s.level, pin_level_choices, {.meaning = "level that the pin reads from time_s on"});
}

inline constexpr base::Choice<AtOrder> at_hall_order_choices[] = {
    {"same", AtOrder::same, "as before"},
    {"123", AtOrder::abc, hall_order_choices[0].meaning},
    {"231", AtOrder::bca, hall_order_choices[1].meaning},
    {"312", AtOrder::cab, hall_order_choices[2].meaning},
    {"132", AtOrder::acb, hall_order_choices[3].meaning},
    {"321", AtOrder::cba, hall_order_choices[4].meaning},
    {"213", AtOrder::bac, hall_order_choices[5].meaning},
};
inline constexpr base::Choice<AtHallLines> at_hall_inverted_choices[] = {
    {"same", AtHallLines::same, "as before"},
    {"none", AtHallLines::none, hall_inverted_choices[0].meaning},
    {"1", AtHallLines::line_1, hall_inverted_choices[1].meaning},
    {"2", AtHallLines::line_2, hall_inverted_choices[2].meaning},
    {"3", AtHallLines::line_3, hall_inverted_choices[3].meaning},
    {"12", AtHallLines::lines_12, hall_inverted_choices[4].meaning},
    {"13", AtHallLines::lines_13, hall_inverted_choices[5].meaning},
    {"23", AtHallLines::lines_23, hall_inverted_choices[6].meaning},
    {"123", AtHallLines::all, hall_inverted_choices[7].meaning},
};

inline constexpr base::Choice<EncoderLevel> encoder_level_choices[] = {
    {"low", EncoderLevel::low, level_choices[0].meaning},
    {"high", EncoderLevel::high, level_choices[1].meaning},
    {"whole", EncoderLevel::whole, "the encoder's own level: the fault ends"},
};

inline void describe(base::Visitor& v, AtTrack& s) {
  v.value("track", s.track,
          {.meaning = "number of the track, from 1 (the finest track) to sensors.absolute.bits",
           .range = base::between(1, 20)});
  v.choice("level", s.level, encoder_level_choices, {.meaning = "level of the track from time_s on"});
}

inline constexpr base::Choice<EncoderLine> encoder_line_choices[] = {
    {"A", EncoderLine::A, "line A: high over the first half of each line of the disc"},
    {"B", EncoderLine::B, "line B: like line A, a quarter of a line later"},
    {"Z", EncoderLine::Z,
     "line Z, the index: if the line sticks, the index is lost; if the level rises at time_s, the drive reads an index at a wrong angle"},
};

inline void describe(base::Visitor& v, AtEncoderLine& s) {
  v.choice("line", s.line, encoder_line_choices, {.meaning = "line of the encoder"});
  v.choice(
      "level", s.level, encoder_level_choices,
      {.meaning =
           "level that the pin reads from time_s on; with A or B stuck, the other line's edges count up and "
           "down in turn"});
}

inline constexpr base::Choice<Winding> winding_choices[] = {
    {"none", Winding::none, "none breaks"},
    {"cosine", Winding::cosine, "the cosine winding"},
    {"sine", Winding::sine, "the sine winding"},
    {"whole", Winding::whole, "both windings are intact again"},
};

inline constexpr base::Choice<Wire> divider_choices[] = {
    {"none", Wire::none, "all three dividers are intact"},
    {"a", Wire::a, "the divider of terminal a"},
    {"b", Wire::b, "the divider of terminal b"},
    {"c", Wire::c, "the divider of terminal c"},
};

inline void describe(base::Visitor& v, AtSensors& s) {
  v.table("hall_break", s.hall_break,
          {.meaning = "a Hall line that breaks at time_s, or is intact again from then on"});
  v.choice("hall_lines", s.hall_lines, at_hall_order_choices,
           {.meaning = "Hall probes at pins H1, H2, H3 of the board from time_s on"});
  v.choice("hall_inverted", s.hall_inverted, at_hall_inverted_choices,
           {.meaning = "pins H1, H2, H3 that read their probe inverted from time_s on"});
  v.value(
      "current_offset_A", s.current_offset_A,
      {.meaning =
           "reading of the amplifiers at zero current from time_s on; the drive measured its offsets before the run",
       .unit = "A"});
  v.value(
      "current_gain_error", s.current_gain_error,
      {.meaning = "relative gain error of the current measurement from time_s on; 0.05 reads 5 % too large",
       .range = base::Range{-1, 1, false, true}});
  v.value("missed_edges", s.missed_edges,
          {.meaning = "number of the encoder's next edges that are not counted; the next index corrects "
                      "the count",
           .range = base::between(1, 1000000)});
  v.table("bad_track", s.bad_track,
          {.meaning =
               "a track of the absolute encoder that sticks from time_s on, or is intact again from then on",
           .cure = what_may_change});
  v.table(
      "encoder_line", s.encoder_line,
      {.meaning =
           "a line of the incremental encoder that sticks from time_s on, or is intact again from then on",
       .cure = what_may_change});
  v.value("false_index", s.false_index,
          {.meaning = "true: a disturbance on line Z at time_s, which the timer counts as the index"});
  v.choice("broken_winding", s.broken_winding, winding_choices,
           {.meaning = "a winding of the resolver without a voltage from time_s on"});
  v.value("excitation", s.excitation,
          {.meaning = "the resolver's excitation from time_s on, as a fraction of the full excitation",
           .range = base::between(0, 2)});
  v.choice(
      "broken_divider", s.broken_divider, divider_choices,
      {.meaning =
           "a terminal's divider whose upper resistor opens at time_s: the drive reads 0 V at this terminal"});
}

}  // namespace sixstep::study
