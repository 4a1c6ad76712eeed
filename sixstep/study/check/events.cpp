// SPDX-License-Identifier: Apache-2.0
// Finds requests of [[at]] that the scenario's run cannot carry out.
#include <cmath>

#include "sixstep/base/written.hpp"
#include "sixstep/study/check/pace.hpp"
#include "sixstep/study/check/reference.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

namespace {

using base::written;

bool changes_no_wire(const At& at) {
  return at.bridge.phases == AtOrder::same && at.sensors.hall_lines == AtOrder::same &&
         at.sensors.hall_inverted == AtHallLines::same;
}

bool drifts(const At& at) { return at.sensors.current_offset_A || at.sensors.current_gain_error; }

bool fails_shaft_sensor(const At& at) {
  const AtSensors& x = at.sensors;
  return x.missed_edges || x.bad_track || x.encoder_line || x.false_index.value_or(false) ||
         x.broken_winding != Winding::none || x.excitation;
}

bool changes_nothing(const At& at) {
  return !at.reference && !at.supply.voltage_V && !at.supply.sinks && !at.load.torque_Nm && !at.load.locked &&
         !at.sensors.hall_break && changes_no_wire(at) && !drifts(at) && !fails_shaft_sensor(at) &&
         at.request == DriveRequest::none && !retunes(at) && !at.bridge.dead_time_s &&
         at.bridge.open_switch == Switch::none && at.bridge.shorted_switch == Switch::none &&
         at.motor.broken_wire == Wire::none && at.sensors.broken_divider == Wire::none;
}

/// True if a reference starts at the value of the present reference. This is impossible if the unit changes.
bool goes_on(const Reference& r) {
  const bool moves = r.shape == Shape::ramp || r.shape == Shape::trapezoid;
  return (moves && !r.start) || (r.shape == Shape::steps && !r.times_s.empty() && r.times_s.front() > 0);
}

/// One event, its place in the file, and the modes before and after it.
struct Event {
  const At& at;
  std::string where;
  control::Mode before, mode;
  const Scenario& s;
  base::Problems& out;

  void say(const char* key, std::string value, std::string limit, std::string cure) const {
    out.push_back({where + key, std::move(value), std::move(limit), std::move(cure)});
  }
};

void check_mode(const Event& e) {
  if (e.at.control.mode == AtMode::same) return;
  std::string word(1, '"');  // not a literal, because GCC 12 warns of a literal in front of +
  word += base::word(mode_choices, e.mode);
  word += '"';
  if (e.mode == e.before)
    return e.say(".control.mode", word, "is already the mode at this time", "remove this key");
  if (e.mode == control::Mode::off) return;
  if (!e.at.reference)
    e.say(".control.mode", word,
          "needs a new reference, because the present reference is in the unit of the earlier mode",
          "add a reference to this event, in " + std::string(reference_unit(e.mode)));
  else if (goes_on(*e.at.reference))
    e.say(".reference", "",
          "continues from the last value of the reference, which is in the unit of the earlier mode",
          "give reference.start, or let reference.times_s begin at 0");
  if (e.s.control.slew && !e.at.control.slew)
    e.say(".control.mode", word,
          "changes the mode, and control.slew is still in the unit of the earlier mode",
          "add control.slew to this event");
}

/// Refuses changes of the controller's settings that have no effect, and dead times that are not allowed.
void check_chip(const Event& e) {
  if (e.at.control.current.band_A && e.s.control.current.type != CurrentLoopType::hysteresis)
    e.say(".control.current.band_A", written(*e.at.control.current.band_A),
          "applies to a hysteresis only, and control.current.type is not \"hysteresis\"",
          "remove this key: the type of the current loop cannot change during a run");
  if (e.at.pwm.chopping != AtChopping::same && e.s.control.smooth_chopping.on)
    e.say(".pwm.chopping", "",
          "has no effect, because control.smooth_chopping selects the chopping by the current",
          "remove this key, or set control.smooth_chopping.on = false");
  if (e.at.bridge.dead_time_s)
    check_dead_time(e.where + ".bridge.dead_time_s", *e.at.bridge.dead_time_s, e.s.pwm, e.out);
}

/// Refuses a drift of the current amplifiers on a board without amplifiers, and an offset beyond the
/// converter's range.
void check_drift(const Event& e) {
  const Sensors& sensors = e.s.sensors;
  if (!drifts(e.at)) return;
  const std::optional<double>& offset = e.at.sensors.current_offset_A;
  const char* key = offset ? ".sensors.current_offset_A" : ".sensors.current_gain_error";
  const std::string value = written(offset ? *offset : *e.at.sensors.current_gain_error);
  if (sensors.currents == rig::CurrentMeasurement::ideal)
    return e.say(
        key, value, "applies to an amplifier only, and sensors.currents = \"ideal\"",
        "set sensors.currents = \"phases\", \"dc-link\" or \"low-side\", and give sensors.current_range_A");
  if (offset && sensors.current_range_A && std::fabs(*offset) >= *sensors.current_range_A)
    e.say(key, value, "leaves no range within sensors.current_range_A = " + written(*sensors.current_range_A),
          "lower this value, or raise sensors.current_range_A");
}

void check_event(const Event& e) {
  const auto& [at, where, before, mode, s, out] = e;
  check_mode(e);
  check_chip(e);
  check_drift(e);
  if (!(at.time_s < s.duration_s))
    out.push_back({where + ".time_s", written(at.time_s),
                   "is not before the end of the run (duration_s = " + written(s.duration_s) + ")",
                   "lengthen duration_s, or remove the event"});
  if (changes_nothing(at))
    out.push_back(
        {where + ".time_s", written(at.time_s), "changes nothing",
         "give one key of reference, supply, load, motor, request, sensors, control, pwm or bridge"});
  if (at.supply.voltage_V && s.supply.source != SourceKind::steady)
    out.push_back({where + ".supply.voltage_V", written(*at.supply.voltage_V),
                   "applies to a steady source only, and supply.source is a battery or mains",
                   "remove this key, or set supply.source = \"steady\""});
  if (at.load.torque_Nm && !s.load.dynamometer_rad_s.empty())
    out.push_back({where + ".load.torque_Nm", written(*at.load.torque_Nm),
                   "has no effect, because a dynamometer imposes the speed",
                   "remove this key: with a dynamometer the torque is a result of the run"});
  if (at.supply.sinks == false && !(s.supply.capacitance_F > 0))
    out.push_back({where + ".supply.sinks", "false", "needs a bus with a capacitor, whose voltage can rise",
                   "give supply.resistance_ohm and supply.capacitance_F"});
  const std::optional<double>& limit_V = s.control.regeneration.limit_V;
  if (at.supply.voltage_V && limit_V && !(*at.supply.voltage_V < *limit_V))
    out.push_back({where + ".supply.voltage_V", written(*at.supply.voltage_V),
                   "must stay below control.regeneration.limit_V = " + written(*limit_V),
                   "lower this value, or raise limit_V: above limit_V the drive could not brake"});
  if (at.reference && mode == control::Mode::off)
    out.push_back({where + ".reference", "", "sets a reference, which control.mode = \"off\" does not have",
                   "set control.mode = \"duty\", \"current\", \"speed\" or \"position\""});
  if (at.request != DriveRequest::none && s.control.drive != FirmwareKind::product)
    out.push_back(
        {where + ".request", "", "is read by the product drive only", "set control.drive = \"product\""});
}

}  // namespace

void check_events(const Scenario& s, base::Problems& out) {
  const std::vector<control::Mode> modes = modes_from(s);
  control::Mode before = s.control.mode;
  for (const At* at : in_order(s)) {
    const auto n = static_cast<std::size_t>(at - s.at.data());
    check_event({*at, "at[" + std::to_string(n) + "]", before, modes[n], s, out});
    before = modes[n];
  }
}

}  // namespace sixstep::study
